// SPDX-License-Identifier: BSD-3-Clause
// PCL's KdTree over the points of a stage.
#pragma once

#include <pcl_crest/impl/crest_line_estimation.hpp>

#include "surface/neighbor_search.h"

namespace oracle {

inline pcl::crest::NeighborSearch
kdTreeSearch (const pcl::crest::OrientedPoints& points,
              const pcl::crest::Parameters& parameters)
{
  return pcl::crest::searchOver (points, pcl::crest::kdTreeSearch, parameters);
}

} // namespace oracle
