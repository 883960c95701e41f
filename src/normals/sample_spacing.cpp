// SPDX-License-Identifier: BSD-3-Clause
#include "normals/sample_spacing.h"

#include "base/parallel.h"
#include "base/quantile.h"
#include "search/leaf_search.h"
#include "search/position_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** \brief How far distances to the fourth nearest of points spread: about the standard
 * deviation of their logarithms. Infinite where most are 0.
 */
double
unevenness (const std::vector<Eigen::Vector3f>& points, const Workers& workers)
{
  constexpr int NEAREST = 4;
  // So many tell it well enough.
  constexpr std::size_t TRIED = 10000;
  const std::shared_ptr<const PointTree> tree = treeOver (points, workers.threads);
  const std::size_t step = (points.size() + TRIED - 1) / TRIED;
  std::vector<double> distances ((points.size() + step - 1) / step, 0.0);
  forEachBlock (distances.size(),
                workers,
                [&] (std::size_t, std::size_t first, std::size_t last) {
                  LeafSearch search (*tree, {NEAREST});
                  for (; first < last; ++first) {
                    const LeafNeighbors& found =
                        search.searchPoint (static_cast<std::int32_t> (first * step));
                    distances[first] =
                        std::log (found.squared_distances[found.offsets[1] - 1]) / 2.0;
                  }
                });
  const double low = quantile (distances, 16);
  return std::isfinite (low) ? (quantile (distances, 84) - low) / 2.0
                             : std::numeric_limits<double>::infinity();
}

/** \brief Whether the spacing grows with the distance from a place: worth a closer
 * look.
 */
bool
growsWithRange (const PlaneFits& fits, const Eigen::Vector3f& place)
{
  constexpr double LEAST_SLOPE = 0.3;
  constexpr double LEAST_CORRELATION = 0.3;
  double count = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const float range = (fits.positions[i] - place).norm();
    const float spacing = fits.spacing (i);
    if (!(range > 0.0F) || !(spacing > 0.0F))
      continue;
    const Eigen::Vector2d logs (std::log (range), std::log (spacing));
    count += 1.0;
    sum += logs;
    products += logs * logs.transpose();
  }
  if (count == 0.0)
    return false;
  const Eigen::Matrix2d covariance = products - sum * sum.transpose() / count;
  return covariance (0, 1) > LEAST_SLOPE * covariance (0, 0) &&
         covariance (0, 1) >
             LEAST_CORRELATION * std::sqrt (covariance (0, 0) * covariance (1, 1));
}

std::vector<Eigen::Vector3f>
placesOnMap (const PlaneFits& fits)
{
  std::vector<Eigen::Vector3f> places;
  places.reserve (fits.size());
  for (const Eigen::Vector3f& position : fits.positions)
    places.emplace_back (position.x(), position.y(), 0.0F);
  return places;
}

/** Points enough to speak of a spread. */
constexpr std::size_t LEAST_POINTS = 100;

} // namespace

bool
areSpacedAsSeenFrom (const PlaneFits& fits,
                     const Eigen::Vector3f& place,
                     const Workers& workers)
{
  constexpr double MORE_EVEN = 0.75;
  if (fits.size() < LEAST_POINTS || !growsWithRange (fits, place))
    return false;
  std::vector<Eigen::Vector3f> directions;
  for (const Eigen::Vector3f& position : fits.positions)
    if (position != place)
      directions.emplace_back ((position - place).stableNormalized());
  return unevenness (directions, workers) <
         MORE_EVEN * unevenness (fits.positions, workers);
}

bool
areSpacedAsOnMap (const PlaneFits& fits, const Workers& workers)
{
  constexpr double LESS_EVEN = 1.2;
  return fits.size() >= LEAST_POINTS &&
         unevenness (placesOnMap (fits), workers) <
             LESS_EVEN * unevenness (fits.positions, workers);
}

bool
areGridOfMap (const PlaneFits& fits, const Workers& workers)
{
  constexpr double ROUNDING = 0.01;
  return fits.size() >= LEAST_POINTS &&
         unevenness (placesOnMap (fits), workers) < ROUNDING;
}

} // namespace crest
} // namespace pcl
