// SPDX-License-Identifier: BSD-3-Clause
// Eight fits at a time against one at a time by QR decomposition in doubles.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "curvature/scale_kernels.h"

#include <cmath>
#include <random>
#include <vector>

using namespace pcl::crest;

namespace {

constexpr int NODES = 40;
constexpr int FEWER = 28;
constexpr int TERMS = 10;

/** \brief Nodes around others on surfaces z = a x^2 + b x y + c y^2 with a slope and
 * some noise, turned anyhow; the last lane has fewer of them.
 */
struct Surroundings {
  std::vector<NodeRow> rows;
  FloatVectorRow normals;

  explicit Surroundings (float noise) : rows (NODES)
  {
    std::mt19937 random (1);
    std::uniform_real_distribution<float> number (-1.0F, 1.0F);
    for (int lane = 0; lane < FLOAT_LANES; ++lane) {
      const float a = number (random);
      const float b = number (random);
      const float c = number (random);
      // In some of them little enough not to be tilted to, in others not.
      const float slope = 0.03F * static_cast<float> (lane);
      const float x = number (random);
      const float y = number (random);
      const Eigen::Vector3f axis = Eigen::Vector3f (x, y, number (random)).normalized();
      const Eigen::Matrix3f turn = Eigen::AngleAxisf (2.0F, axis).toRotationMatrix();
      set (turn.col (2), lane, normals);
      for (int i = 0; i < NODES; ++i) {
        const float u = i == 0 ? 0.0F : 0.7F * number (random);
        const float v = i == 0 ? 0.0F : 0.7F * number (random);
        const float z = slope * u + 0.2F * (a * u * u + b * u * v + c * v * v) +
                        noise * number (random);
        const bool is_none = lane == FLOAT_LANES - 1 && i >= FEWER;
        const Eigen::Vector3f edge = turn * Eigen::Vector3f (u, v, z);
        set (is_none ? Eigen::Vector3f::Zero().eval() : edge, lane, rows[i].edge);
        rows[i].weight[lane] = is_none ? 0.0F : 2.0F + number (random);
      }
    }
  }

  ScaleFitRow
  fit (Simd simd) const
  {
    std::vector<FrameRow> room (NODES);
    ScaleFitRow fits;
    scaleKernels (simd).fit (rows.data(), NODES, normals, room.data(), fits);
    return fits;
  }

  static void
  set (const Eigen::Vector3f& vector, int lane, FloatVectorRow& row)
  {
    row.x[lane] = vector.x();
    row.y[lane] = vector.y();
    row.z[lane] = vector.z();
  }

  static Eigen::Vector3d
  at (const FloatVectorRow& row, int lane)
  {
    return {row.x[lane], row.y[lane], row.z[lane]};
  }
};

/** \brief The same in doubles, with the frame tilted by the same rule. */
struct ByQr {
  Eigen::Vector3d normal;
  Eigen::Vector3d t1;
  double k1, k2, offset, variance, k1_variance;

  ByQr (const Surroundings& nodes, int lane)
  {
    Eigen::Vector3d n = Surroundings::at (nodes.normals, lane).normalized();
    Eigen::VectorXd c;
    Eigen::MatrixXd matrix (NODES, TERMS);
    Eigen::Vector3d x;
    Eigen::Vector3d y;
    double kernel = 0.0;
    double kernel_weight = 0.0;
    double weight = 0.0;
    double residual = 0.0;
    for (int round = 1;; ++round) {
      x = n.unitOrthogonal();
      y = n.cross (x);
      kernel = kernel_weight = weight = 0.0;
      Eigen::VectorXd heights (NODES);
      for (int i = 0; i < NODES; ++i) {
        const Eigen::Vector3d e = Surroundings::at (nodes.rows[i].edge, lane);
        const double samples = nodes.rows[i].weight[lane];
        const double g = samples > 0.0 ? std::pow (1.0 - e.squaredNorm(), 2) : 0.0;
        kernel += g;
        weight += g * samples;
        kernel_weight += g * g * samples;
        const double root = std::sqrt (g * samples);
        const double u = e.dot (x);
        const double v = e.dot (y);
        matrix.row (i) << 1, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v,
            v * v * v;
        matrix.row (i) *= root;
        heights[i] = root * e.dot (n);
      }
      c = matrix.colPivHouseholderQr().solve (heights);
      residual = (matrix * c - heights).squaredNorm();
      normal = (n - c[1] * x - c[2] * y).normalized();
      if (round == 3 || std::hypot (c[1], c[2]) < 0.05)
        break;
      n = normal;
    }
    // Shape operator: first times second fundamental form, by their definition.
    const double norm = std::sqrt (1.0 + c[1] * c[1] + c[2] * c[2]);
    Eigen::Matrix2d first;
    Eigen::Matrix2d second;
    first << 1.0 + c[1] * c[1], c[1] * c[2], c[1] * c[2], 1.0 + c[2] * c[2];
    second << 2.0 * c[3], c[4], c[4], 2.0 * c[5];
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver (
        -second / norm, first);
    const Eigen::Vector2d& k = solver.eigenvalues();
    const int larger = std::abs (k[0]) > std::abs (k[1]) ? 0 : 1;
    k1 = k[larger];
    k2 = k[1 - larger];
    const Eigen::Vector2d d = solver.eigenvectors().col (larger).normalized();
    t1 = (d.x() * x + d.y() * y + (c[1] * d.x() + c[2] * d.y()) * n).normalized();
    offset = c[0] / norm;
    const double kappa = kernel_weight / weight;
    variance = residual / std::max (kernel - 0.6 * kappa * TERMS, 0.1 * kernel);
    Eigen::VectorXd bend = Eigen::VectorXd::Zero (TERMS);
    bend.segment<3> (3) << 2.0 * d.x() * d.x(), 2.0 * d.x() * d.y(),
        2.0 * d.y() * d.y();
    const Eigen::MatrixXd covariance = (matrix.transpose() * matrix).inverse();
    k1_variance = variance * 0.615 * kappa * bend.dot (covariance * bend);
  }
};

void
expectSame (const FloatRow& a, const FloatRow& b)
{
  for (int lane = 0; lane < FLOAT_LANES; ++lane)
    EXPECT_EQ (a[lane], b[lane]) << lane;
}

void
expectSame (const FloatVectorRow& a, const FloatVectorRow& b)
{
  expectSame (a.x, b.x);
  expectSame (a.y, b.y);
  expectSame (a.z, b.z);
}

} // namespace

