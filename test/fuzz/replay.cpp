// SPDX-License-Identifier: BSD-3-Clause
// Takes the place of libFuzzer where that is not linked: gives a target the files of
// folders, once each.
#include "support/temporary_directory.h"

#include <cstdint>
#include <iostream>

extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* bytes, std::size_t size);

int
main (int argc, char** argv)
{
  std::size_t count = 0;
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] == '-')
      continue;
    for (const auto& entry : std::filesystem::directory_iterator (argv[i])) {
      const std::string bytes = oracle::contentOf (entry.path().string());
      std::cout << entry.path().string() << std::endl;
      LLVMFuzzerTestOneInput (reinterpret_cast<const std::uint8_t*> (bytes.data()),
                              bytes.size());
      ++count;
    }
  }
  std::cout << count << " files\n";
  return count == 0 ? 1 : 0;
}
