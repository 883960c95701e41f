// SPDX-License-Identifier: BSD-3-Clause
// Functions of PCL whose libraries are loaded when they are first asked for.
#pragma once

#include "io/normals_module.h"
#include "io/pcd_module.h"

namespace pcl {
namespace crest {

using PcdReader = decltype (&pcl_crest_read_pcd);
using NormalLibrary = decltype (&pcl_crest_normal_library);

/** \brief The function of a module that is where this library is; throws a ReadError if
 * it is not there.
 */
PcdReader
loadPcdReader ();
NormalLibrary
loadNormalLibrary ();

} // namespace crest
} // namespace pcl
