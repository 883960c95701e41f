// SPDX-License-Identifier: BSD-3-Clause
// The colors of labels and lines, in files as on the screen.
#pragma once

#include <pcl_crest/types.h>

#include <array>
#include <cstdint>

namespace pcl {
namespace crest {

/** \brief Red, green and blue up to 255. */
using Rgb = std::array<unsigned char, 3>;

constexpr Rgb
colorOf (CrestType type)
{
  return type == CrestType::RIDGE ? Rgb{10, 40, 220} : Rgb{220, 15, 15};
}

/** \brief \param[in] label one of Label; others have the color of LABEL_NONE */
constexpr Rgb
colorOfLabel (std::uint32_t label)
{
  switch (label) {
  case LABEL_RIDGE:
    return {70, 110, 240};
  case LABEL_VALLEY:
    return {240, 80, 70};
  case LABEL_RIDGE_GROWN:
    return {165, 190, 250};
  case LABEL_VALLEY_GROWN:
    return {250, 185, 175};
  case LABEL_INVALID:
    return {90, 90, 90};
  case LABEL_BOUNDARY:
    return {240, 190, 40};
  default:
    return {217, 217, 217};
  }
}

} // namespace crest
} // namespace pcl
