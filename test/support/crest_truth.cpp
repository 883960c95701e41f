// SPDX-License-Identifier: BSD-3-Clause
#include "crest_truth.h"

#include <pcl_crest/parameters.h>

#include <pcl/search/kdtree.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oracle {

namespace {

/** \brief A number with its derivatives by u and v. */
struct Dual {
  double x, u, v;
};
Dual
operator+ (Dual a, Dual b)
{
  return {a.x + b.x, a.u + b.u, a.v + b.v};
}
Dual
operator- (Dual a, Dual b)
{
  return {a.x - b.x, a.u - b.u, a.v - b.v};
}
Dual
operator* (Dual a, Dual b)
{
  return {a.x * b.x, a.u * b.x + a.x * b.u, a.v * b.x + a.x * b.v};
}
Dual
operator/ (Dual a, Dual b)
{
  const double x = a.x / b.x;
  return {x, (a.u - x * b.u) / b.x, (a.v - x * b.v) / b.x};
}
Dual
sqrt (Dual a)
{
  const double root = std::sqrt (std::max (a.x, 1e-300));
  return {root, a.u / (2.0 * root), a.v / (2.0 * root)};
}

struct DualVector {
  Dual x, y, z;
};
Dual
dot (const DualVector& a, const DualVector& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
DualVector
cross (const DualVector& a, const DualVector& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/** \brief The derivative d[i][j] with its own derivatives. */
DualVector
withGradient (const Derivatives& d, int i, int j)
{
  const auto axis = [&] (int a) {
    return Dual{d.d[i][j][a], d.d[i + 1][j][a], d.d[i][j + 1][a]};
  };
  return {axis (0), axis (1), axis (2)};
}

} // namespace

SurfacePoint
geometryAt (const AnalyticSurface& surface, double u, double v)
{
  const Derivatives d = surface.derivatives (u, v);
  const DualVector xu = withGradient (d, 1, 0);
  const DualVector xv = withGradient (d, 0, 1);
  const DualVector n = cross (xu, xv);
  const Dual norm = sqrt (dot (n, n));
  const Dual E = dot (xu, xu);
  const Dual F = dot (xu, xv);
  const Dual G = dot (xv, xv);
  const Dual minus{-1.0, 0.0, 0.0};
  const Dual L = minus * dot (withGradient (d, 2, 0), n) / norm;
  const Dual M = minus * dot (withGradient (d, 1, 1), n) / norm;
  const Dual N = minus * dot (withGradient (d, 0, 2), n) / norm;

  const Dual two{2.0, 0.0, 0.0};
  const Dual area = E * G - F * F;
  const Dual mean = (E * N - two * F * M + G * L) / (two * area);
  const Dual gauss = (L * N - M * M) / area;
  const Dual radius = sqrt (mean * mean - gauss);
  const Dual k1 = mean.x >= 0.0 ? mean + radius : mean - radius;
  const Dual k2 = mean.x >= 0.0 ? mean - radius : mean + radius;

  Eigen::Vector2d t (M.x - k1.x * F.x, -(L.x - k1.x * E.x));
  const Eigen::Vector2d other (N.x - k1.x * G.x, -(M.x - k1.x * F.x));
  if (other.squaredNorm() > t.squaredNorm())
    t = other;
  Eigen::Vector3d t1 = d.d[1][0] * t.x() + d.d[0][1] * t.y();
  t /= t1.norm();
  t1.normalize();
  return {d.d[0][0], k1.x, k2.x, t1, k1.u * t.x() + k1.v * t.y(), t};
}

namespace {

/** \brief Whether the surface comes back to where it began along u, or v. */
bool
isClosed (const AnalyticSurface& surface, bool along_u)
{
  const double u = 0.3 * surface.u_min + 0.7 * surface.u_max;
  const double v = 0.3 * surface.v_min + 0.7 * surface.v_max;
  const Eigen::Vector3d first = along_u ? surface.position (surface.u_min, v)
                                        : surface.position (u, surface.v_min);
  const Eigen::Vector3d last = along_u ? surface.position (surface.u_max, v)
                                       : surface.position (u, surface.v_max);
  return (first - last).norm() < 1e-9;
}

} // namespace

std::vector<TruthSegment>
trueCrestLines (const AnalyticSurface& surface, int cells)
{
  // The grid begins a bit before the domain and ends a bit behind it: crests along
  // lines of symmetry or along the seam of a closed surface then lie between its
  // points.
  const auto uOf = [&] (int i) {
    return surface.u_min + (surface.u_max - surface.u_min) * (i - 0.37) / cells;
  };
  const auto vOf = [&] (int j) {
    return surface.v_min + (surface.v_max - surface.v_min) * (j - 0.37) / cells;
  };
  // Where a surface is closed, that would count the seam twice.
  const int columns = isClosed (surface, true) ? cells : cells + 1;
  const int rows = isClosed (surface, false) ? cells : cells + 1;
  const auto columnAt = [&] (int i) {
    std::vector<SurfacePoint> column (rows + 1);
#pragma omp parallel for schedule(dynamic, 16)
    for (int j = 0; j <= rows; ++j)
      column[j] = geometryAt (surface, uOf (i), vOf (j));
    return column;
  };
  const auto typeOf = [] (const SurfacePoint& p) {
    return p.k1 > 0.0 ? pcl::crest::CrestType::RIDGE : pcl::crest::CrestType::VALLEY;
  };
  // Whether |k1| rises from p towards q, and from q towards p.
  const auto rises = [] (const SurfacePoint& p, const SurfacePoint& q) {
    return (p.k1 > 0.0 ? 1.0 : -1.0) * p.extremality *
               (q.position - p.position).dot (p.t1) >
           0.0;
  };
  struct Crossing {
    Eigen::Vector3d position;
    pcl::crest::CrestType type;
  };
  const auto crossings =
      [&] (const SurfacePoint& p, const SurfacePoint& q, std::vector<Crossing>& found) {
        // On a sphere (k1 = k2) rounding alone makes the extremality change its sign.
        constexpr double UMBILIC = 1e-3;
        if (std::abs (p.k1) - std::abs (p.k2) < UMBILIC * std::abs (p.k1))
          return;
        // Nor does a crest run where symmetry makes it zero all over, as around a
        // torus.
        constexpr double CONSTANT = 1e-8;
        if (std::max (std::abs (p.extremality), std::abs (q.extremality)) <
            CONSTANT * p.k1 * p.k1)
          return;
        const double turn = p.t1.dot (q.t1);
        const bool crosses = p.extremality * q.extremality * turn < 0.0;
        if (std::abs (turn) < 0.9 || !crosses || typeOf (p) != typeOf (q) ||
            !rises (p, q) || !rises (q, p))
          return;
        const double a = std::abs (p.extremality);
        const double b = std::abs (q.extremality);
        found.push_back ({(b * p.position + a * q.position) / (a + b), typeOf (p)});
      };

  std::vector<TruthSegment> segments;
  std::vector<SurfacePoint> column;
  std::vector<SurfacePoint> next = columnAt (0);
  for (int i = 0; i < columns; ++i) {
    column.swap (next);
    next = columnAt (i + 1);
    for (int j = 0; j < rows; ++j) {
      std::vector<Crossing> found;
      crossings (column[j], column[j + 1], found);
      crossings (next[j], next[j + 1], found);
      crossings (column[j], next[j], found);
      crossings (column[j + 1], next[j + 1], found);
      if (found.size() != 2 || found[0].type != found[1].type)
        continue;
      // How the extremality changes along t1 needs no more than a difference of it.
      const SurfacePoint& p = column[j];
      constexpr double STEP = 1e-4;
      const SurfacePoint ahead = geometryAt (
          surface, uOf (i) + STEP * p.direction.x(), vOf (j) + STEP * p.direction.y());
      const double sign = ahead.t1.dot (p.t1) > 0.0 ? 1.0 : -1.0;
      const double sharpness =
          std::abs ((sign * ahead.extremality - p.extremality) / STEP);
      segments.push_back ({found[0].position,
                           found[1].position,
                           found[0].type,
                           std::abs (p.k1),
                           sharpness});
    }
  }
  return segments;
}

namespace {

/** \brief Points along a set of segments, each with the length that it stands for. */
struct Trace {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points =
      pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  std::vector<double> lengths;

  void
  add (const Eigen::Vector3d& a, const Eigen::Vector3d& b, int pieces)
  {
    for (int i = 0; i < pieces; ++i) {
      const Eigen::Vector3f p = (a + (b - a) * (i + 0.5) / pieces).cast<float>();
      points->emplace_back (p.x(), p.y(), p.z());
      lengths.push_back ((b - a).norm() / pieces);
    }
  }
};

/** \brief Part of the length of `trace` that is within the tolerance of `other`, and
 * the mean distance of that part in units of the tolerance.
 */
double
partNear (const Trace& trace,
          const Trace& other,
          double tolerance,
          double* mean_distance = nullptr)
{
  if (trace.points->empty() || other.points->empty())
    return 0.0;
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud (other.points);
  pcl::Indices found;
  std::vector<float> squared;
  double near = 0.0;
  double all = 0.0;
  double distances = 0.0;
  for (std::size_t i = 0; i < trace.points->size(); ++i) {
    tree.nearestKSearch ((*trace.points)[i], 1, found, squared);
    all += trace.lengths[i];
    if (squared[0] < tolerance * tolerance) {
      near += trace.lengths[i];
      distances += trace.lengths[i] * std::sqrt (squared[0]) / tolerance;
    }
  }
  if (mean_distance != nullptr && near > 0.0)
    *mean_distance = distances / near;
  return near / all;
}

} // namespace

Score
score (const std::vector<pcl::crest::CrestLine>& lines,
       const pcl::PointCloud<pcl::PointNormal>& cloud,
       const std::vector<TruthSegment>& truth,
       pcl::crest::CrestType type,
       double tolerance)
{
  std::vector<double> sharpness;
  for (const TruthSegment& s : truth)
    if (s.type == type)
      sharpness.push_back (s.sharpness);
  std::sort (sharpness.begin(), sharpness.end());
  const double salient =
      sharpness.empty() ? 0.0 : 0.3 * sharpness[sharpness.size() * 9 / 10];

  Trace all_truth;
  Trace salient_truth;
  for (const TruthSegment& s : truth) {
    if (s.type != type)
      continue;
    all_truth.add (s.a, s.b, 1);
    if (s.sharpness > salient && s.sharpness > 0.1 * std::pow (s.curvature, 3))
      salient_truth.add (s.a, s.b, 1);
  }
  Trace drawn;
  Score result;
  for (const pcl::crest::CrestLine& line : lines)
    if (line.type == type) {
      result.drawn_length += line.length;
      for (const auto& polyline : line.polylines)
        for (std::size_t i = 1; i < polyline.size(); ++i)
          drawn.add (cloud[polyline[i - 1]].getVector3fMap().cast<double>(),
                     cloud[polyline[i]].getVector3fMap().cast<double>(),
                     8);
    }
  const auto lengthOf = [] (const Trace& trace) {
    return std::accumulate (trace.lengths.begin(), trace.lengths.end(), 0.0);
  };
  if (!all_truth.lengths.empty())
    result.salient_part = lengthOf (salient_truth) / lengthOf (all_truth);
  result.precision = partNear (drawn, all_truth, tolerance);
  result.recall = partNear (salient_truth, drawn, tolerance);
  return result;
}

std::vector<TruthSegment>
salientLines (const std::vector<TruthSegment>& truth)
{
  pcl::crest::PerType<double> strongest{0.0, 0.0};
  for (const TruthSegment& s : truth)
    strongest[s.type] = std::max (strongest[s.type], s.curvature);
  constexpr double LEAST_TURN = 34.0 * 3.14159265358979323846 / 180.0;
  std::vector<TruthSegment> salient;
  for (const TruthSegment& s : truth) {
    const double q = s.sharpness / std::pow (s.curvature, 3);
    if (q > 0.3 && 4.0 / 3.0 * std::sqrt (2.0 / q) >= LEAST_TURN &&
        s.curvature >= 0.25 * strongest[s.type])
      salient.push_back (s);
  }
  return salient;
}

LineScore
scoreLines (const std::vector<pcl::crest::CrestLine>& lines,
            const pcl::PointCloud<pcl::PointNormal>& line_cloud,
            const std::vector<TruthSegment>& truth,
            pcl::crest::CrestType type,
            double tolerance)
{
  // Distances are those to points: they have to be closer than what is measured.
  constexpr int PIECES = 8;
  Trace all;
  Trace salient;
  for (const TruthSegment& s : truth)
    if (s.type == type)
      all.add (s.a, s.b, PIECES);
  for (const TruthSegment& s : salientLines (truth))
    if (s.type == type)
      salient.add (s.a, s.b, PIECES);
  Trace drawn;
  LineScore result;
  for (const pcl::crest::CrestLine& line : lines)
    if (line.type == type)
      for (const auto& polyline : line.polylines)
        for (std::size_t i = 1; i < polyline.size(); ++i)
          drawn.add (line_cloud[polyline[i - 1]].getVector3fMap().cast<double>(),
                     line_cloud[polyline[i]].getVector3fMap().cast<double>(),
                     PIECES);
  for (const double length : drawn.lengths)
    result.drawn_length += length;
  for (const double length : salient.lengths)
    result.salient_length += length;
  result.precision = partNear (drawn, all, tolerance, &result.error);
  result.recall = partNear (salient, drawn, tolerance);
  return result;
}

} // namespace oracle
