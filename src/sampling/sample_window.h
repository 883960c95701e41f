// SPDX-License-Identifier: BSD-3-Clause
// Room sampling: how a cloud was sampled, and samples gathered to nodes where single
// ones tell nothing of the surface.
//
// Positions go in, findings and nodes come out. It knows no normals.
#pragma once

#include <Eigen/Core>

#include "search/leaf_search.h"

#include <array>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {

/** How many neighbours the windows hold around a sample. */
constexpr std::array<int, 3> WINDOW_SIZES{24, 96, 384};

/** \brief What windows of growing size around one sample tell of how its surface was
 * sampled, in the unit of the tree.
 */
struct SampleWindow {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /** that of as many samples spread evenly over the widest window */
  double spacing = 0.0;
  /** what a quadric leaves of the heights in each window, standard deviations */
  std::array<double, 3> noise{};
  /** what a cubic leaves of the smallest, standard deviation */
  double cubic_noise = 0.0;
  /** the mean product of the widest window's residuals, of pairs up to 1.5, 3 and 5
   * spacings apart, and that of each with itself */
  std::array<double, 3> covariance{};
  double variance = 0.0;
  /** their fourth moment over the square of the second: 3 for noise, 1 for two sheets
   */
  double kurtosis = 3.0;
  /** spacing as places between samples see it, and as samples see it: the same for
   * random ones, the latter twice the former for even ones, and far less where samples
   * lie in clumps or lines (Diggle 2013, functions F and G) */
  double empty_spacing = 0.0;
  double sample_spacing = 0.0;
  /** second moments of the steps to the nearest four: the larger over the smaller */
  double anisotropy = 1.0;
  /** normal of the smallest window */
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /** whether the smallest window is exactly flat and the widest is not */
  bool is_flat = false;
  /** whether the widest then lies on a few planes parallel to that, and whether these
   * lie beside each other, as the steps of a surface do, not over each other as two
   * sheets do */
  bool is_stepped = false;
  bool is_single = false;
};

/** \brief Measures windows. One such object belongs to one thread. */
class WindowMeasure {
public:
  /** \brief The least neighbours that tell anything. */
  static constexpr int LEAST = 64;

  /** \param[in] tree has to outlive this
   *
   * \param[in] widest neighbours of the widest window, at most the last of WINDOW_SIZES
   */
  WindowMeasure (const PointTree& tree, int widest);

  /** \brief Measures around a sample.
   * \param[in] place in the tree
   * \param[out] window what is found
   * \return whether anything can be: false where too few samples are around, or all on
   * a line
   */
  bool
  measure (std::int32_t place, SampleWindow& window);

private:
  bool
  fitWindow (int samples, int size, SampleWindow& window);
  void
  correlate (SampleWindow& window) const;
  void
  measureSpacings (SampleWindow& window) const;
  void
  lookForSteps (SampleWindow& window);

  const PointTree& tree_;
  LeafSearch search_;
  int widest_;
  /** from the sample to its neighbours, nearest first, in the tree's unit */
  Eigen::Matrix3Xd steps_;
  /** the last window in its own axes, and there over its radius */
  Eigen::Matrix3Xd local_;
  double radius_ = 0.0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> terms_;
  Eigen::RowVectorXd residuals_;
  std::vector<std::pair<double, int>> heights_;
};

} // namespace crest
} // namespace pcl
