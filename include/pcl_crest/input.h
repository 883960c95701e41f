// SPDX-License-Identifier: BSD-3-Clause
// What goes in: a cloud as plain arrays, what is found of how it was sampled, and
// searches for neighbours in it.
#pragma once

#include <pcl_crest/types.h>

#include <Eigen/Core>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Where a cloud keeps its positions and normals: three floats each, at
 * `position + i * stride` and `normal + i * normal_stride`, strides in floats.
 */
struct PointView {
  const float* position;
  /** null where it has none */
  const float* normal;
  std::size_t stride;
  std::size_t size;
  /** 0 where it is the same stride */
  std::size_t normal_stride = 0;

  Eigen::Vector3f
  positionOf (std::size_t i) const
  {
    return Eigen::Map<const Eigen::Vector3f> (position + i * stride);
  }
  Eigen::Vector3f
  normalOf (std::size_t i) const
  {
    return Eigen::Map<const Eigen::Vector3f> (
        normal + i * (normal_stride != 0 ? normal_stride : stride));
  }
};

/** \brief Why single samples do not tell the surface. */
enum class SamplingFlaw {
  NONE,
  /** samples lie in clumps or along lines: their distances are not those of the
   * surface */
  CLUMPS,
  /** depths in steps */
  DEPTH_STEPS,
  /** positions in steps, along all axes */
  GRID_STEPS,
  /** noise that neighbouring samples share */
  CORRELATED_NOISE,
  /** two sheets less than a spacing apart, neither of which is complete */
  TWO_SCANS,
  /** noise of each sample by itself, nearly as much as samples are apart */
  WHITE_NOISE
};

/** \brief How a cloud was sampled: medians over windows of neighbours, all lengths in
 * its unit.
 */
struct SamplingFindings {
  /** between samples as the places between them see it; 0 where too few are there */
  double spacing = 0.0;
  /** second moments of the steps to the nearest, the larger over the smaller */
  double anisotropy = 1.0;
  /** what a quadric leaves of 24, 96 and 384 neighbours' heights, standard deviations,
   * where that is least, in the first quarter of the windows: the same for white noise,
   * growing for correlated noise and for relief */
  std::array<double, 3> noise{};
  /** points that were gathered to nodes, and the nodes that the lines are found on; 0
   * where samples will do */
  std::size_t gathered = 0;
  std::size_t nodes = 0;
  /** between nodes where points were gathered */
  double resolving_spacing = 0.0;
  /** how many windows have each flaw, by SamplingFlaw; white noise is told of the
   * cloud, and 1 or 0 */
  std::array<std::size_t, 7> flaws{};
};

/** \brief What was found, in one line for the user; empty where too few samples are
 * there to tell.
 */
PCL_CREST_EXPORT std::string
explainSampling (const SamplingFindings& findings);

/** \brief How a cloud was sampled, and what its samples were gathered to. The
 * estimation of normals that gathers them has it (NormalEstimate::nodes); an extraction
 * from the same cloud that is given it does not measure that again.
 */
struct SampleNodes;

/** \brief Squared distances that differ by less than this part are equal. The equal
 * steps of a scanner or mesher are not quite equal in a file of six digits, nor in
 * floats, and less so after a change of unit: which is the shorter must not depend on
 * that.
 */
constexpr double EQUIDISTANT = 1e-3;

/** \brief Finds the candidate neighbours of a point (paper, section 4.1), both by
 * their indices in what is searched. Any order; may hold the point itself, and points
 * twice; must be callable from several threads at once.
 */
using NeighborSearch = std::function<void (index_t point, std::vector<index_t>& found)>;

/** \brief Makes a search over points: for the k nearest of each, itself among them and
 * all that are EQUIDISTANT with the last, or for all within the radius where that is
 * positive. The points are copied, or used only while the search is made.
 */
using SearchMaker = std::function<NeighborSearch (
    const std::vector<Eigen::Vector3f>& points, int k, double radius)>;

/** \brief Finds points of another cloud in a cloud, by their exact positions.
 * \param[in] cloud, indices the points to find
 * \param[in] surface where to find them
 * \param[out] found for each of the indices the point of the surface that is there, of
 * several one with a normal, or -1 where the position is not finite
 *
 * \return the first of the indices whose finite position no point of the surface has,
 * or -1 if there is none
 */
PCL_CREST_EXPORT index_t
locatePoints (const PointView& cloud,
              const std::vector<index_t>& indices,
              const PointView& surface,
              std::vector<index_t>& found);

} // namespace crest
} // namespace pcl
