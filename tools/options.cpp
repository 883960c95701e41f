// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include "io/parse_number.h"

#include <algorithm>
#include <sstream>
#include <type_traits>

namespace pcl {
namespace crest {

namespace {

template <typename T>
std::string
takeNumber (const std::string& value, T& number)
{
  if (parseNumber (value, number))
    return {};
  if (std::is_floating_point_v<T>)
    return "a number";
  return std::is_signed_v<T> ? "a whole number" : "a whole number that is not negative";
}

template <typename T>
std::string
takeNumber (const std::string& value, std::optional<T>& number)
{
  return takeNumber (value, number.emplace());
}

template <typename T>
std::string
withDefault (const std::string& help, const T& value)
{
  std::ostringstream text;
  text << help << " (default " << value << ")";
  return text.str();
}

/** \brief Adds the option for both types and, to win over it, the one for each. */
template <typename T>
void
addPerType (Options& options,
            const std::string& name,
            const std::string& help,
            PerType<T>& numbers)
{
  options.add (name, "N", help, [&numbers] (const std::string& value) {
    std::string wanted = takeNumber (value, numbers.ridge);
    numbers.valley = numbers.ridge;
    return wanted;
  });
  options.addNumber (name + "_ridge", name + " of ridges alone", numbers.ridge);
  options.addNumber (name + "_valley", name + " of valleys alone", numbers.valley);
}

} // namespace

void
Options::add (const std::string& name,
              const std::string& value,
              const std::string& help,
              Take take)
{
  options_.push_back ({name, value, help, std::move (take), false, {}});
}

void
Options::addFlag (const std::string& name, const std::string& help, bool& flag)
{
  add (name, "", help, [&flag] (const std::string&) {
    flag = true;
    return std::string();
  });
}

template <typename T>
void
Options::addNumber (const std::string& name, const std::string& help, T& number)
{
  add (name, "N", help, [&number] (const std::string& value) {
    return takeNumber (value, number);
  });
}
template void
Options::addNumber (const std::string&, const std::string&, int&);
template void
Options::addNumber (const std::string&, const std::string&, unsigned&);
template void
Options::addNumber (const std::string&, const std::string&, double&);
template void
Options::addNumber (const std::string&, const std::string&, std::optional<int>&);

void
Options::addText (const std::string& name,
                  const std::string& value,
                  const std::string& help,
                  std::string& text)
{
  add (name, value, help, [&text] (const std::string& given) {
    text = given;
    return std::string (given.empty() ? "the name of a file" : "");
  });
}

bool
Options::parse (int argc,
                const char* const* argv,
                std::vector<std::string>& others,
                std::string& error)
{
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.empty() || argument[0] != '-') {
      others.push_back (argument);
      continue;
    }
    Option* const option = find (argument);
    if (option == nullptr) {
      error = "there is no option \"" + argument + "\"";
      return false;
    }
    if (option->given) {
      error = "the option " + argument + " is given twice";
      return false;
    }
    option->given = true;
    if (option->value.empty())
      continue;
    if (i + 1 == argc || find (argv[i + 1]) != nullptr) {
      error = "the option " + argument + " needs a value, " + option->value;
      return false;
    }
    option->given_value = argv[++i];
  }
  for (const Option& option : options_) {
    const std::string wanted =
        option.given ? option.take (option.given_value) : std::string();
    if (!wanted.empty()) {
      error = "the option " + option.name + " is \"" + option.given_value +
              "\", but must be " + wanted;
      return false;
    }
  }
  return true;
}

bool
Options::given (const std::string& name) const
{
  return std::any_of (options_.begin(), options_.end(), [&name] (const Option& option) {
    return option.name == name && option.given;
  });
}

std::string
Options::usage() const
{
  constexpr std::size_t HELP_COLUMN = 26;
  std::string text;
  for (const Option& option : options_) {
    std::string line = "  " + option.name;
    if (!option.value.empty())
      line += " " + option.value;
    line.resize (std::max (line.size() + 1, HELP_COLUMN), ' ');
    text += line + option.help + "\n";
  }
  return text;
}

Options::Option*
Options::find (const std::string& name)
{
  for (Option& option : options_)
    if (option.name == name)
      return &option;
  return nullptr;
}

void
addNormalsOption (Options& options, bool& estimate_normals)
{
  options.addFlag ("-estimate_normals",
                   "estimate normals, even if the file has some or faces",
                   estimate_normals);
}

