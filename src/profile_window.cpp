// SPDX-License-Identifier: BSD-3-Clause
#include "profile_window.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** Fewer nodes than this tell nothing about a profile, nor fewer beside the middle on
 * either side of it: there data ends. */
constexpr int LEAST_NODES = 8;
constexpr int LEAST_BESIDE = 2;
constexpr double BESIDE = 0.1;

} // namespace

ProfileParabola
ProfilePolynomial::at (double u, double v) const
{
  const auto& c = coefficients;
  return {c[1] + 2.0 * c[2] * u + c[4] * v + c[6] * v * v, c[2]};
}

ProfileWindow::ProfileWindow (const PyramidLevel& level,
                              const std::vector<ScaleFit>& fits,
                              double elongation)
: level_ (level), fits_ (fits), elongation_ (elongation), walk_ (level.graph)
{}

ProfilePolynomial
ProfileWindow::fit (index_t node, double window)
{
  constexpr int TERMS = ProfilePolynomial::TERMS;
  using Row = Eigen::Matrix<double, TERMS, 1>;

  const ScaleFit& own = fits_[node];
  const double sign = own.k1 > 0.0 ? 1.0 : -1.0;
  const Eigen::Vector3d t2 = own.normal.cross (own.t1);
  const auto surface = [&] (index_t q) -> Eigen::Vector3d {
    return level_.positions[q].cast<double>() + fits_[q].offset * fits_[q].normal;
  };
  const Eigen::Vector3d origin = surface (node);
  const bool round = elongation_ == 1.0;

  Eigen::Matrix<double, TERMS, TERMS> matrix =
      Eigen::Matrix<double, TERMS, TERMS>::Zero();
  Row right_side = Row::Zero();
  double weight = 0.0;
  double variance = 0.0;
  int count = 0;
  int ahead = 0;
  int behind = 0;

  const auto any = [] (index_t) { return true; };
  walk_.start (node);
  const std::vector<index_t>& reached = walk_.reached();
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const index_t q = reached[i];
    const ScaleFit& fit = fits_[q];
    if (!fit.valid || fit.normal.dot (own.normal) < SAME_SHEET_COSINE)
      continue;
    const Eigen::Vector3d d = (surface (q) - origin) / window;
    const double u = d.dot (own.t1);
    const double g =
        1.0 - u * u - (d.squaredNorm() - u * u) / (elongation_ * elongation_);
    if (g <= 0.0)
      continue;
    walk_.expand (q, any);
    const double v = d.dot (t2);
    const double w = g * g;
    Row row;
    row << 1.0, u, u * u, v, u * v, v * v, round ? 0.0 : u * v * v;
    right_side += w * std::max (sign * fit.k1, sign * fit.k2) * row;
    matrix.selfadjointView<Eigen::Lower>().rankUpdate (row, w);
    weight += w;
    variance += w * fit.k1_error * fit.k1_error;
    ++count;
    ahead += u > BESIDE ? 1 : 0;
    behind += u < -BESIDE ? 1 : 0;
  }
  ProfilePolynomial result;
  if (ahead < LEAST_BESIDE || behind < LEAST_BESIDE || count < LEAST_NODES)
    return result;
  matrix.diagonal().array() += 1e-5 * weight;
  const Eigen::LLT<Eigen::Matrix<double, TERMS, TERMS>, Eigen::Lower> solver (matrix);
  result.coefficients = solver.solve (right_side);
  result.window = window;
  result.k1_error = std::sqrt (variance / weight);
  result.valid = result.coefficients.allFinite();
  return result;
}

} // namespace crest
} // namespace pcl
