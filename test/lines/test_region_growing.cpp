// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lines/region_growing.h"
#include "support/stage_inputs.h"

using namespace pcl::crest;

TEST (RegionGrowing, TakesTheNeighboursThatAreNoCrestPoints)
{
  // 0 - 1 - 2 - 3 - 4, 1 - 5 and 1 - 6: ridge at 1, valley at 2, no curvature at 6.
  const SurfaceGraph graph =
      oracle::graphOf (7, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {1, 5}, {1, 6}});
  const CrestType none = CrestType::NONE;
  const std::vector<CrestType> types{
      none, CrestType::RIDGE, CrestType::VALLEY, none, none, none, none};
  std::vector<PrincipalCurvature> curvature (
      7, {1.0F, 0.0F, Eigen::Vector3f::UnitX(), true});
  curvature[6].valid = false;
  using M = Membership;
  EXPECT_EQ (growRegions (graph, curvature, types, CrestType::RIDGE),
             (std::vector<M>{M::GROWN,
                             M::CREST,
                             M::OUTSIDE,
                             M::OUTSIDE,
                             M::OUTSIDE,
                             M::GROWN,
                             M::OUTSIDE}));
  EXPECT_EQ (growRegions (graph, curvature, types, CrestType::VALLEY),
             (std::vector<M>{M::OUTSIDE,
                             M::OUTSIDE,
                             M::CREST,
                             M::GROWN,
                             M::OUTSIDE,
                             M::OUTSIDE,
                             M::OUTSIDE}));
}
