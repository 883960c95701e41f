// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/write_statistics.h>

#include "base/parallel.h"
#include "io/output_file.h"
#include <nlohmann/json.hpp>

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

using Json = nlohmann::ordered_json;

const char*
nameOf (CrestType type)
{
  return type == CrestType::RIDGE ? "ridge" : "valley";
}

std::size_t
countLabel (const pcl::PointCloud<pcl::Label>& labels, Label wanted)
{
  return static_cast<std::size_t> (
      std::count_if (labels.begin(), labels.end(), [wanted] (const pcl::Label& label) {
        return label.label == wanted;
      }));
}

Json
describe (const Parameters& p)
{
  Json json;
  if (p.radius > 0.0)
    json["radius"] = p.radius;
  else
    json["k"] = p.k;
  json["search"] = p.batched_search && !(p.radius > 0.0) ? "batched" : "kdtree";
  json["preset"] = nameOf (p.preset);
  json["points_per_quadrant"] = p.points_per_quadrant;
  json["max_normal_angle"] = p.max_normal_angle;
  if (p.preset == Preset::PAPER) {
    json["M_ridge"] = p.maximality.ridge;
    json["M_valley"] = p.maximality.valley;
    json["absolute"] = p.absolute_maximality;
    json["prune"] = p.prune;
  }
  else {
    json["angle"] = p.angle;
    json["min_length"] = p.min_length;
    json["confidence"] = p.confidence;
    json["positions"] = p.positions == Positions::CREST ? "crest" : "samples";
  }
  json["S_ridge"] = minSize (p, CrestType::RIDGE);
  json["S_valley"] = minSize (p, CrestType::VALLEY);
  json["strength"] = p.min_strength;
  json["type"] = p.wanted.ridge && p.wanted.valley ? "both"
                 : p.wanted.ridge                  ? "ridges"
                                                   : "valleys";
  json["boundaries"] = p.boundaries;
  return json;
}

const char*
nameOf (NormalSide side)
{
  switch (side) {
  case NormalSide::OUTWARD:
    return "outward";
  case NormalSide::VIEWPOINT:
    return "viewpoint";
  case NormalSide::UP:
    break;
  }
  return "up";
}

/** \brief How sure the signs of estimated normals are, on the whole and of the largest
 * parts.
 */
Json
describe (const NormalEstimate& estimate)
{
  constexpr std::size_t LARGEST = 20;
  Json json;
  json["single_view"] = estimate.single_view;
  json["unsure_points"] = estimate.countUnsure();
  json["parts"] = estimate.parts.size();
  json["largest_parts"] = Json::array();
  for (std::size_t i = 0; i < std::min (LARGEST, estimate.parts.size()); ++i) {
    const NormalPart& part = estimate.parts[i];
    json["largest_parts"].push_back (
        {{"points", part.points}, {"side", nameOf (part.side)}, {"trust", part.trust}});
  }
  return json;
}

/** \brief What was found of normals that came with the points. */
Json
describe (const NormalFindings& findings)
{
  return {{"not_unit", findings.not_unit},
          {"missing", findings.missing},
          {"filled", findings.filled},
          {"turned", findings.turned},
          {"doubtful", findings.doubtful},
          {"guessed", findings.guessed},
          {"across", findings.across},
          {"inward", findings.inward}};
}

/** \brief How the points were sampled, lengths in the unit of the file. */
Json
describe (const SamplingFindings& sampling)
{
  Json json;
  json["spacing"] = sampling.spacing;
  json["anisotropy"] = sampling.anisotropy;
  json["noise"] = sampling.noise;
  json["gathered_points"] = sampling.gathered;
  json["nodes"] = sampling.nodes;
  json["resolving_spacing"] = sampling.resolving_spacing;
  const auto flawed = [&sampling] (SamplingFlaw flaw) {
    return sampling.flaws[static_cast<std::size_t> (flaw)];
  };
  json["flawed_windows"] = {
      {"clumps", flawed (SamplingFlaw::CLUMPS)},
      {"depth_steps", flawed (SamplingFlaw::DEPTH_STEPS)},
      {"grid_steps", flawed (SamplingFlaw::GRID_STEPS)},
      {"correlated_noise", flawed (SamplingFlaw::CORRELATED_NOISE)},
      {"two_scans", flawed (SamplingFlaw::TWO_SCANS)},
      {"white_noise", flawed (SamplingFlaw::WHITE_NOISE)}};
  return json;
}

