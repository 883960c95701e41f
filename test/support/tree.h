// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lines/spanning_forest.h"
#include "stage_inputs.h"

namespace oracle {

/** \brief A tree that grows by paths, small enough to be drawn on paper. */
class Tree {
public:
  /** \brief Appends a path of new points to a point (or starts with a new one), and
   * returns the last; `step` is the length of its edges.
   */
  int
  grow (int from, int points, float step = 1.0F)
  {
    if (from < 0) {
      positions_.emplace_back (0.0F, 0.0F, 0.0F);
      from = 0;
    }
    // Each path has a height of its own, so that no two points coincide.
    const float height = positions_[from].z() + 1e-3F * static_cast<float> (++paths_);
    for (int i = 0; i < points; ++i) {
      const int next = static_cast<int> (positions_.size());
      const Eigen::Vector3f& p = positions_[from];
      positions_.emplace_back (p.x() + step, p.y(), height);
      edges_.push_back ({from, next, pcl::crest::EdgeType::A, step});
      from = next;
    }
    return from;
  }

  pcl::crest::OrientedPoints
  points () const
  {
    return pointsAt (positions_);
  }
  const std::vector<pcl::crest::CrestEdge>&
  edges () const
  {
    return edges_;
  }

private:
  std::vector<Eigen::Vector3f> positions_;
  std::vector<pcl::crest::CrestEdge> edges_;
  int paths_ = 0;
};

} // namespace oracle
