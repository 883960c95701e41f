// SPDX-License-Identifier: BSD-3-Clause
// Crest lines of plain arrays, without PCL: reads x y z nx ny nz from standard input.
#include <pcl_crest/crest_extraction.h>

#include <exception>
#include <iostream>
#include <vector>

int
main ()
{
  std::vector<float> floats;
  for (float number = 0.0F; std::cin >> number;)
    floats.push_back (number);

  pcl::crest::ExtractionRequest request;
  request.cloud = {floats.data(), floats.data() + 3, 6, floats.size() / 6};
  request.parameters.angle = 30.0; // degrees that the surface turns across a line
  try {
    const pcl::crest::Extraction found = pcl::crest::extractCrests (request);
    for (const pcl::crest::CrestLine& line : found.lines)
      std::cout << (line.type == pcl::crest::CrestType::RIDGE ? "ridge" : "valley")
                << " of " << line.size << " points, length " << line.length << '\n';
  }
  catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  }
  return 0;
}