Json
describe (CrestType type,
          const pcl::PointCloud<pcl::Label>& labels,
          const std::vector<CrestLine>& crest_lines,
          const LineSizes& sizes)
{
  const bool ridge = type == CrestType::RIDGE;
  std::size_t lines = 0;
  double length = 0.0;
  for (const CrestLine& line : crest_lines)
    if (line.type == type) {
      ++lines;
      length += line.length;
    }
  Json json;
  json["crest_points"] = countLabel (labels, ridge ? LABEL_RIDGE : LABEL_VALLEY);
  json["grown_points"] =
      countLabel (labels, ridge ? LABEL_RIDGE_GROWN : LABEL_VALLEY_GROWN);
  json["lines"] = lines;
  json["total_length"] = length;
  json["line_sizes_before_S"] = Json::array();
  for (const auto& [size, count] : sizes)
    json["line_sizes_before_S"].push_back ({{"size", size}, {"lines", count}});
  return json;
}

const char*
nameOf (LineEnd end)
{
  switch (end) {
  case LineEnd::JUNCTION:
    return "junction";
  case LineEnd::BOUNDARY:
    return "boundary";
  case LineEnd::CLOSED:
    return "closed";
  default:
    return "free";
  }
}

Json
describe (const CrestLine& line, Preset preset)
{
  Json json;
  json["type"] = nameOf (line.type);
  json["size"] = line.size;
  json["length"] = line.length;
  json["closed"] = line.closed;
  json["strength"] = line.strength;
  json["mean_curvature"] = line.mean_curvature;
  if (preset == Preset::AUTO) {
    json["turning_angle"] = line.turning_angle;
    json["scale"] = line.scale;
  }
  json["sign_trust"] = line.sign_trust;
  json["ends"] = Json::array();
  for (const auto& [first, last] : line.ends)
    json["ends"].push_back ({nameOf (first), nameOf (last)});
  return json;
}

} // namespace

bool
writeStatistics (
    const std::string& file,
    const InputCloud& cloud,
    const pcl::PointCloud<pcl::Label>& labels,
    const Parameters& parameters,
    const std::vector<CrestLine>& lines,
    const pcl::CrestLineEstimation<pcl::PointNormal>::Statistics& statistics,
    const std::vector<StageTime>& times,
    std::string& error)
{
  Json json;
  json["points"] = cloud.points->size();
  if (cloud.sampled.faces != 0) {
    json["sampled_faces"] = cloud.sampled.faces;
    json["sample_spacing"] = cloud.sampled.spacing;
  }
  json["invalid_points"] = countLabel (labels, LABEL_INVALID);
  if (parameters.boundaries)
    json["boundary_points"] = countLabel (labels, LABEL_BOUNDARY);
  json["points_set_apart"] = cloud.placement.apart.size();
  const Eigen::Vector3d& offset = cloud.placement.offset;
  json["offset"] = {offset.x(), offset.y(), offset.z()};
  json["normals"] = nameOf (cloud.normals);
  if (cloud.estimate)
    json["orientation"] = describe (*cloud.estimate);
  if (statistics.sampling.spacing > 0.0)
    json["sampling"] = describe (statistics.sampling);
  if (statistics.normals)
    json["normal_check"] = describe (*statistics.normals);
  json["mean_spacing"] = statistics.mean_spacing;
  json["extent"] = statistics.extent;
  json["parameters"] = describe (parameters);
  for (const CrestType type : CREST_TYPES)
    json[nameOf (type)] = describe (type, labels, lines, statistics.line_sizes[type]);
  json["lines"] = Json::array();
  for (const CrestLine& line : lines)
    json["lines"].push_back (describe (line, parameters.preset));
  json["milliseconds"] = Json::object();
  for (const StageTime& time : times)
    json["milliseconds"][time.stage] = time.milliseconds;
  json["threads"] = threadCount (parameters.threads);
  return replaceFile (file, json.dump (2) + "\n", error);
}

bool
writeStatistics (const std::string& file,
                 const InputCloud& cloud,
                 const pcl::PointCloud<pcl::Label>& labels,
                 const pcl::CrestLineEstimation<pcl::PointNormal>& estimation,
                 const std::vector<StageTime>& times,
                 std::string& error)
{
  return writeStatistics (file,
                          cloud,
                          labels,
                          estimation.getParameters(),
                          estimation.getLines(),
                          estimation.getStatistics(),
                          times,
                          error);
}

} // namespace crest
} // namespace pcl
