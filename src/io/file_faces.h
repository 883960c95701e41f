// SPDX-License-Identifier: BSD-3-Clause
// What the faces of a file are taken for, beside the normals of their corners.
#pragma once

#include <pcl_crest/io/read_cloud.h>

#include "io/placement.h"

namespace pcl {
namespace crest {

/** \brief Makes faces run around the same way, and notes where they did not; whether
 * they did.
 */
bool
unifyFaces (PlacedContent& content);

/** \brief Puts samples of the faces, with their normals, in the place of the points:
 * where options give a spacing, or else where the points tell too little of the faces.
 * Throws a ReadError where a spacing is given that will not do.
 *
 * \param[in,out] content gets samples for points, and a note of it
 * \param[in] options the normals of these do not matter
 * \param[in] threads 0 for all processors
 * \return what was done; no faces where the points are as they were
 */
SampledFaces
replaceBySamples (PlacedContent& content, const ReadOptions& options, unsigned threads);

} // namespace crest
} // namespace pcl
