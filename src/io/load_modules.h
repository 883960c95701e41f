// SPDX-License-Identifier: BSD-3-Clause
// Functions of PCL whose libraries are loaded when they are first asked for.
#pragma once

#include "normals_module.h"
#include "pcd_module.h"

namespace pcl {
namespace crest {

using PcdReader = decltype (&pcl_crest_read_pcd);
using NormalEstimator = decltype (&pcl_crest_estimate_normals);

/** \brief The function of a module that is where this library is; throws a ReadError if
 * it is not there.
 */
PcdReader
loadPcdReader ();
NormalEstimator
loadNormalEstimator ();

} // namespace crest
} // namespace pcl
