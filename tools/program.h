// SPDX-License-Identifier: BSD-3-Clause
// What all programs of the project have in common.
#pragma once

#include <pcl_crest/parameters.h>
#include <pcl_crest/version.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <array>
#include <iostream>
#include <string>

namespace pcl {
namespace crest {

/** \brief What programs exit with: done, wrong usage, or a file (or display) that could
 * not be read, written or opened, or that memory did not suffice for.
 */
enum ExitCode { EXIT_DONE = 0, EXIT_USAGE = 1, EXIT_FILE = 2 };

/** \brief What to say of a file whose cloud was read, but is too large to compute. */
inline std::string
notEnoughMemory (const std::string& file)
{
  return file +
         ": there is not enough memory to compute its crest lines: compute it in "
         "parts that overlap";
}

/** \brief Says what is wrong; returns the code to exit with. */
inline int
fail (const std::string& program, ExitCode code, const std::string& message)
{
  std::cerr << program << ": " << message << "\n";
  if (code == EXIT_USAGE)
    std::cerr << program << " -h tells how to use it\n";
  return code;
}

/** \brief Whether one of the words is among the arguments, wherever: who asks for help
 * may not know how to write the rest.
 */
inline bool
isAsked (int argc, const char* const* argv, const std::array<std::string, 2>& words)
{
  return std::find_first_of (argv + 1, argv + argc, words.begin(), words.end()) !=
         argv + argc;
}

inline bool
wantsHelp (int argc, const char* const* argv)
{
  return isAsked (argc, argv, {"-h", "--help"});
}

inline bool
wantsVersion (int argc, const char* const* argv)
{
  return isAsked (argc, argv, {"-version", "--version"});
}

/** \brief The program's version, the presets and the kernels, for people to read. */
inline std::string
describeVersion (const std::string& program)
{
  std::vector<std::string> names;
  for (const Preset preset : presets())
    names.push_back (nameOf (preset) +
                     (preset == Parameters().preset ? " (default)" : ""));
  const std::vector<std::string> kernels = kernelNames();
  return program + " " + version() + "\npresets: " + boost::join (names, ", ") +
         "\nkernels: " + kernels.front() + " (of " + boost::join (kernels, ", ") +
         ")\n";
}

} // namespace crest
} // namespace pcl
