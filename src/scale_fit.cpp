// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/scale_fit.h>

#include <Eigen/Geometry>

#include "cubic_moments.h"
#include "large_arrays.h"
#include "node_walk.h"
#include "parallel.h"
#include "small_cholesky.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

constexpr int TERMS = CubicMoments::TERMS;

/** \brief What the i-th coefficient, a derivative of the cubic at the node, is divided
 * by where it is that of a monomial.
 */
constexpr double
factorials (int i)
{
  constexpr double FACTORIAL[CubicMoments::DEGREE + 1] = {1.0, 1.0, 2.0, 6.0};
  return FACTORIAL[CubicMoments::A[i]] * FACTORIAL[CubicMoments::B[i]];
}

/** Fewer nodes than this leave too little to tell noise from shape by. */
constexpr std::size_t LEAST_NODES = TERMS + 4;

/** The frame is tilted again where its slope is above a twentieth (3 degrees). */
constexpr double LARGEST_SQUARED_SLOPE = 0.05 * 0.05;
constexpr int MOST_FITS = 3;

/** \brief The weights of the fit are no inverse variances, as they fall off to the rim.
 * With kappa the mean of the kernel g under the weights, kappa A^-1 is near to the true
 * covariance A^-1 (sum g w x x^T) A^-1, but not near enough for a test; these are the
 * ratios of the true values to it for a cubic under (1 - r^2)^2 on a disc: of the
 * degrees of freedom that the fit takes, and of the variance of a second derivative. By
 * numerical integration; on 28 to 70 scattered nodes they differ by less than .02.
 */
constexpr double TAKEN_FREEDOM = 0.60;
constexpr double CURVATURE_VARIANCE = 0.615;

using Coefficients = Eigen::Matrix<double, TERMS, 1>;
using NormalMatrix = Eigen::Matrix<double, TERMS, TERMS>;

struct Neighbor {
  double squared_distance;
  index_t node;

  bool
  operator<(const Neighbor& o) const
  {
    return squared_distance != o.squared_distance
               ? squared_distance < o.squared_distance
               : node < o.node;
  }
};

/** \brief Sums over the neighbours; lengths in units of the radius, weights are the
 * kernel's times the number of samples.
 */
struct Moments : CubicMoments {
  /** of the kernel, and of kernel squared times samples */
  double kernel = 0.0;
  double kernel_weight = 0.0;

  void
  add (double u, double v, double z, double kernel_value, double samples)
  {
    const double w = kernel_value * samples;
    CubicMoments::add (u, v, z, w);
    kernel += kernel_value;
    kernel_weight += w * kernel_value;
  }
};

/** \brief Whether all are on a line but for rounding: there is no surface then. */
bool
onOneLine (const Moments& m)
{
  constexpr double ROUNDING = 1e-6;
  const double xx = m.powers[2][0];
  const double yy = m.powers[0][2];
  const double xy = m.powers[1][1];
  return !(xx * yy - xy * xy > ROUNDING * (xx + yy) * (xx + yy));
}

struct Frame {
  Eigen::Vector3d x, y, n;

  explicit Frame (const Eigen::Vector3d& normal)
  : x (normal.unitOrthogonal()), y (normal.cross (x)), n (normal)
  {}
};

/** \brief The curvatures and direction (in the frame's x and y) of a height function
 * with the gradient (p, q) and second derivatives r, s, t.
 */
struct Principal {
  double k1, k2, x, y;

