// SPDX-License-Identifier: BSD-3-Clause
// The reader of PCD files, whose library is loaded when it is first asked for.
#pragma once

#include "io/pcd_module.h"

namespace pcl {
namespace crest {

using PcdReader = decltype (&pcl_crest_read_pcd);

/** \brief The function of the module that is where this library is; throws a ReadError
 * if that is not there.
 */
PcdReader
loadPcdReader ();

} // namespace crest
} // namespace pcl
