// SPDX-License-Identifier: BSD-3-Clause
// What PCL does for the estimation of normals, in a module of its own: PCL's features
// bring along libraries that take longer to load than a small cloud takes to compute.
#pragma once

#include "normals/normal_estimation.h"

extern "C" {

/** \brief pcl::NormalEstimationOMP and pcl::KdTreeFLANN. */
PCL_CREST_EXPORT void
pcl_crest_normal_library (pcl::crest::PointLibrary& library);
}
