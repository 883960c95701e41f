// SPDX-License-Identifier: BSD-3-Clause
// What unpacks compressed PCD files, whose library is loaded when it is first asked
// for.
#pragma once

#include "io/pcd_module.h"

namespace pcl {
namespace crest {

using LzfDecoder = decltype (&pcl_crest_decode_lzf);

/** \brief The function of the module that is where this library is; throws a ReadError
 * if that is not there.
 */
LzfDecoder
loadLzf ();

} // namespace crest
} // namespace pcl
