// SPDX-License-Identifier: BSD-3-Clause
#include "presets/analysis_contents.h"

#include <sstream>

namespace pcl {
namespace crest {

std::shared_ptr<const SurfaceAnalysis>
makeAnalysis (AnalysisContents contents)
{
  return std::shared_ptr<const SurfaceAnalysis> (
      new SurfaceAnalysis (std::move (contents)));
}

const AnalysisContents&
contentsOf (const SurfaceAnalysis& analysis)
{
  return *analysis.contents_;
}

SurfaceAnalysis::SurfaceAnalysis (AnalysisContents contents)
: contents_ (std::make_unique<const AnalysisContents> (std::move (contents)))
{}

SurfaceAnalysis::~SurfaceAnalysis() = default;

index_t
SurfaceAnalysis::size() const
{
  return static_cast<index_t> (contents_->points->size());
}

Sample
SurfaceAnalysis::sample (index_t i) const
{
  const OrientedPoints& points = *contents_->points;
  const SurfaceShape& shape = *contents_->shape;
  return {points.cloud_index[i],
          points.positions[i],
          points.normals[i],
          shape.graph.spacing[i],
          shape.graph.boundary[i] != 0,
          shape.curvature[i]};
}

index_t
SurfaceAnalysis::sampleOf (index_t point) const
{
  return contents_->points->packed_index[point];
}

std::string
explainOtherShape (const Parameters& made_with, const Parameters& wanted)
{
  const auto explain = [] (const std::string& name, auto made, auto now) {
    std::ostringstream text;
    text << name << " " << made << ", not " << now;
    return text.str();
  };
  const Parameters& m = made_with;
  if (m.preset != wanted.preset)
    return explain ("the preset", nameOf (m.preset), nameOf (wanted.preset));
  if (m.radius != wanted.radius)
    return explain ("the radius", m.radius, wanted.radius);
  if (m.radius == 0.0 && m.k != wanted.k)
    return explain ("k =", m.k, wanted.k);
  if (m.points_per_quadrant != wanted.points_per_quadrant)
    return explain (
        "points per quadrant", m.points_per_quadrant, wanted.points_per_quadrant);
  if (m.max_normal_angle != wanted.max_normal_angle)
    return explain (
        "a largest normal angle of", m.max_normal_angle, wanted.max_normal_angle);
  return {};
}

bool
haveSameTrace (const Parameters& a, const Parameters& b)
{
  return a.angle == b.angle && a.min_length == b.min_length &&
         a.confidence == b.confidence && a.prune == b.prune &&
         a.absolute_maximality == b.absolute_maximality &&
         a.maximality.ridge == b.maximality.ridge &&
         a.maximality.valley == b.maximality.valley;
}

} // namespace crest
} // namespace pcl