  Principal (double p, double q, double r, double s, double t)
  {
    const double norm = std::sqrt (1.0 + p * p + q * q);
    // The height falls where the surface is convex: hence the signs.
    const double L = -r / norm;
    const double M = -s / norm;
    const double N = -t / norm;
    const double E = 1.0 + p * p;
    const double F = p * q;
    const double G = 1.0 + q * q;
    const double area = E * G - F * F;
    const double mean = (L * G - 2.0 * M * F + N * E) / (2.0 * area);
    const double gauss = (L * N - M * M) / area;
    const double half = std::sqrt (std::max (0.0, mean * mean - gauss));
    k1 = mean >= 0.0 ? mean + half : mean - half;
    k2 = mean >= 0.0 ? mean - half : mean + half;
    // Of the two rows of II - k1 I the longer gives the direction safely.
    x = M - k1 * F;
    y = k1 * E - L;
    const double other_x = N - k1 * G;
    const double other_y = k1 * F - M;
    if (other_x * other_x + other_y * other_y > x * x + y * y) {
      x = other_x;
      y = other_y;
    }
    const double length = std::hypot (x, y);
    x = length > 0.0 ? x / length : 1.0; // umbilic: any direction is principal
    y = length > 0.0 ? y / length : 0.0;
  }
};

class CubicFitter {
public:
  CubicFitter (const PyramidLevel& level, int nearest)
  : level_ (level), nearest_ (static_cast<std::size_t> (nearest)), walk_ (level.graph)
  {}

  ScaleFit
  fit (index_t node)
  {
    gather (node);
    if (neighbors_.size() < LEAST_NODES)
      return {};
    double squared_radius = 0.0;
    for (const Neighbor& neighbor : neighbors_)
      squared_radius = std::max (squared_radius, neighbor.squared_distance);
    // A little more, so that the farthest node, too, has a weight.
    const double radius = 1.02 * std::sqrt (squared_radius);
    if (!(radius > 0.0))
      return {};
    Eigen::Vector3d normal = level_.normals[node].cast<double>().normalized();
    ScaleFit result;
    for (int i = 1; i <= MOST_FITS; ++i)
      if (!fitInFrame (node, radius, i == MOST_FITS, normal, result))
        break;
    return result;
  }

private:
  /** \brief The nearest nodes of those that a walk over the surface reaches first: a
   * quarter more than are wanted, as rings are no circles.
   */
  void
  gather (index_t node)
  {
    const Eigen::Vector3f& p = level_.positions[node];
    const Eigen::Vector3f& n = level_.normals[node];
    const auto same_sheet = [&] (index_t q) {
      return level_.normals[q].dot (n) > SAME_SHEET_COSINE;
    };
    const std::size_t enough = nearest_ + nearest_ / 4;
    walk_.start (node);
    const std::vector<index_t>& reached = walk_.reached();
    for (std::size_t i = 0, ring = 1; i < reached.size() && reached.size() < enough;
         ring = reached.size())
      for (; i < ring; ++i)
        walk_.expand (reached[i], same_sheet);
    neighbors_.clear();
    for (const index_t q : reached)
      neighbors_.push_back (
          {(level_.positions[q] - p).cast<double>().squaredNorm(), q});
    if (neighbors_.size() > nearest_) {
      std::nth_element (neighbors_.begin(),
                        neighbors_.begin() + static_cast<std::ptrdiff_t> (nearest_),
                        neighbors_.end());
      neighbors_.resize (nearest_);
    }
  }

