// SPDX-License-Identifier: BSD-3-Clause
// The peer: CGAL's Ridges_3 (Cazals and Pouget 2005) on a mesh. CGAL's package is under
// the GPL: programs that use it are optional and never installed, and nothing else
// links to them.
#pragma once

#include "timed_run.h"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace accuracy {
namespace cgal {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Numbers = Mesh::Property_map<Vertex, double>;
using Vectors = Mesh::Property_map<Vertex, Kernel::Vector_3>;

/** \brief All crest lines, without a filter, as the scores want them. CGAL's curvature
 * is negative where the surface is convex seen from the side of the normal.
 * \param[in] degree of the polynomials that are fitted, d = m: 3, or 4, which tells
 * maxima from minima by fourth derivatives, as CGAL's Ridge_order_4
 */
TimedRun
findRidges (Mesh& mesh, const Vectors& normals, int degree);

} // namespace cgal
} // namespace accuracy
