// SPDX-License-Identifier: BSD-3-Clause
#include "estimation.h"

#include <new>

namespace pcl {
namespace crest {

ExitCode
estimate (const std::string& file,
          const Parameters& parameters,
          const ReadOptions& options,
          const std::function<void (const InputCloud&)>& tell,
          const ProgressCallback& progress,
          Estimate& result,
          std::string& error)
{
  if (!readCloud (file, parameters.k, parameters.threads, result.cloud, error, options))
    return EXIT_FILE;
  tell (result.cloud);
  setInput (result.cloud, result.estimation);
  result.estimation.setParameters (parameters);
  result.estimation.setProgressCallback (progress);
  bool enough_memory = true;
  try {
    result.estimation.compute (result.labels);
  }
  catch (const std::bad_alloc&) {
    enough_memory = false;
  }
  result.estimation.setProgressCallback (nullptr);
  if (!enough_memory) {
    error = notEnoughMemory (file);
    return EXIT_FILE;
  }
  if (result.labels.size() == result.cloud.points->size())
    return EXIT_DONE;
  error = "the crest lines could not be computed";
  return EXIT_USAGE;
}

} // namespace crest
} // namespace pcl