void
addEstimationOptions (Options& options, Parameters& parameters)
{
  options.add ("-preset",
               "NAME",
               "auto finds scale and significance by itself, paper is the\n"
               "                          method as published (default auto)",
               [&parameters] (const std::string& value) {
                 parameters.preset = value == "auto" ? Preset::AUTO : Preset::PAPER;
                 const bool known = value == "auto" || value == "paper";
                 return std::string (known ? "" : "auto or paper");
               });
  options.addNumber ("-angle",
                     withDefault ("auto: least turn of the surface across a line, in\n"
                                  "                          degrees",
                                  parameters.angle),
                     parameters.angle);
  options.addNumber (
      "-min_length",
      withDefault ("auto: least length of a line in spacings", parameters.min_length),
      parameters.min_length);
  options.addNumber ("-confidence",
                     withDefault ("auto: standard errors that crests stand out by",
                                  parameters.confidence),
                     parameters.confidence);
  options.add ("-positions",
               "WHERE",
               "auto: where lines run, crest or samples (default crest)",
               [&parameters] (const std::string& value) {
                 parameters.positions =
                     value == "samples" ? Positions::SAMPLES : Positions::CREST;
                 const bool known = value == "crest" || value == "samples";
                 return std::string (known ? "" : "crest or samples");
               });
  options.addNumber ("-k",
                     withDefault ("nearest neighbours to choose from", parameters.k),
                     parameters.k);
  options.add ("-radius",
               "N",
               "search radius in the unit of the file, in place of -k",
               [&parameters] (const std::string& value) {
                 std::string wanted = takeNumber (value, parameters.radius);
                 if (wanted.empty() && !(parameters.radius > 0.0))
                   wanted = "above 0";
                 return wanted;
               });
  parameters.batched_search = true;
  options.add ("-search",
               "NAME",
               "how to find the k neighbours, batched or PCL's kdtree\n"
               "                          (default batched; -radius takes the kdtree)",
               [&parameters] (const std::string& value) {
                 parameters.batched_search = value == "batched";
                 const bool known = value == "batched" || value == "kdtree";
                 return std::string (known ? "" : "batched or kdtree");
               });
  addPerType (
      options,
      "-M",
      withDefault (
          "paper: threshold on the maximality of curvature, in 1 /\n"
          "                          (a tenth of the largest side of the cloud)^2",
          parameters.maximality.ridge),
      parameters.maximality);
  options.addFlag ("-absolute",
                   "paper: take M in 1 / (the unit of the file)^2",
                   parameters.absolute_maximality);
  Parameters paper;
  paper.preset = Preset::PAPER;
  addPerType (options,
              "-S",
              "remove lines of fewer points than this (default " +
                  std::to_string (minSize (paper, CrestType::RIDGE)) +
                  " with\n                          -preset paper, " +
                  std::to_string (minSize (Parameters(), CrestType::RIDGE)) +
                  " with auto)",
              parameters.min_size);
  options.addNumber ("-strength",
                     withDefault ("remove lines along which |k1| adds up to less",
                                  parameters.min_strength),
                     parameters.min_strength);
  options.addNumber (
      "-prune",
      withDefault ("paper: prune branches of up to this many points", parameters.prune),
      parameters.prune);
  options.add ("-type",
               "TYPE",
               "ridges, valleys or both (default both)",
               [&parameters] (const std::string& value) {
                 parameters.wanted = {value != "valleys", value != "ridges"};
                 const bool known =
                     value == "ridges" || value == "valleys" || value == "both";
                 return std::string (known ? "" : "ridges, valleys or both");
               });
  options.addFlag (
      "-boundaries", "label the points where the surface ends", parameters.boundaries);
  options.addNumber (
      "-threads",
      withDefault ("threads; 0 takes all processors", parameters.threads),
      parameters.threads);
}

std::string
takeArguments (int argc,
               const char* const* argv,
               const std::vector<std::string>& names,
               Options& options,
               const Parameters& parameters,
               std::vector<std::string>& files)
{
  std::string error;
  if (!options.parse (argc, argv, files, error))
    return error;
  if (files.size() != names.size()) {
    error = "expected";
    for (const std::string& name : names)
      error += (name == names.front() ? " " : " and ") + name;
    return error + ", found " + std::to_string (files.size()) +
           (files.size() == 1 ? " file" : " files");
  }
  if (options.given ("-k") && options.given ("-radius"))
    return "the options -k and -radius exclude each other: give one of them";
  if (options.given ("-radius") && options.given ("-search") &&
      parameters.batched_search)
    return "the batched search has no radius: give -search kdtree, or -k";
  const bool paper = parameters.preset == Preset::PAPER;
  const std::vector<std::string> of_other_preset =
      paper ? std::vector<std::string>{"-angle",
                                       "-min_length",
                                       "-confidence",
                                       "-positions"}
            : std::vector<std::string>{
                  "-M", "-M_ridge", "-M_valley", "-absolute", "-prune"};
  for (const std::string& option : of_other_preset)
    if (options.given (option))
      return "the option " + option + " belongs to -preset " +
             (paper ? "auto, and has no meaning in the paper's method"
                    : "paper: auto has -angle, -min_length and -confidence in its "
                      "place");
  return explainInvalid (parameters);
}

} // namespace crest
} // namespace pcl
