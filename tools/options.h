// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/parameters.h>

#include <functional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The options of a program, of PCL's form: a dash, a name, perhaps a value. */
class Options {
public:
  /** \brief Takes the value of an option in; returns what would be right if that is
   * not, else nothing. */
  using Take = std::function<std::string (const std::string& value)>;

  /** \brief Adds an option with a value.
   * \param[in] name with its dash
   * \param[in] value its name in the usage, as in "N" or "FILE.json"
   * \param[in] help one line for the usage
   * \param[in] take called for each option given, in the order they were added
   */
  void
  add (const std::string& name,
       const std::string& value,
       const std::string& help,
       Take take);

  /** \brief Adds an option without a value. */
  void
  addFlag (const std::string& name, const std::string& help, bool& flag);

  /** \brief Adds an option whose value is a number, all of it. */
  template <typename T>
  void
  addNumber (const std::string& name, const std::string& help, T& number);

  /** \brief Adds an option whose value is taken as it is. */
  void
  addText (const std::string& name,
           const std::string& value,
           const std::string& help,
           std::string& text);

  /** \brief Takes the arguments of main.
   * \param[out] others the arguments that are no options, in their order
   * \param[out] error what is wrong, if so
   */
  bool
  parse (int argc,
         const char* const* argv,
         std::vector<std::string>& others,
         std::string& error);

  /** \brief Whether parse found the option. */
  bool
  given (const std::string& name) const;

  /** \brief A line for each option. */
  std::string
  usage () const;

private:
  struct Option {
    std::string name;
    std::string value;
    std::string help;
    Take take;
    bool given;
    std::string given_value;
  };

  Option*
  find (const std::string& name);

  std::vector<Option> options_;
};

/** \brief Adds the options that fill the parameters of the estimation: -preset -angle
 * -min_length -confidence -positions -k -radius -search -M -M_ridge -M_valley -absolute
 * -S -S_ridge -S_valley -strength -prune -type -boundaries -threads. The defaults in
 * the usage are those that the parameters have now, but for the search, which is the
 * batched one.
 */
void
addEstimationOptions (Options& options, Parameters& parameters);

/** \brief Adds the option that has normals estimated whatever the file has. */
void
addNormalsOption (Options& options, bool& estimate_normals);

/** \brief Takes the arguments of main for a program with these options.
 * \param[in] names of the files that it expects, as in the usage
 * \param[out] files these
 * \return what is wrong, if anything: one option, all of them together, or the files
 */
std::string
takeArguments (int argc,
               const char* const* argv,
               const std::vector<std::string>& names,
               Options& options,
               const Parameters& parameters,
               std::vector<std::string>& files);

} // namespace crest
} // namespace pcl
