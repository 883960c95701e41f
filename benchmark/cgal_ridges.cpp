// SPDX-License-Identifier: BSD-3-Clause
#include "cgal_ridges.h"

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Ridges.h>

#include <chrono>
#include <cmath>
#include <set>

namespace accuracy {
namespace cgal {

namespace {

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

} // namespace

TimedRun
findRidges (Mesh& mesh, const Vectors& normals, int degree)
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
  // Twice the coefficients, 10 or 15.
  const auto terms = static_cast<std::size_t> (degree) + 1;
  const std::size_t least_points = terms * (terms + 1);
  for (const Vertex v : mesh.vertices()) {
    const std::vector<Point> points = ringsAround (mesh, v, least_points);
    CGAL::Monge_via_jet_fitting<Kernel> fit;
    auto monge = fit (points.begin(), points.end(), degree, degree);
    monge.comply_wrt_given_normal (normals[v]);
    k1[v] = monge.principal_curvatures (0);
    k2[v] = monge.principal_curvatures (1);
    b0[v] = monge.third_order_coefficients (0);
    b3[v] = monge.third_order_coefficients (3);
    d1[v] = monge.maximal_principal_direction();
    d2[v] = monge.minimal_principal_direction();
    if (degree < 4)
      continue;
    const double c = monge.fourth_order_coefficients (0);
    const double c4 = monge.fourth_order_coefficients (4);
    const double first = monge.third_order_coefficients (1);
    const double second = monge.third_order_coefficients (2);
    p1[v] = 3.0 * first * first + (k1[v] - k2[v]) * (c - 3.0 * std::pow (k1[v], 3));
    p2[v] = 3.0 * second * second + (k2[v] - k1[v]) * (c4 - 3.0 * std::pow (k2[v], 3));
  }
  CGAL::Ridge_approximation<Mesh, Numbers, Vectors> approximation (
      mesh, k1, k2, b0, b3, d1, d2, p1, p2);
  std::vector<CGAL::Ridge_line<Mesh>*> found;
  approximation.compute_crest_ridges (std::back_inserter (found),
                                      degree < 4 ? CGAL::Ridge_order_3
                                                 : CGAL::Ridge_order_4);
  const std::chrono::duration<double, std::milli> took =
      std::chrono::steady_clock::now() - start;

  TimedRun run;
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

} // namespace cgal
} // namespace accuracy
