// SPDX-License-Identifier: BSD-3-Clause
#include "presets/automatic.h"
#include "presets/paper.h"

#include <algorithm>

namespace pcl {
namespace crest {

const std::vector<const Pipeline*>&
allPipelines ()
{
  static const std::vector<const Pipeline*> all{&automaticPipeline(), &paperPipeline()};
  return all;
}

const Pipeline*
findPipeline (Preset preset)
{
  const std::vector<const Pipeline*>& all = allPipelines();
  const auto found =
      std::find_if (all.begin(), all.end(), [preset] (const Pipeline* p) {
        return p->preset() == preset;
      });
  return found == all.end() ? nullptr : *found;
}

} // namespace crest
} // namespace pcl