TEST (ScaleKernels, FitAsQrDoes)
{
  for (const float noise : {0.0F, 0.02F}) {
    const Surroundings nodes (noise);
    const ScaleFitRow fits = nodes.fit (bestSimd());
    for (int lane = 0; lane < FLOAT_LANES; ++lane) {
      const ByQr qr (nodes, lane);
      ASSERT_EQ (fits.valid[lane], 1.0F);
      EXPECT_NEAR (fits.k1[lane], qr.k1, 1e-4) << lane;
      EXPECT_NEAR (fits.k2[lane], qr.k2, 1e-4) << lane;
      EXPECT_NEAR (fits.offset[lane], qr.offset, 1e-5) << lane;
      EXPECT_NEAR (std::abs (Surroundings::at (fits.t1, lane).dot (qr.t1)), 1.0, 1e-5);
      EXPECT_NEAR (Surroundings::at (fits.normal, lane).dot (qr.normal), 1.0, 1e-6);
      EXPECT_NEAR (std::sqrt (fits.variance[lane]), std::sqrt (qr.variance), 1e-5);
      EXPECT_NEAR (
          std::sqrt (fits.k1_variance[lane]), std::sqrt (qr.k1_variance), 1e-3);
    }
  }
}

TEST (ScaleKernels, FitsOfOppositeNormalsAreMirrorImages)
{
  Surroundings nodes (0.02F);
  const ScaleFitRow fits = nodes.fit (bestSimd());
  for (int lane = 0; lane < FLOAT_LANES; ++lane)
    Surroundings::set (
        -Surroundings::at (nodes.normals, lane).cast<float>(), lane, nodes.normals);
  const ScaleFitRow opposite = nodes.fit (bestSimd());
  for (int lane = 0; lane < FLOAT_LANES; ++lane) {
    EXPECT_EQ (fits.k1[lane], -opposite.k1[lane]);
    EXPECT_EQ (fits.k2[lane], -opposite.k2[lane]);
  }
}

TEST (ScaleKernels, AreTheSameForAllInstructions)
{
  const Surroundings nodes (0.02F);
  const ScaleFitRow portable = nodes.fit (Simd::PORTABLE);
  const ScaleFitRow best = nodes.fit (bestSimd());
  expectSame (portable.k1, best.k1);
  expectSame (portable.k2, best.k2);
  expectSame (portable.t1, best.t1);
  expectSame (portable.normal, best.normal);
  expectSame (portable.offset, best.offset);
  expectSame (portable.variance, best.variance);
  expectSame (portable.k1_variance, best.k1_variance);
  expectSame (portable.valid, best.valid);
}

TEST (ScaleKernels, LanesDoNotSeeEachOther)
{
  Surroundings nodes (0.02F);
  const ScaleFitRow fits = nodes.fit (bestSimd());
  constexpr int EMPTY = 2;
  constexpr int LINE = 5;
  for (NodeRow& row : nodes.rows) {
    Surroundings::set (Eigen::Vector3f::Zero(), EMPTY, row.edge);
    row.weight[EMPTY] = 0.0F;
    Surroundings::set ({row.edge.x[LINE], 0.0F, 0.0F}, LINE, row.edge);
  }
  const ScaleFitRow others = nodes.fit (bestSimd());
  for (int lane = 0; lane < FLOAT_LANES; ++lane) {
    const bool is_other = lane == EMPTY || lane == LINE;
    EXPECT_EQ (others.valid[lane], is_other ? 0.0F : 1.0F) << lane;
    if (!is_other) {
      EXPECT_EQ (others.k1[lane], fits.k1[lane]);
      EXPECT_EQ (others.variance[lane], fits.variance[lane]);
    }
  }
}
