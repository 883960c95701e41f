// SPDX-License-Identifier: BSD-3-Clause
// Reads a file with the installed library; says how many points it has, or what is
// wrong.
#include <pcl_crest/io/read_cloud.h>

#include <iostream>

int
main (int, char** argv)
{
  pcl::crest::InputCloud cloud;
  std::string error;
  if (!pcl::crest::readCloud (argv[1], 24, 0, cloud, error)) {
    std::cerr << error << "\n";
    return 2;
  }
  std::cout << cloud.points->size() << " points\n";
  return 0;
}
