// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file_content.h"
#include "normal_orientation.h"

namespace pcl {
namespace crest {

/** \brief Estimates normals from the k nearest neighbours and makes them consistent
 * over the cloud. Points that are not finite get zero normals.
 */
Orientation
estimateNormals (FileContent& content, int k, unsigned threads);

} // namespace crest
} // namespace pcl
