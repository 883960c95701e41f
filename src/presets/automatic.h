// SPDX-License-Identifier: BSD-3-Clause
// The paper's stages with the scale and the significance found by statistics.
#pragma once

#include "presets/pipeline.h"

namespace pcl {
namespace crest {

const Pipeline&
automaticPipeline ();

} // namespace crest
} // namespace pcl
