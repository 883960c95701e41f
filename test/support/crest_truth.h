// SPDX-License-Identifier: BSD-3-Clause
// The exact crest lines of an analytic surface, and how near a result comes to them.
#pragma once

#include <pcl_crest/crest_line.h>

#include "analytic_surface.h"

namespace oracle {

/** \brief Exact differential geometry at one point of a surface; signs as in
 * pcl::crest: positive where convex seen from the side of the normal.
 */
struct SurfacePoint {
  Eigen::Vector3d position;
  double k1, k2;
  Eigen::Vector3d t1;
  /** derivative of k1 in the direction t1 (the extremality) */
  double extremality;
  /** t1 in the parameter domain, scaled to unit length on the surface */
  Eigen::Vector2d direction;
};

/** \brief From the surface's derivatives up to the third order. */
SurfacePoint
geometryAt (const AnalyticSurface& surface, double u, double v);

/** \brief A piece of a true crest line. */
struct TruthSegment {
  Eigen::Vector3d a, b;
  pcl::crest::CrestType type;
  /** |k1| and how fast it falls to the sides, |k1''| */
  double curvature, sharpness;
};

/** \brief Where the extremality crosses zero at a maximum of |k1| (Ohtake, Belyaev and
 * Seidel 2004), found on a grid of the domain with `cells` cells a side.
 */
std::vector<TruthSegment>
trueCrestLines (const AnalyticSurface& surface, int cells = 500);

/** \brief Lines of one type against the truth. */
struct Score {
  /** part of the drawn length that lies within the tolerance of a true line */
  double precision = 0.0;
  /** part of the salient true length that lies within the tolerance of a drawn line */
  double recall = 0.0;
  double drawn_length = 0.0;
  /** part of the true length that is salient */
  double salient_part = 0.0;
};

/** \brief Scores lines of one type. Salient is a true line whose sharpness is at least
 * .3 of the 90th percentile and not far below its curvature's cube (-k1'' > .1 |k1|^3):
 * the rest is true too, but nothing that a threshold should have to keep.
 */
Score
score (const std::vector<pcl::crest::CrestLine>& lines,
       const pcl::PointCloud<pcl::PointNormal>& cloud,
       const std::vector<TruthSegment>& truth,
       pcl::crest::CrestType type,
       double tolerance);

/** \brief The part of a truth that a person would draw: the surface turns by at least
 * 34 degrees across it (4/3 sqrt (2 / q), q = sharpness / curvature^3), and it is at
 * least a quarter as strongly curved as the strongest of its type.
 */
std::vector<TruthSegment>
salientLines (const std::vector<TruthSegment>& truth);

/** \brief Lines of one type against all true lines (precision, error) and the salient
 * ones (recall).
 */
struct LineScore {
  double precision = 0.0;
  double recall = 0.0;
  /** mean distance of the precise part to the truth, in units of the tolerance */
  double error = 0.0;
  double drawn_length = 0.0;
  double salient_length = 0.0;
};
LineScore
scoreLines (const std::vector<pcl::crest::CrestLine>& lines,
            const pcl::PointCloud<pcl::PointNormal>& line_cloud,
            const std::vector<TruthSegment>& truth,
            pcl::crest::CrestType type,
            double tolerance);

} // namespace oracle
