// SPDX-License-Identifier: BSD-3-Clause
// Nodes in the place of samples that tell nothing by themselves.
#pragma once

#include <pcl_crest/input.h>

#include "base/progress.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What was found of a cloud's samples, and what they were gathered to. */
struct SampleNodes {
  /** of the cloud, without normals (see fingerprint) */
  std::uint64_t cloud = 0;
  SamplingFindings findings;
  /** in the unit of the cloud; empty where samples will do */
  std::vector<Eigen::Vector3f> positions;
  /** of each point of the cloud its node, -1 where it is not finite; empty likewise */
  std::vector<index_t> node_of;

  bool
  isEmpty () const
  {
    return positions.empty();
  }

  /** \brief The nodes as a cloud, if there are some. */
  PointView
  view () const
  {
    return {positions.front().data(), nullptr, 3, positions.size()};
  }
};

/** \brief Measures how a cloud was sampled, in windows spread over it, and gathers its
 * samples to their means where the surface can be told only so (findResolvingSpacing).
 *
 * An even cloud without correlated noise stays as it is. The result does not depend on
 * the order of the points, but for theirs in node_of, nor on the number of threads.
 */
SampleNodes
resolveSamples (const PointView& cloud, const Workers& workers);

} // namespace crest
} // namespace pcl
