// SPDX-License-Identifier: BSD-3-Clause
#include "profile_window.h"

#include <Eigen/Geometry>

#include "large_arrays.h"
#include "node_walk.h"
#include "parallel.h"
#include "small_cholesky.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** Half the window's width, in spacings of the nodes. */
constexpr double WINDOW = 2.5;

/** Fewer nodes than this tell nothing about a profile. */
constexpr int LEAST_NODES = 8;
/** Nearer than this nodes are not beside a place, in units of the window. */
constexpr double BESIDE = 0.3;

/** \brief The polynomial of one node. */
ProfilePolynomial
fitPolynomial (const PyramidLevel& level,
               const std::vector<ScaleFit>& fits,
               double elongation,
               double window,
               index_t node,
               NodeWalk& walk)
{
  constexpr int TERMS = ProfilePolynomial::TERMS;
  // Padded, so that two products are added at once: each row of the lower triangle has
  // an even number of them.
  constexpr int WIDTH = TERMS + 1;

  const ScaleFit& own = fits[node];
  const double sign = own.k1 > 0.0 ? 1.0 : -1.0;
  const Eigen::Vector3d t2 = own.normal.cross (own.t1);
  const auto surface = [&] (index_t q) -> Eigen::Vector3d {
    return level.positions[q].cast<double>() + fits[q].offset * fits[q].normal;
  };
  const Eigen::Vector3d origin = surface (node);
  const bool round = elongation == 1.0;

  double products[TERMS][WIDTH] = {};
  double sums[WIDTH] = {};
  double weight = 0.0;
  double variance = 0.0;
  int count = 0;
  double lowest_u = 1.0;
  double highest_u = -1.0;
  ProfilePolynomial result;
  result.first_u = 1.0;
  result.last_u = -1.0;

  const auto any = [] (index_t) { return true; };
  walk.start (node);
  const std::vector<index_t>& reached = walk.reached();
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const index_t q = reached[i];
    const ScaleFit& fit = fits[q];
    if (!fit.valid || fit.normal.dot (own.normal) < SAME_SHEET_COSINE)
      continue;
    const Eigen::Vector3d d = (surface (q) - origin) / window;
    const double u = d.dot (own.t1);
    const double g =
        1.0 - u * u - (d.squaredNorm() - u * u) / (elongation * elongation);
    if (g <= 0.0)
      continue;
    walk.expand (q, any);
    const double v = d.dot (t2);
    const double w = g * g;
    const double row[WIDTH] = {
        1.0, u, u * u, v, u * v, v * v, round ? 0.0 : u * v * v, 0.0};
    const double wk = w * std::max (sign * fit.k1, sign * fit.k2);
    for (int a = 0; a < WIDTH; ++a)
      sums[a] += wk * row[a];
    for (int a = 0; a < TERMS; ++a) {
      const double wa = w * row[a];
      for (int b = 0; b <= a / 2 * 2 + 1; ++b)
        products[a][b] += wa * row[b];
    }
    weight += w;
    variance += w * fit.k1_error * fit.k1_error;
    ++count;
    result.first_u = std::min (result.first_u, std::max (u, lowest_u));
    lowest_u = std::min (lowest_u, u);
    result.last_u = std::max (result.last_u, std::min (u, highest_u));
    highest_u = std::max (highest_u, u);
  }
  if (!result.covers (0.0) || count < LEAST_NODES)
    return result;
  Eigen::Matrix<double, TERMS, TERMS> matrix;
  for (int a = 0; a < TERMS; ++a) {
    for (int b = 0; b <= a; ++b)
      matrix (a, b) = products[a][b];
    matrix (a, a) += 1e-5 * weight;
  }
  result.coefficients = SmallCholesky<TERMS> (matrix).solve (
      Eigen::Map<const Eigen::Matrix<double, TERMS, 1>> (sums));
  result.window = window;
  result.k1_error = std::sqrt (variance / weight);
  result.valid = result.coefficients.allFinite();
  return result;
}

} // namespace

double
ProfileParabola::bendOnCurvatureLine (double curvature_difference,
                                      double drift_error) const
{
  // A half more than it is: what is left of a maximum that the turn nearly undoes is
  // within the error of both.
  constexpr double CAUTION = 1.5;
  const double squared_drift =
      std::max (0.0, drift * drift - drift_error * drift_error);
  return bend + CAUTION * squared_drift / (2.0 * curvature_difference);
}

ProfileParabola
ProfilePolynomial::at (double u, double v) const
{
  const auto& c = coefficients;
  return {c[1] + 2.0 * c[2] * u + c[4] * v + c[6] * v * v,
          c[2],
          c[3] + c[4] * u + 2.0 * c[5] * v + 2.0 * c[6] * u * v};
}

bool
ProfilePolynomial::covers (double u) const
{
  return first_u < u - BESIDE && last_u > u + BESIDE;
}

std::vector<ProfilePolynomial>
fitPolynomials (const PyramidLevel& level,
                const std::vector<ScaleFit>& fits,
                const std::vector<std::uint8_t>& needed,
                int nodes_of_fit,
                double elongation,
                const Workers& workers)
{
  std::vector<ProfilePolynomial> polynomials =
      makeLarge (level.size(), ProfilePolynomial());
  forEachBlock (
      level.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        NodeWalk walk (level.graph);
        for (std::size_t i = first; i < last; ++i)
          if (needed[i] != 0 && fits[i].valid) {
            const double spacing = fits[i].radius / std::sqrt (nodes_of_fit / M_PI);
            polynomials[i] = fitPolynomial (level,
                                            fits,
                                            elongation,
                                            WINDOW * spacing,
                                            static_cast<index_t> (i),
                                            walk);
          }
      });
  return polynomials;
}

int
ringsOfWindow (double elongation)
{
  return static_cast<int> (std::ceil (WINDOW * elongation));
}

} // namespace crest
} // namespace pcl
