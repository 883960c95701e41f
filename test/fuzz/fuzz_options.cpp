// SPDX-License-Identifier: BSD-3-Clause
// Any words are options, or refused in a sentence. Each line of the input is a word.
#include <boost/algorithm/string.hpp>

#include "tools/command_line.h"
#include "tools/options.h"

#include <cstdint>
#include <cstdlib>

using namespace pcl::crest;

extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* bytes, std::size_t size)
{
  const std::string text (reinterpret_cast<const char*> (bytes), size);
  std::vector<std::string> words;
  boost::split (words, text, [] (char c) { return c == '\n' || c == '\0'; });
  std::vector<const char*> argv{"fuzz_options"};
  for (const std::string& word : words)
    argv.push_back (word.c_str());

  Options options;
  Parameters parameters;
  ReadOptions reading;
  bool asked = false;
  addReadingOptions (options, reading);
  addEstimationOptions (options, parameters);
  addQuestions (options, asked);
  Arguments arguments;
  const std::string error = takeArguments (static_cast<int> (argv.size()),
                                           argv.data(),
                                           {"INPUT", "OUTPUT"},
                                           options,
                                           parameters,
                                           arguments);
  // What was taken is valid, and can be said again.
  if (error.empty() &&
      (arguments.files.size() != 2 || !explainInvalid (parameters).empty() ||
       optionsOf (parameters).find ("nan") != std::string::npos))
    std::abort();
  return 0;
}
