// SPDX-License-Identifier: BSD-3-Clause
#include "point_colors.h"

#include "io/crest_colors.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

constexpr CrestScene::Color GREY{217, 217, 217};

/** \brief What 95 of 100 absolute values stay below. */
double
usualLargest (std::vector<float> values)
{
  for (float& value : values)
    value = std::isfinite (value) ? std::abs (value) : 0.0F;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t> (values.size() * 95 / 100);
  std::nth_element (values.begin(), place, values.end());
  return *place;
}

} // namespace

CrestScene::Color
colorOf (double part)
{
  constexpr CrestScene::Color BLUE{20, 60, 220};
  constexpr CrestScene::Color RED{220, 30, 20};
  const double t = std::isfinite (part) ? std::clamp (part, -1.0, 1.0) : 0.0;
  const CrestScene::Color& end = t < 0.0 ? RED : BLUE;
  CrestScene::Color color{};
  for (std::size_t i = 0; i < 3; ++i)
    color[i] = static_cast<unsigned char> (
        std::lround (GREY[i] + std::abs (t) * (end[i] - GREY[i])));
  return color;
}

PointColors
colorPoints (const CrestSession& session, ColorMode mode)
{
  PointColors result;
  if (mode == ColorMode::SHADED)
    return result;
  if (mode == ColorMode::FILE) {
    result.title = "colors of the file";
    result.colors = session.getCloud().colors;
    return result;
  }
  if (mode == ColorMode::LABEL) {
    result.title = "labels";
    for (const pcl::Label& label : session.getLabels())
      result.colors.push_back (colorOfLabel (label.label));
    return result;
  }
  if (mode == ColorMode::BOUNDARY) {
    result.title = "boundary";
    const SurfaceAnalysis& analysis = session.getAnalysis();
    for (std::size_t i = 0; i < session.getLabels().size(); ++i) {
      const index_t sample = analysis.sampleOf (static_cast<index_t> (i));
      result.colors.push_back (sample >= 0 && analysis.sample (sample).boundary
                                   ? colorOfLabel (LABEL_BOUNDARY)
                                   : GREY);
    }
    return result;
  }
  std::vector<float> values;
  for (const pcl::PrincipalCurvatures& curvature : session.getCurvatures())
    values.push_back (mode == ColorMode::K1 ? curvature.pc1 : curvature.pc2);
  result.title = mode == ColorMode::K1 ? "k1" : "k2";
  result.largest = usualLargest (values);
  for (const float value : values)
    result.colors.push_back (
        colorOf (result.largest > 0.0 ? value / result.largest : 0.0));
  return result;
}

} // namespace crest
} // namespace pcl
