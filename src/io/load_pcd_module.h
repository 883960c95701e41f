// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcd_module.h"

namespace pcl {
namespace crest {

using PcdReader = decltype (&pcl_crest_read_pcd);

/** \brief The function of the module, which is loaded when it is first asked for, from
 * where this library is; throws a ReadError if it is not there.
 */
PcdReader
loadPcdModule ();

} // namespace crest
} // namespace pcl
