// SPDX-License-Identifier: BSD-3-Clause
// Room meshes: the faces of meshes, what they tell that their vertices do not, and
// samples of them.
//
// Positions and corners go in; faces, lengths and samples come out. It knows nothing of
// files.
#pragma once

#include <pcl_crest/types.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Polygons one after the other: the corners of face i are those from ends[i -
 * 1] (0 for the first) to ends[i].
 */
struct Faces {
  std::vector<index_t> corners;
  std::vector<std::size_t> ends;

  void
  close ()
  {
    ends.push_back (corners.size());
  }

  [[nodiscard]] std::size_t
  size () const
  {
    return ends.size();
  }

  /** \brief Where the corners of a face begin. */
  [[nodiscard]] std::size_t
  begin (std::size_t face) const
  {
    return face == 0 ? 0 : ends[face - 1];
  }
};

} // namespace crest
} // namespace pcl
