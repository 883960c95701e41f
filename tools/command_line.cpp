// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include <boost/algorithm/string/join.hpp>

#include <array>
#include <charconv>

namespace pcl {
namespace crest {

namespace {

/** \brief A number in the fewest digits that are read back as the same one. */
template <typename T>
std::string
shortest (T number)
{
  std::array<char, 40> digits;
  const auto end =
      std::to_chars (digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

template <typename T>
std::string
option (const std::string& name, T value, T otherwise)
{
  return value == otherwise ? "" : " " + name + " " + shortest (value);
}

} // namespace

std::string
optionsOf (const Parameters& p)
{
  const Parameters unset;
  std::string text;
  if (p.preset != unset.preset)
    text += " -preset " + nameOf (p.preset);
  if (p.preset == Preset::PAPER) {
    text += option ("-M_ridge", p.maximality.ridge, unset.maximality.ridge);
    text += option ("-M_valley", p.maximality.valley, unset.maximality.valley);
    text += p.absolute_maximality ? " -absolute" : "";
    text += option ("-prune", p.prune, unset.prune);
  }
  else {
    text += option ("-angle", p.angle, unset.angle);
    text += option ("-min_length", p.min_length, unset.min_length);
    text += option ("-confidence", p.confidence, unset.confidence);
    text += p.positions == Positions::SAMPLES ? " -positions samples" : "";
  }
  if (p.radius > 0.0)
    text += option ("-radius", p.radius, 0.0);
  else {
    text += option ("-k", p.k, unset.k);
    text += p.batched_search ? "" : " -search kdtree";
  }
  if (p.min_size.ridge)
    text += " -S_ridge " + shortest (*p.min_size.ridge);
  if (p.min_size.valley)
    text += " -S_valley " + shortest (*p.min_size.valley);
  text += option ("-strength", p.min_strength, unset.min_strength);
  if (!p.wanted.ridge || !p.wanted.valley)
    text += p.wanted.ridge ? " -type ridges" : " -type valleys";
  text += p.boundaries ? " -boundaries" : "";
  return text;
}

std::string
optionsOf (const InputCloud& cloud)
{
  const ReadOptions& options = cloud.options;
  std::string text;
  if (!options.format.empty())
    text += " -format " + options.format;
  if (!options.columns.empty())
    text += " -columns " + boost::join (options.columns, ",");
  const char* separator = " -class ";
  for (const std::uint8_t code : options.classes) {
    text += separator + std::to_string (code);
    separator = ",";
  }
  if (!options.samples_faces)
    text += " -sample off";
  else if (options.sample_spacing > 0.0)
    text += " -sample " + shortest (options.sample_spacing);
  if (cloud.normals != NormalSource::ESTIMATED)
    return text;
  const auto place = [] (const auto& p) {
    return shortest (p.x()) + "," + shortest (p.y()) + "," + shortest (p.z());
  };
  text += " -estimate_normals";
  if (options.normals.viewpoint)
    text += " -viewpoint " + place (*options.normals.viewpoint);
  if (options.normals.up)
    text += " -up " + place (*options.normals.up);
  return text;
}

std::string
quoted (const std::string& word)
{
  constexpr char HARMLESS[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789_./-+=:,";
  if (!word.empty() && word.find_first_not_of (HARMLESS) == std::string::npos)
    return word;
  std::string text = "'";
  for (const char c : word)
    text += c == '\'' ? std::string ("'\\''") : std::string (1, c);
  return text + "'";
}

} // namespace crest
} // namespace pcl
