// SPDX-License-Identifier: BSD-3-Clause
// Boost.Program_options in PCL's form, a dash, a name, perhaps a value, and with our
// words for what is wrong.
#pragma once

#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/parameters.h>

#include <boost/program_options.hpp>

#include "io/parse_number.h"

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The options of a program. Their names begin with the dash. */
using Options = boost::program_options::options_description;

/** \brief What follows the name of an option, and where it goes; Options own theirs. */
using OptionValue = boost::program_options::value_semantic;

/** \brief What a program was called with. */
struct Arguments {
  boost::program_options::variables_map options;
  /** those that are no options, in their order */
  std::vector<std::string> files;
};

/** \brief A value of any kind.
 * \param[in] name of it in the usage, as in "N" or "FILE.json"
 * \param[in] take takes it in; returns what would be right if it is not, else nothing.
 * Those of several options are called in the order of the usage.
 */
OptionValue*
value (const std::string& name,
       const std::function<std::string (const std::string&)>& take);

/** \brief No value. */
OptionValue*
flag (bool& given);

/** \brief The name of a file. */
OptionValue*
fileName (const std::string& name, std::string& file);

/** \brief Reads a number, all of the text; returns what would be right. */
template <typename T>
std::string
takeNumber (const std::string& text, T& number)
{
  if (parseNumber (text, number))
    return {};
  if (std::is_floating_point_v<T>)
    return "a number";
  return std::is_signed_v<T> ? "a whole number" : "a whole number that is not negative";
}

template <typename T>
std::string
takeNumber (const std::string& text, std::optional<T>& number)
{
  return takeNumber (text, number.emplace());
}

/** \brief A number. */
template <typename T>
OptionValue*
number (T& number)
{
  return value (
      "N", [&number] (const std::string& text) { return takeNumber (text, number); });
}

/** \brief One of some words, each of which means something. */
template <typename T>
OptionValue*
oneOf (const std::string& name,
       const std::vector<std::pair<std::string, T>>& words,
       T& meant)
{
  return value (name, [words, &meant] (const std::string& given) {
    std::string wanted;
    for (const auto& [word, meaning] : words) {
      if (word == given) {
        meant = meaning;
        return std::string();
      }
      const bool last = word == words.back().first;
      wanted += (wanted.empty() ? "" : last ? " or " : ", ") + word;
    }
    return wanted;
  });
}

/** \brief Takes the arguments of main; returns what is wrong, if anything. */
std::string
parse (int argc, const char* const* argv, const Options& options, Arguments& arguments);

/** \brief Options that have something in common. */
struct OptionGroup {
  std::string title;
  Options options;
};

/** \brief All options of some groups. */
Options
allOptions (const std::vector<OptionGroup>& groups);

/** \brief A line or more for each option. */
std::string
usage (const Options& options);

/** \brief The same of each group, below its title. */
std::string
usage (const std::vector<OptionGroup>& groups);

/** \brief Adds the options that fill the parameters of the estimation: -preset -angle
 * -min_length -confidence -positions -k -radius -search -M -M_ridge -M_valley -absolute
 * -S -S_ridge -S_valley -strength -prune -type -boundaries -threads. The defaults in
 * the usage are those that the parameters have now, but for the search, which is the
 * batched one.
 */
void
addEstimationOptions (Options& options, Parameters& parameters);

/** \brief Adds -format and -columns, which tell how to read a file, -class, which tells
 * what of it, -sample, which
 * tells whether its faces are sampled, -estimate_normals, which has normals estimated
 * whatever the file has, and what their side may be decided by, -viewpoint and -up.
 */
void
addReadingOptions (Options& options, ReadOptions& reading);

/** \brief Adds -h and -version, which programs answer before they parse. */
void
addQuestions (Options& options, bool& asked);

/** \brief Takes the arguments of main for a program with these options.
 * \param[in] names of the files that it expects, as in the usage
 * \return what is wrong, if anything: one option, all of them together, or the files
 */
std::string
takeArguments (int argc,
               const char* const* argv,
               const std::vector<std::string>& names,
               const Options& options,
               const Parameters& parameters,
               Arguments& arguments);

} // namespace crest
} // namespace pcl
