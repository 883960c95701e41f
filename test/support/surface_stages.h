// SPDX-License-Identifier: BSD-3-Clause
// The first stages on samples of a surface.
#pragma once

#include "kd_tree.h"
#include "stage_inputs.h"

namespace oracle {

struct SurfaceStages {
  pcl::crest::OrientedPoints points;
  pcl::crest::SurfaceGraph graph;
};

inline SurfaceStages
surfaceStages (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  const pcl::crest::Parameters parameters;
  SurfaceStages stages;
  stages.points = pack (cloud);
  stages.graph = pcl::crest::buildSurfaceGraph (
      stages.points, kdTreeSearch (stages.points, parameters), parameters);
  return stages;
}

} // namespace oracle