  /** \brief One fit; returns whether it has to be repeated with the new normal. */
  bool
  fitInFrame (index_t node,
              double radius,
              bool last,
              Eigen::Vector3d& normal,
              ScaleFit& result) const
  {
    const Frame frame (normal);
    const Moments moments = sum (node, radius, frame);
    if (onOneLine (moments))
      return false;
    NormalMatrix matrix;
    Coefficients right_side;
    for (int i = 0; i < TERMS; ++i) {
      const double scale = 1.0 / factorials (i);
      right_side[i] = scale * moments.height (i);
      for (int j = 0; j <= i; ++j)
        matrix (i, j) = matrix (j, i) = moments.product (i, j) * scale / factorials (j);
      // Nodes on few lines leave some terms open: these become zero.
      matrix (i, i) += 1e-9 * moments.weight;
    }
    const SmallCholesky<TERMS> solver (matrix);
    const Coefficients c = solver.solve (right_side);
    if (!c.allFinite())
      return false;
    const double squared_slope = c[1] * c[1] + c[2] * c[2];
    normal = (frame.n - c[1] * frame.x - c[2] * frame.y).normalized();
    if (!last && squared_slope > LARGEST_SQUARED_SLOPE)
      return true;

    const double residual = std::max (
        0.0, moments.squared_heights - 2.0 * c.dot (right_side) + c.dot (matrix * c));
    const double kappa = moments.kernel_weight / moments.weight;
    const double freedom =
        std::max (moments.kernel - TAKEN_FREEDOM * kappa * TERMS, 0.1 * moments.kernel);
    const double variance = residual / freedom;

    const Principal principal (c[1], c[2], c[3], c[4], c[5]);
    Coefficients direction = Coefficients::Zero();
    direction[3] = principal.x * principal.x;
    direction[4] = 2.0 * principal.x * principal.y;
    direction[5] = principal.y * principal.y;
    const double k1_variance = variance * CURVATURE_VARIANCE * kappa *
                               solver.solveLower (direction).squaredNorm();

    result.k1 = principal.k1 / radius;
    result.k2 = principal.k2 / radius;
    result.t1 = (principal.x * frame.x + principal.y * frame.y +
                 (c[1] * principal.x + c[2] * principal.y) * frame.n)
                    .normalized();
    result.normal = normal;
    result.offset = c[0] * radius * frame.n.dot (normal);
    result.radius = radius;
    result.noise = std::sqrt (variance) * radius;
    result.k1_error = std::sqrt (std::max (0.0, k1_variance)) / radius;
    result.valid = true;
    return false;
  }

  Moments
  sum (index_t node, double radius, const Frame& frame) const
  {
    const Eigen::Vector3d p = level_.positions[node].cast<double>();
    Moments moments;
    for (const Neighbor& neighbor : neighbors_) {
      const Eigen::Vector3d e =
          (level_.positions[neighbor.node].cast<double>() - p) / radius;
      const double g = 1.0 - neighbor.squared_distance / (radius * radius);
      moments.add (e.dot (frame.x),
                   e.dot (frame.y),
                   e.dot (frame.n),
                   g * g,
                   level_.weights[neighbor.node]);
    }
    return moments;
  }

  const PyramidLevel& level_;
  std::size_t nearest_;
  NodeWalk walk_;
  std::vector<Neighbor> neighbors_;
};

/** \brief Replaces each node's estimate of the noise by the mean over its star: one
 * alone, with some ten degrees of freedom, is too uncertain for a test.
 */
void
poolNoise (const PyramidLevel& level,
           std::vector<ScaleFit>& fits,
           const Workers& workers)
{
  std::vector<double> variance (fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i)
    variance[i] = fits[i].noise * fits[i].noise;
  forEachBlock (
      fits.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          ScaleFit& fit = fits[i];
          if (!fit.valid || !(fit.noise > 0.0))
            continue;
          double sum = variance[i];
          int count = 1;
          for (const index_t q : level.graph.star (static_cast<index_t> (i)))
            if (fits[q].valid) {
              sum += variance[q];
              ++count;
            }
          const double pooled = std::sqrt (sum / count);
          fit.k1_error *= pooled / fit.noise;
          fit.noise = pooled;
        }
      });
}

} // namespace

std::vector<ScaleFit>
fitAtScale (const PyramidLevel& level,
            int nearest,
            const std::vector<std::uint8_t>& needed,
            const Workers& workers)
{
  std::vector<ScaleFit> fits = makeLarge (level.size(), ScaleFit());
  forEachBlock (
      level.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        CubicFitter fitter (level, nearest);
        for (std::size_t i = first; i < last; ++i)
          if (needed[i] != 0)
            fits[i] = fitter.fit (static_cast<index_t> (i));
      });
  poolNoise (level, fits, workers);
  return fits;
}

} // namespace crest
} // namespace pcl
