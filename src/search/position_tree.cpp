// SPDX-License-Identifier: BSD-3-Clause
#include "search/position_tree.h"

#include <cassert>

namespace pcl {
namespace crest {

std::shared_ptr<const PointTree>
treeOver (const std::vector<Eigen::Vector3f>& positions, unsigned threads)
{
  auto tree = std::make_shared<PointTree>();
  const float* const coordinates =
      positions.empty() ? nullptr : positions.front().data();
  const std::string error =
      buildPointTree (coordinates, 3, positions.size(), threads, *tree);
  assert (error.empty());
  static_cast<void> (error);
  return tree;
}

} // namespace crest
} // namespace pcl
