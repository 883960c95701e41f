// SPDX-License-Identifier: BSD-3-Clause
// Numbers of points in formats that have one array after another, as VTK's.
#pragma once

#include "io/file_content.h"
#include "io/number_type.h"

#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Collects the arrays of points, which may come in pieces, until all points are
 * there.
 */
class PointArrays {
public:
  /** \brief Takes an array.
   * \param[in] type of its numbers in the file; whole numbers count up to 2^53
   * \param[in] components numbers of a point, at least 1
   * \param[in] before points of the pieces before this one
   * \param[in] values point by point
   */
  void
  add (const std::string& name,
       NumberType type,
       std::size_t components,
       std::size_t before,
       std::vector<double> values);

  /** \brief Makes fields of those that all points of the content have; of the first
   * with three or four bytes a point, which VTK takes for colors, the colors, and a
   * field "alpha" of the fourth.
   */
  void
  pass (FileContent& content);

private:
  struct Array {
    std::string name;
    NumberType type;
    std::size_t components;
    std::vector<double> values;
  };

  std::vector<Array> arrays_;
};

} // namespace crest
} // namespace pcl
