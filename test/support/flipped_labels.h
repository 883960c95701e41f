// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/types.h>

namespace oracle {

/** \brief The label that a point has to have when all normals are flipped. */
inline std::uint32_t
flipped (std::uint32_t label)
{
  constexpr std::uint32_t SWAPPED[] = {pcl::crest::LABEL_NONE,
                                       pcl::crest::LABEL_VALLEY,
                                       pcl::crest::LABEL_RIDGE,
                                       pcl::crest::LABEL_VALLEY_GROWN,
                                       pcl::crest::LABEL_RIDGE_GROWN,
                                       pcl::crest::LABEL_INVALID,
                                       pcl::crest::LABEL_BOUNDARY};
  return SWAPPED[label];
}

} // namespace oracle
