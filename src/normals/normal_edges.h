// SPDX-License-Identifier: BSD-3-Clause
// The graph of nearest neighbours that signs of normals are carried along.
#pragma once

#include <pcl_crest/types.h>

#include <Eigen/Core>

#include <functional>
#include <tuple>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Finds the nearest of some points to one of them, itself among these, and
 * their squared distances, the nearest first. Must be callable from several threads at
 * once.
 */
using NearestSearch = std::function<void (
    index_t point, std::vector<index_t>& found, std::vector<float>& squared_distances)>;

/** \brief Makes a search for the k nearest of points, which outlive it. */
using NearestMaker =
    std::function<NearestSearch (const std::vector<Eigen::Vector3f>& points, int k)>;

/** \brief An edge that a sign can be carried along. */
struct NormalEdge {
  /** 0 where the normals agree but for the sign */
  float weight;
  index_t a;
  index_t b;
  /** whether one of the normals has to be turned */
  bool opposite;

  bool
  operator<(const NormalEdge& other) const
  {
    return std::tie (weight, a, b) < std::tie (other.weight, other.a, other.b);
  }
};

/** \brief The graph of nearest neighbours of points with normals. */
class NormalEdges {
public:
  /** \param[in] points finite; they have to outlive the graph
   *
   * \param[in] nearest makes the search
   */
  NormalEdges (const std::vector<Eigen::Vector3f>& points, const NearestMaker& nearest);

  /** \brief The edges from some points to their nearest neighbours, the surest first.
   * \param[in] normals of all points, of unit length or zero
   * \param[in] from which points
   * \param[in] threads 0 for all processors
   * \param[out] areas how much of the surface each of these stands for, up to a
   * factor: the squared distance to the last of the neighbours
   */
  std::vector<NormalEdge>
  find (const std::vector<Eigen::Vector3f>& normals,
        const std::vector<index_t>& from,
        unsigned threads,
        std::vector<double>& areas) const;

  /** How many neighbours. */
  static constexpr int NEIGHBORS = 12;

private:
  const std::vector<Eigen::Vector3f>& points_;
  NearestSearch nearest_;
};

} // namespace crest
} // namespace pcl
