// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/face_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief Calls use (face, from, to) for all sides of faces, but those of no length. */
template <typename Use>
void
forEachSide (const Faces& faces, const Use& use)
{
  std::size_t first = 0;
  for (std::size_t face = 0; face < faces.ends.size(); ++face) {
    const std::size_t end = faces.ends[face];
    for (std::size_t i = first; i < end; ++i) {
      const index_t from = faces.corners[i];
      const index_t to = faces.corners[i + 1 < end ? i + 1 : first];
      if (from != to)
        use (static_cast<index_t> (face), from, to);
    }
    first = end;
  }
}

} // namespace

EdgeTable
tabulateEdges (const Faces& faces, std::size_t points)
{
  EdgeTable table;
  table.begins.assign (points + 1, 0);
  forEachSide (faces, [&table] (index_t, index_t from, index_t to) {
    ++table.begins[static_cast<std::size_t> (std::min (from, to)) + 1];
  });
  std::partial_sum (table.begins.begin(), table.begins.end(), table.begins.begin());
  table.edges.resize (table.begins.back());
  std::vector<std::size_t> next (table.begins.begin(), table.begins.end() - 1);
  forEachSide (faces, [&] (index_t face, index_t from, index_t to) {
    table.edges[next[std::min (from, to)]++] = {std::max (from, to), face, from < to};
  });
  for (std::size_t i = 0; i < points; ++i)
    std::sort (table.edges.begin() + static_cast<std::ptrdiff_t> (table.begins[i]),
               table.edges.begin() + static_cast<std::ptrdiff_t> (table.begins[i + 1]),
               [] (const FaceEdge& a, const FaceEdge& b) {
                 return std::tie (a.larger, a.face) < std::tie (b.larger, b.face);
               });
  return table;
}

} // namespace crest
} // namespace pcl
