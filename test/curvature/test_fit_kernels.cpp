// SPDX-License-Identifier: BSD-3-Clause
// Four fits at a time against one at a time by QR decomposition.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "curvature/fit_kernels.h"

#include <cmath>
#include <random>
#include <vector>

using namespace pcl::crest;

namespace {

constexpr int SAMPLES = 45;

/** \brief Random numbers, other ones in each lane; the last lane has fewer samples. */
std::vector<LaneSample>
randomSamples ()
{
  std::mt19937 random (1);
  std::uniform_real_distribution<double> number (-1.0, 1.0);
  std::vector<LaneSample> samples (SAMPLES);
  for (int i = 0; i < SAMPLES; ++i)
    for (int lane = 0; lane < LANES; ++lane) {
      LaneSample& s = samples[i];
      s.u[lane] = number (random);
      s.v[lane] = number (random);
      s.value[lane] = number (random);
      s.weight[lane] = 1.1 + number (random);
      if (lane == LANES - 1 && i >= 30)
        s.clear (lane);
    }
  return samples;
}

/** \brief The same least squares problem, weights included, and its solution. */
struct ByQr {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd solution;
  double residual;

  template <typename Term>
  ByQr (const std::vector<LaneSample>& samples, int lane, int terms, const Term& term)
  : matrix (SAMPLES, terms)
  {
    Eigen::VectorXd values (SAMPLES);
    for (int i = 0; i < SAMPLES; ++i) {
      const LaneSample& s = samples[i];
      const double root = std::sqrt (s.weight[lane]);
      for (int j = 0; j < terms; ++j)
        matrix (i, j) = root * term (j, s.u[lane], s.v[lane]);
      values[i] = root * s.value[lane];
    }
    solution = matrix.colPivHouseholderQr().solve (values);
    residual = (matrix * solution - values).squaredNorm();
  }
};

double
cubicTerm (int i, double u, double v)
{
  constexpr int A[] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
  constexpr int B[] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};
  return std::pow (u, A[i]) * std::pow (v, B[i]);
}

double
quadricTerm (int i, double u, double v)
{
  const double terms[] = {0.5 * u * u, u * v, 0.5 * v * v};
  return terms[i];
}

/** \brief Edges and unit normals; the last lane has fewer edges. */
struct Stars {
  LaneVector normals;
  std::vector<LaneVector> edges;

  Stars() : edges (SAMPLES)
  {
    std::mt19937 random (2);
    std::normal_distribution<double> number;
    const auto vector = [&] {
      const double x = number (random);
      const double y = number (random);
      return Eigen::Vector3d (x, y, number (random));
    };
    for (int lane = 0; lane < LANES; ++lane) {
      normals.set (lane, vector().normalized());
      for (int i = 0; i < SAMPLES; ++i)
        edges[i].set (lane,
                      lane == LANES - 1 && i >= 30 ? Eigen::Vector3d::Zero().eval()
                                                   : vector());
    }
    // Where the sign of z decides how axes are made.
    normals.set (0, -Eigen::Vector3d::UnitZ());
    normals.set (1, Eigen::Vector3d::UnitX());
  }

  QuadricFit
  fit (const FitKernels& kernels) const
  {
    QuadricFit result;
    kernels.fitQuadrics (normals, edges.data(), SAMPLES, result);
    return result;
  }
};

void
expectSame (const Lanes& a, const Lanes& b)
{
  for (int lane = 0; lane < LANES; ++lane)
    EXPECT_EQ (a[lane], b[lane]);
}

} // namespace

