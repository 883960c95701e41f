// SPDX-License-Identifier: BSD-3-Clause
// The peer: the crest lines that CGAL's Ridges_3 (Cazals and Pouget 2005) finds on
// meshes of the same surfaces, without noise.
#include <Eigen/Geometry>

#include "cgal_ridges.h"
#include "settings.h"
#include "surface_list.h"
#include "surface_score.h"
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

namespace {

using namespace accuracy::cgal;

/** \brief The surface's domain as a grid of about `count` vertices whose steps are on
 * average as long along u as along v, closed where the surface is.
 */
Mesh
makeMesh (const oracle::AnalyticSurface& surface, int count, Vectors& normals)
{
  const double u_range = surface.u_max - surface.u_min;
  const double v_range = surface.v_max - surface.v_min;
  double u_length = 0.0;
  double v_length = 0.0;
  constexpr int PROBES = 20;
  for (int i = 0; i < PROBES; ++i)
    for (int j = 0; j < PROBES; ++j) {
      const oracle::Derivatives x =
          surface.derivatives (surface.u_min + u_range * (i + 0.5) / PROBES,
                               surface.v_min + v_range * (j + 0.5) / PROBES);
      u_length += x.d[1][0].norm() * u_range;
      v_length += x.d[0][1].norm() * v_range;
    }
  const int nu = static_cast<int> (std::sqrt (count * u_length / v_length));
  const int nv = count / nu;
  const auto at = [&] (int i, int j) {
    return Eigen::Vector2d (surface.u_min + u_range * i / nu,
                            surface.v_min + v_range * j / nv);
  };
  const auto closes = [&] (const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (surface.position (a.x(), a.y()) - surface.position (b.x(), b.y())).norm() <
           1e-9;
  };
  const bool u_closed = closes (at (0, nv / 3), at (nu, nv / 3));
  const bool v_closed = closes (at (nu / 3, 0), at (nu / 3, nv));
  const int columns = u_closed ? nu : nu + 1;
  const int rows = v_closed ? nv : nv + 1;

  Mesh mesh;
  normals = mesh.add_property_map<Vertex, Kernel::Vector_3> ("v:normal").first;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const Eigen::Vector2d uv = at (i, j);
      const Eigen::Vector3d p = surface.position (uv.x(), uv.y());
      const Eigen::Vector3d n = oracle::unitNormal (surface, uv.x(), uv.y());
      normals[mesh.add_vertex (Point (p.x(), p.y(), p.z()))] =
          Kernel::Vector_3 (n.x(), n.y(), n.z());
    }
  const auto vertex = [&] (int i, int j) {
    return Vertex (static_cast<Mesh::size_type> (i % columns * rows + j % rows));
  };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      mesh.add_face (vertex (i, j), vertex (i + 1, j), vertex (i + 1, j + 1));
      mesh.add_face (vertex (i, j), vertex (i + 1, j + 1), vertex (i, j + 1));
    }
  return mesh;
}

} // namespace

int
main (int argc, char** argv)
{
  std::string json;
  int points = 20000;
  pcl::crest::Options options;
  auto add = options.add_options();
  add ("-points", pcl::crest::number (points), "vertices of a surface");
  add ("-json", pcl::crest::fileName ("FILE", json), "write all scores");
  pcl::crest::Arguments arguments;
  std::string error = pcl::crest::parse (argc, argv, options, arguments);
  const bool parsed = error.empty();
  std::vector<std::string> names = arguments.files;
  std::string unknown;
  if (names.empty())
    names = {"tuned", "held_out"};
  const auto surfaces = accuracy::listSurfaces (names, unknown);
  if (parsed && !unknown.empty())
    error = "there is no surface \"" + unknown + "\"";
  if (!error.empty()) {
    std::cerr << "crest_accuracy_cgal: " << error << '\n'
              << pcl::crest::usage (options);
    return 1;
  }

  nlohmann::json runs = nlohmann::json::array();
  std::printf ("| surface | ms %s\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
               accuracy::rowHead().c_str());
  for (const accuracy::ListedSurface& listed : surfaces) {
    const double spacing = oracle::meanSpacing (
        *oracle::sample (listed.surface, static_cast<std::size_t> (points)));
    const auto truth = oracle::trueCrestLines (listed.surface, accuracy::TRUTH_CELLS);
    Vectors normals;
    Mesh mesh = makeMesh (listed.surface, points, normals);
    const accuracy::TimedRun run = findRidges (mesh, normals, 4);
    nlohmann::json result{{"surface", listed.surface.name},
                          {"group", listed.group},
                          {"milliseconds", run.milliseconds}};
    for (const pcl::crest::CrestType type : pcl::crest::CREST_TYPES) {
      const accuracy::TypeScore score = accuracy::scoreType (
          run.lines, *run.line_cloud, truth, type, spacing, accuracy::TOLERANCE);
      std::printf ("| %s | %.0f %s\n",
                   listed.surface.name.c_str(),
                   run.milliseconds,
                   toRow (score).c_str());
      result[accuracy::nameOf (type)] = toJson (score);
    }
    std::fflush (stdout);
    runs.push_back (result);
  }
  if (json.empty())
    return 0;
  std::ofstream stream (json);
  stream << nlohmann::json{{"runs", runs}}.dump (1) << '\n';
  stream.close();
  if (stream.fail()) {
    std::cerr << "crest_accuracy_cgal: could not write " << json << '\n';
    return 1;
  }
  return 0;
}
