// SPDX-License-Identifier: BSD-3-Clause
// The peer: the crest lines that CGAL's Ridges_3 (Cazals and Pouget 2005) finds on
// meshes of the same surfaces, without noise. CGAL's package is under the GPL: this
// program is optional and never installed, and nothing else links to CGAL.
#include <Eigen/Geometry>

#include "settings.h"
#include "surface_list.h"
#include "surface_score.h"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Ridges.h>
#include <CGAL/Surface_mesh.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <set>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Numbers = Mesh::Property_map<Vertex, double>;
using Vectors = Mesh::Property_map<Vertex, Kernel::Vector_3>;

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

/** \brief The vertex and as many rings around it as have enough points for the fit. */
std::vector<Point>
ringsAround (const Mesh& mesh, Vertex center, std::size_t least)
{
  std::vector<Vertex> found{center};
  std::set<Vertex> known{center};
  for (std::size_t first = 0; found.size() < least && first < found.size();) {
    const std::size_t last = found.size();
    for (; first < last; ++first)
      for (const Vertex neighbor :
           CGAL::vertices_around_target (mesh.halfedge (found[first]), mesh))
        if (known.insert (neighbor).second)
          found.push_back (neighbor);
  }
  std::vector<Point> points;
  for (const Vertex v : found)
    points.push_back (mesh.point (v));
  return points;
}

/** \brief All crest lines, without a filter, as the scores want them. CGAL's curvature
 * is negative where the surface is convex seen from the side of the normal.
 */
accuracy::TimedRun
findRidges (Mesh& mesh, const Vectors& normals)
{
  const auto start = std::chrono::steady_clock::now();
  const auto number = [&] (const char* name) {
    return mesh.add_property_map<Vertex, double> (name).first;
  };
  Numbers k1 = number ("v:k1"), k2 = number ("v:k2"), b0 = number ("v:b0"),
          b3 = number ("v:b3"), p1 = number ("v:p1"), p2 = number ("v:p2");
  const auto direction = [&] (const char* name) {
    return mesh.add_property_map<Vertex, Kernel::Vector_3> (name).first;
  };
  Vectors d1 = direction ("v:d1"), d2 = direction ("v:d2");
  // Twice the 15 coefficients.
  constexpr int DEGREE = 4;
  constexpr std::size_t LEAST_POINTS = 30;
  for (const Vertex v : mesh.vertices()) {
    const std::vector<Point> points = ringsAround (mesh, v, LEAST_POINTS);
    CGAL::Monge_via_jet_fitting<Kernel> fit;
    auto monge = fit (points.begin(), points.end(), DEGREE, DEGREE);
    monge.comply_wrt_given_normal (normals[v]);
    k1[v] = monge.principal_curvatures (0);
    k2[v] = monge.principal_curvatures (1);
    b0[v] = monge.third_order_coefficients (0);
    b3[v] = monge.third_order_coefficients (3);
    const auto& c = monge.fourth_order_coefficients (0);
    const double c4 = monge.fourth_order_coefficients (4);
    const double first = monge.third_order_coefficients (1);
    const double second = monge.third_order_coefficients (2);
    p1[v] = 3.0 * first * first + (k1[v] - k2[v]) * (c - 3.0 * std::pow (k1[v], 3));
    p2[v] = 3.0 * second * second + (k2[v] - k1[v]) * (c4 - 3.0 * std::pow (k2[v], 3));
    d1[v] = monge.maximal_principal_direction();
    d2[v] = monge.minimal_principal_direction();
  }
  CGAL::Ridge_approximation<Mesh, Numbers, Vectors> approximation (
      mesh, k1, k2, b0, b3, d1, d2, p1, p2);
  std::vector<CGAL::Ridge_line<Mesh>*> found;
  approximation.compute_crest_ridges (std::back_inserter (found), CGAL::Ridge_order_4);
  const std::chrono::duration<double, std::milli> took =
      std::chrono::steady_clock::now() - start;

  accuracy::TimedRun run;
  run.milliseconds = took.count();
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (CGAL::Ridge_line<Mesh>* ridge : found) {
    pcl::crest::CrestLine line;
    line.type = ridge->line_type() == CGAL::MIN_CREST_RIDGE
                    ? pcl::crest::CrestType::RIDGE
                    : pcl::crest::CrestType::VALLEY;
    line.polylines.emplace_back();
    for (const auto& [halfedge, weight] : *ridge->line()) {
      const Point p = CGAL::barycenter (mesh.point (mesh.source (halfedge)),
                                        weight,
                                        mesh.point (mesh.target (halfedge)));
      pcl::PointNormal point;
      point.x = static_cast<float> (p.x());
      point.y = static_cast<float> (p.y());
      point.z = static_cast<float> (p.z());
      line.polylines[0].push_back (static_cast<pcl::index_t> (cloud->size()));
      cloud->push_back (point);
    }
    run.lines.push_back (line);
    delete ridge; // CGAL leaves that to its users
  }
  run.line_cloud = cloud;
  return run;
}

} // namespace

int
main (int argc, char** argv)
{
  std::string json;
  int points = 20000;
  pcl::crest::Options options;
  options.addNumber ("-points", "vertices of a surface", points);
  options.addText ("-json", "FILE", "write all scores", json);
  std::vector<std::string> names;
  std::string error;
  const bool parsed = options.parse (argc, argv, names, error);
  std::string unknown;
  if (names.empty())
    names = {"tuned", "held_out"};
  const auto surfaces = accuracy::listSurfaces (names, unknown);
  if (parsed && !unknown.empty())
    error = "there is no surface \"" + unknown + "\"";
  if (!error.empty()) {
    std::cerr << "crest_accuracy_cgal: " << error << '\n' << options.usage();
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
    const accuracy::TimedRun run = findRidges (mesh, normals);
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