TEST (FitKernels, FitQuadricsAsQrDoes)
{
  const Stars stars;
  const QuadricFit fit = stars.fit (fitKernels());
  for (int lane = 0; lane < LANES; ++lane) {
    const Eigen::Vector3d n = stars.normals[lane];
    const Eigen::Vector3d x = fit.x[lane];
    const Eigen::Vector3d y = fit.y[lane];
    Eigen::Matrix3d frame;
    frame << x, y, n;
    EXPECT_TRUE (frame.isUnitary (1e-12)) << frame;
    std::vector<LaneSample> samples (SAMPLES);
    for (int i = 0; i < SAMPLES; ++i) {
      const Eigen::Vector3d e = stars.edges[i][lane];
      samples[i].u[lane] = e.dot (x);
      samples[i].v[lane] = e.dot (y);
      samples[i].value[lane] = e.dot (n);
      samples[i].weight[lane] = 1.0;
    }
    const Eigen::VectorXd shape = ByQr (samples, lane, 3, quadricTerm).solution;
    Eigen::Matrix2d matrix;
    matrix << -shape[0], -shape[1], -shape[1], -shape[2];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver (matrix);
    const Eigen::Vector2d& k = solver.eigenvalues();
    const int larger = std::abs (k[0]) > std::abs (k[1]) ? 0 : 1;
    EXPECT_NEAR (fit.k1[lane], k[larger], 1e-10);
    EXPECT_NEAR (fit.k2[lane], k[1 - larger], 1e-10);
    const Eigen::Vector2d direction = solver.eigenvectors().col (larger);
    const Eigen::Vector3d t1 = direction.x() * x + direction.y() * y;
    EXPECT_NEAR (std::abs (t1.dot (fit.t1[lane])), 1.0, 1e-10);
  }
}

TEST (FitKernels, QuadricsOfOppositeNormalsAreMirrorImages)
{
  Stars stars;
  const QuadricFit fit = stars.fit (fitKernels());
  for (int lane = 0; lane < LANES; ++lane)
    stars.normals.set (lane, -stars.normals[lane]);
  const QuadricFit opposite = stars.fit (fitKernels());
  expectSame (fit.k1, -opposite.k1);
  expectSame (fit.k2, -opposite.k2);
}

TEST (FitKernels, FitCubicsAsQrDoes)
{
  const auto samples = randomSamples();
  const FitKernels& kernels = fitKernels();
  // In parts, as windows that grow do.
  CubicSums sums;
  kernels.addHeights (samples.data(), 20, sums);
  kernels.addHeights (samples.data() + 20, SAMPLES - 20, sums);
  CubicFit fit;
  kernels.fitCubics (sums, fit);
  for (int lane = 0; lane < LANES; ++lane) {
    const ByQr qr (samples, lane, CubicSums::TERMS, cubicTerm);
    for (int i = 0; i < CubicSums::TERMS; ++i)
      EXPECT_NEAR (fit.coefficients[i][lane], qr.solution[i], 1e-6) << i;
    EXPECT_NEAR (fit.residual[lane], qr.residual, 1e-6);
  }
}

TEST (FitKernels, AreTheSameForAllInstructions)
{
  if (!isAvailable (Simd::AVX2))
    GTEST_SKIP() << "this machine has the portable kernels alone";
  const FitKernels& portable = fitKernels (Simd::PORTABLE);
  const FitKernels& avx2 = fitKernels (Simd::AVX2);
  const Stars stars;
  const QuadricFit quadric = stars.fit (portable);
  const QuadricFit other_quadric = stars.fit (avx2);
  expectSame (quadric.k1, other_quadric.k1);
  expectSame (quadric.k2, other_quadric.k2);
  expectSame (quadric.t1.x, other_quadric.t1.x);
  expectSame (quadric.independence, other_quadric.independence);

  const auto samples = randomSamples();
  const auto fitCubics = [&samples] (const FitKernels& kernels, CubicFit& fit) {
    CubicSums sums;
    kernels.addHeights (samples.data(), SAMPLES, sums);
    kernels.fitCubics (sums, fit);
  };
  CubicFit cubic;
  CubicFit other_cubic;
  fitCubics (portable, cubic);
  fitCubics (avx2, other_cubic);
  for (int i = 0; i < CubicSums::TERMS; ++i)
    expectSame (cubic.coefficients[i], other_cubic.coefficients[i]);
  expectSame (cubic.residual, other_cubic.residual);
}

TEST (FitKernels, FitsThatHaveNothingToFitLeaveOthersAlone)
{
  auto samples = randomSamples();
  const auto fitted = [&samples] {
    CubicSums sums;
    fitKernels().addHeights (samples.data(), SAMPLES, sums);
    CubicFit fit;
    fitKernels().fitCubics (sums, fit);
    return fit;
  };
  const CubicFit full = fitted();
  for (LaneSample& sample : samples)
    sample.clear (1);
  const CubicFit emptied = fitted();
  for (int i = 0; i < CubicSums::TERMS; ++i) {
    EXPECT_FALSE (std::isfinite (emptied.coefficients[i][1]));
    for (const int lane : {0, 2, 3})
      EXPECT_EQ (emptied.coefficients[i][lane], full.coefficients[i][lane]);
  }
}
