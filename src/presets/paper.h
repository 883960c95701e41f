// SPDX-License-Identifier: BSD-3-Clause
// The method as published: one fixed scale, the threshold M.
#pragma once

#include "presets/pipeline.h"

namespace pcl {
namespace crest {

const Pipeline&
paperPipeline ();

} // namespace crest
} // namespace pcl
