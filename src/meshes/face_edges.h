// SPDX-License-Identifier: BSD-3-Clause
// Which faces meet at which edges.
#pragma once

#include "meshes/faces.h"

namespace pcl {
namespace crest {

/** \brief A side of a face, listed at the smaller of its corners. */
struct FaceEdge {
  index_t larger;
  index_t face;
  /** whether the face runs from the smaller corner to the larger */
  bool rises;
};

/** \brief The sides of all faces by their smaller corners: those of corner i are
 * edges[begins[i]] to edges[begins[i + 1] - 1], equal ones next to each other. Sides of
 * no length are left out.
 */
struct EdgeTable {
  std::vector<std::size_t> begins;
  std::vector<FaceEdge> edges;
};

/** \param[in] faces whose corners are below points
 *
 * \param[in] points how many there are
 */
PCL_CREST_EXPORT EdgeTable
tabulateEdges (const Faces& faces, std::size_t points);

/** \brief Calls use (smaller, edge, sides) for each edge: the smaller of its corners,
 * and the sides of faces along it.
 */
template <typename Use>
void
forEachEdge (const EdgeTable& table, const Use& use)
{
  for (std::size_t i = 0; i + 1 < table.begins.size(); ++i)
    for (std::size_t j = table.begins[i]; j < table.begins[i + 1];) {
      std::size_t end = j + 1;
      while (end < table.begins[i + 1] &&
             table.edges[end].larger == table.edges[j].larger)
        ++end;
      use (static_cast<index_t> (i), &table.edges[j], end - j);
      j = end;
    }
}

} // namespace crest
} // namespace pcl
