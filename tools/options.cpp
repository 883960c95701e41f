// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include <boost/algorithm/string.hpp>

#include <sstream>

namespace pcl {
namespace crest {

namespace po = boost::program_options;

namespace {

/** \brief What has a dash is the name of an option, all of it. Boost's styles would
 * take "--k 5" and "-k=5" as well, and "-" for no option.
 */
std::vector<po::option>
takeName (std::vector<std::string>& arguments)
{
  if (!boost::starts_with (arguments[0], "-"))
    return {};
  const po::option option (arguments[0], {});
  arguments.erase (arguments.begin());
  return {option};
}

template <typename T>
std::string
withDefault (const std::string& help, const T& value)
{
  std::ostringstream text;
  text << help << " (default " << value << ")";
  return text.str();
}

/** \brief Takes "X,Y,Z"; returns what would be right, if it is not. */
std::string
takePlace (const std::string& text, Eigen::Vector3d& place)
{
  std::vector<std::string> words;
  boost::split (words, text, boost::is_any_of (","));
  std::string wanted = "three numbers X,Y,Z";
  if (words.size() != 3)
    return wanted;
  for (int i = 0; i < 3; ++i) {
    if (!takeNumber (words[static_cast<std::size_t> (i)], place[i]).empty())
      return wanted;
  }
  return place.allFinite() ? std::string() : wanted;
}

/** \brief Adds the option for both types and, to win over it, the one for each. */
template <typename T>
void
addPerType (Options& options,
            const std::string& name,
            const std::string& help,
            PerType<T>& numbers)
{
  const auto takeBoth = [&numbers] (const std::string& text) {
    std::string wanted = takeNumber (text, numbers.ridge);
    numbers.valley = numbers.ridge;
    return wanted;
  };
  auto add = options.add_options();
  add (name.c_str(), value ("N", takeBoth), help.c_str());
  add ((name + "_ridge").c_str(),
       number (numbers.ridge),
       (name + " of ridges alone").c_str());
  add ((name + "_valley").c_str(),
       number (numbers.valley),
       (name + " of valleys alone").c_str());
}

} // namespace

OptionValue*
value (const std::string& name,
       const std::function<std::string (const std::string&)>& take)
{
  return po::value<std::string>()->value_name (name)->notifier (
      [take] (const std::string& text) {
        const std::string wanted = take (text);
        if (!wanted.empty())
          throw po::error ("is \"" + text + "\", but must be " + wanted);
      });
}

OptionValue*
flag (bool& given)
{
  return po::value (&given)->zero_tokens();
}

OptionValue*
fileName (const std::string& name, std::string& file)
{
  return value (name, [&file] (const std::string& text) {
    file = text;
    return std::string (text.empty() ? "the name of a file" : "");
  });
}

std::string
parse (int argc, const char* const* argv, const Options& options, Arguments& arguments)
{
  using namespace po::command_line_style;
  std::string name;
  try {
    const po::parsed_options parsed = po::command_line_parser (argc, argv)
                                          .options (options)
                                          .style (allow_long_disguise | long_allow_next)
                                          .extra_style_parser (takeName)
                                          .allow_unregistered()
                                          .run();
    for (const po::option& option : parsed.options)
      if (option.unregistered)
        return "there is no option \"" + option.string_key + "\"";
      else if (option.string_key.empty())
        arguments.files.push_back (option.value[0]);
    po::store (parsed, arguments.options);
    // Not po::notify, whose order is that of the alphabet.
    for (const auto& option : options.options()) {
      name = option->long_name();
      if (arguments.options.count (name) != 0)
        option->semantic()->notify (arguments.options[name].value());
    }
  }
  catch (const po::invalid_command_line_syntax& wrong) {
    name = wrong.get_option_name();
    return "the option " + name + " needs a value, " +
           options.find (name, false).format_parameter();
  }
  catch (const po::multiple_occurrences& wrong) {
    return "the option " + wrong.get_option_name() + " is given twice";
  }
  catch (const po::error& wrong) {
    return "the option " + name + " " + wrong.what();
  }
  return {};
}

Options
allOptions (const std::vector<OptionGroup>& groups)
{
  Options all;
  for (const OptionGroup& group : groups)
    all.add (group.options);
  return all;
}

std::string
usage (const Options& options)
{
  constexpr std::size_t HELP_COLUMN = 26;
  const std::string next_line = "\n" + std::string (HELP_COLUMN, ' ');
  std::string text;
  for (const auto& option : options.options()) {
    std::string line = "  " + option->long_name() + " " + option->format_parameter();
    line.resize (HELP_COLUMN, ' ');
    line += boost::replace_all_copy (option->description(), "\n", next_line);
    text += line + "\n";
  }
  return text;
}

std::string
usage (const std::vector<OptionGroup>& groups)
{
  std::string text;
  for (const OptionGroup& group : groups)
    text += (text.empty() ? "" : "\n") + group.title + ":\n" + usage (group.options);
  return text;
}

void
addQuestions (Options& options, bool& asked)
{
  options.add_options() (
      "-h", flag (asked), "show this and do nothing else; so does --help") (
      "-version", flag (asked), "show version, presets and kernels; so does --version");
}

void
addReadingOptions (Options& options, ReadOptions& reading)
{
  const auto takeFormat = [&reading] (const std::string& text) {
    reading.format = text;
    return explainInvalid (reading).empty() ? std::string()
                                            : boost::join (readFormats(), ", ");
  };
  const auto takeColumns = [&reading] (const std::string& text) {
    boost::split (reading.columns, text, boost::is_any_of (","));
    return explainInvalid (reading).empty()
               ? std::string()
               : "x, y, z and perhaps nx, ny, nz, r, g, b, intensity, once each, or - "
                 "for other columns, as in x,y,z,-,nx,ny,nz";
  };
  const auto takeClasses = [&reading] (const std::string& text) {
    std::vector<std::string> words;
    boost::split (words, text, boost::is_any_of (","));
    for (const std::string& word : words)
      if (!takeNumber (word, reading.classes.emplace_back()).empty())
        return std::string ("whole numbers from 0 to 255, as in 2 or 2,6");
    return std::string();
  };
  NormalOptions& normals = reading.normals;
  const auto takeDirection = [&normals] (const std::string& text) {
    Eigen::Vector3d taken = Eigen::Vector3d::Zero();
    const bool is_place = takePlace (text, taken).empty();
    const Eigen::Vector3f up = taken.cast<float>();
    if (!is_place || !up.allFinite() || up.isZero (0.0F))
      return std::string ("three numbers X,Y,Z that are not all 0");
    normals.up = up;
    return std::string();
  };
  const auto takeViewpoint = [&normals] (const std::string& text) {
    Eigen::Vector3d taken;
    std::string wanted = takePlace (text, taken);
    if (wanted.empty())
      normals.viewpoint = taken;
    return wanted;
  };
  const auto takeSampling = [&reading] (const std::string& text) {
    reading.samples_faces = text != "off";
    if (!reading.samples_faces)
      return std::string();
    const bool is_number = takeNumber (text, reading.sample_spacing).empty();
    return is_number && reading.sample_spacing > 0.0 && explainInvalid (reading).empty()
               ? std::string()
               : std::string ("a number above 0, or off");
  };
  options.add_options() (
      "-format",
      value ("FORMAT", takeFormat),
      ("what the input is, whatever its name:\n" + boost::join (readFormats(), " "))
          .c_str()) (
      "-columns",
      value ("NAMES", takeColumns),
      "what the columns of text are, as in x,y,z,-,nx,ny,nz,intensity\nor r,g,b; - for "
      "any other (default: told by names or values)") (
      "-class",
      value ("CODES", takeClasses),
      "of LAS, the classes of points to read, as in 2 or 2,6\n(default: all)") (
      "-sample",
      value ("SPACING|off", takeSampling),
      "samples of faces in place of vertices: how far apart, in the\nunit of the file, "
      "or "
      "off (default: where vertices tell too\nlittle, as those of CAD meshes, as far "
      "as "
      "features need)") ("-estimate_normals",
                         flag (normals.always_estimate),
                         "estimate normals, even if the file has some or faces") (
      "-viewpoint",
      value ("X,Y,Z", takeViewpoint),
      "where estimated normals look to on open surfaces, in the\ncoordinates of the "
      "file") ("-up",
               value ("X,Y,Z", takeDirection),
               "where they look to if nothing else tells (default 0,0,1)");
}

void
addEstimationOptions (Options& options, Parameters& parameters)
{
  auto add = options.add_options();
  const auto addNumber =
      [&add] (const char* name, const std::string& help, auto& target) {
        add (name, number (target), withDefault (help, target).c_str());
      };
  std::vector<std::pair<std::string, Preset>> preset_names;
  for (const Preset preset : presets())
    preset_names.emplace_back (nameOf (preset), preset);
  add ("-preset",
       oneOf ("NAME", preset_names, parameters.preset),
       withDefault ("auto finds scale and significance by itself, paper is the\n"
                    "method as published",
                    nameOf (parameters.preset))
           .c_str());
  addNumber ("-angle",
             "auto: least turn of the surface across a line, in\ndegrees",
             parameters.angle);
  addNumber (
      "-min_length", "auto: least length of a line in spacings", parameters.min_length);
  addNumber ("-confidence",
             "auto: standard errors that crests stand out by",
             parameters.confidence);
  add ("-positions",
       oneOf<Positions> ("WHERE",
                         {{"crest", Positions::CREST}, {"samples", Positions::SAMPLES}},
                         parameters.positions),
       "auto: where lines run, crest or samples (default crest)");
  addNumber ("-k", "nearest neighbours to choose from", parameters.k);
  add ("-radius",
       value ("N",
              [&radius = parameters.radius] (const std::string& text) {
                const std::string wanted = takeNumber (text, radius);
                return wanted.empty() && !(radius > 0.0) ? "above 0" : wanted;
              }),
       "search radius in the unit of the file, in place of -k");
  parameters.batched_search = true;
  add ("-search",
       oneOf<bool> (
           "NAME", {{"batched", true}, {"kdtree", false}}, parameters.batched_search),
       "how to find the k neighbours, batched or PCL's kdtree\n"
       "(default batched; -radius takes the kdtree)");
  addPerType (options,
              "-M",
              withDefault ("paper: threshold on the maximality of curvature, in 1 /\n"
                           "(a tenth of the largest side of the cloud)^2",
                           parameters.maximality.ridge),
              parameters.maximality);
  add ("-absolute",
       flag (parameters.absolute_maximality),
       "paper: take M in 1 / (the unit of the file)^2");
  Parameters paper;
  paper.preset = Preset::PAPER;
  addPerType (options,
              "-S",
              "remove lines of fewer points than this (default " +
                  std::to_string (minSize (paper, CrestType::RIDGE)) +
                  " with\n-preset paper, " +
                  std::to_string (minSize (Parameters(), CrestType::RIDGE)) +
                  " with auto)",
              parameters.min_size);
  addNumber ("-strength",
             "remove lines along which |k1| adds up to less",
             parameters.min_strength);
  addNumber (
      "-prune", "paper: prune branches of up to this many points", parameters.prune);
  add ("-type",
       oneOf<PerType<bool>> ("TYPE",
                             {{"ridges", {true, false}},
                              {"valleys", {false, true}},
                              {"both", {true, true}}},
                             parameters.wanted),
       "ridges, valleys or both (default both)");
  add ("-boundaries",
       flag (parameters.boundaries),
       "label the points where the surface ends");
  addNumber ("-threads", "threads; 0 takes all processors", parameters.threads);
}

std::string
takeArguments (int argc,
               const char* const* argv,
               const std::vector<std::string>& names,
               const Options& options,
               const Parameters& parameters,
               Arguments& arguments)
{
  std::string error = parse (argc, argv, options, arguments);
  if (!error.empty())
    return error;
  const std::size_t files = arguments.files.size();
  if (files != names.size())
    return "expected " + boost::join (names, " and ") + ", found " +
           std::to_string (files) + (files == 1 ? " file" : " files");
  for (std::size_t i = 0; i < files; ++i)
    if (arguments.files[i].empty())
      return "expected the name of a file for " + names[i] + ", found \"\"";
  const auto given = [&arguments] (const std::string& name) {
    return arguments.options.count (name) != 0;
  };
  if (given ("-k") && given ("-radius"))
    return "the options -k and -radius exclude each other: give one of them";
  if (given ("-radius") && given ("-search") && parameters.batched_search)
    return "the batched search has no radius: give -search kdtree, or -k";
  const bool paper = parameters.preset == Preset::PAPER;
  std::vector<std::string> strangers{
      "-angle", "-min_length", "-confidence", "-positions"};
  if (!paper)
    strangers = {"-M", "-M_ridge", "-M_valley", "-absolute", "-prune"};
  for (const std::string& option : strangers)
    if (given (option))
      return "the option " + option + " belongs to -preset " +
             nameOf (paper ? Preset::AUTO : Preset::PAPER) +
             (paper ? ", and has no meaning in the paper's method"
                    : ": auto has -angle, -min_length and -confidence in its place");
  return explainInvalid (parameters);
}

} // namespace crest
} // namespace pcl
