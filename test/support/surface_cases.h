// SPDX-License-Identifier: BSD-3-Clause
// The surfaces that the whole method is measured on.
#pragma once

#include <pcl_crest/parameters.h>

#include "analytic_surface.h"

#include <ostream>
#include <vector>

namespace oracle {

/** \brief A surface with the M that suits its ridges and valleys, in 1 / (its unit)^2.
 * One M for all surfaces there is not: that is a limit of the paper's method.
 */
struct SurfaceCase {
  AnalyticSurface surface;
  pcl::crest::PerType<double> maximality;
  /** types of which the surface has salient lines */
  std::vector<pcl::crest::CrestType> types;

  pcl::crest::Parameters
  parameters () const
  {
    pcl::crest::Parameters result;
    result.preset = pcl::crest::Preset::PAPER;
    result.maximality = maximality;
    result.absolute_maximality = true;
    return result;
  }
};

inline std::ostream&
operator<< (std::ostream& stream, const SurfaceCase& c)
{
  return stream << c.surface.name;
}

inline std::vector<SurfaceCase>
surfaceCases ()
{
  using pcl::crest::CrestType;
  const std::vector<CrestType> ridges{CrestType::RIDGE};
  const std::vector<CrestType> both{CrestType::RIDGE, CrestType::VALLEY};
  return {{ellipsoid (1.0, 0.7, 0.45), {0.06, 0.06}, ridges},
          {wavyRidge(), {3.0, 0.3}, both},
          {bumpySphere(), {1.0, 0.3}, both},
          {ellipticTorus(), {0.3, 0.3}, ridges},
          {ridgeAndValley(), {0.1, 0.1}, both},
          {roundedBox(), {0.03, 0.03}, ridges}};
}

} // namespace oracle
