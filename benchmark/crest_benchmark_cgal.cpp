// SPDX-License-Identifier: BSD-3-Clause
// The peer: what CGAL's Ridges_3 takes on a mesh, with its normals. For
// docs/performance.md; ./scripts/benchmark runs it.
#include "cgal_ridges.h"
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <chrono>
#include <cstdio>
#include <iostream>

using namespace accuracy::cgal;

int
main (int argc, char** argv)
{
  Mesh mesh;
  if (argc != 2 ||
      !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh (argv[1], mesh)) {
    std::cerr << "Usage: crest_benchmark_cgal MESH.off\n"
                 "Prints how many milliseconds the crest lines of a mesh take.\n";
    return 1;
  }
  const auto start = std::chrono::steady_clock::now();
  const Vectors normals =
      mesh.add_property_map<Vertex, Kernel::Vector_3> ("v:normal").first;
  CGAL::Polygon_mesh_processing::compute_vertex_normals (mesh, normals);
  const std::chrono::duration<double, std::milli> took =
      std::chrono::steady_clock::now() - start;
  std::printf ("%.1f\n", took.count() + findRidges (mesh, normals, 3).milliseconds);
  return 0;
}
