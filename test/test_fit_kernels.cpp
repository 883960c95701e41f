// SPDX-License-Identifier: BSD-3-Clause
// Four fits at a time against one at a time by QR decomposition.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fit_kernels.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace pcl::crest;

namespace {

constexpr int SAMPLES = 45;

/** \brief Random numbers, other ones in each lane; the last lane has fewer samples. */
template <typename Sample>
std::vector<Sample>
randomSamples (Lanes Sample::*value)
{
  std::mt19937 random (1);
  std::uniform_real_distribution<double> number (-1.0, 1.0);
  std::vector<Sample> samples (SAMPLES);
  for (int i = 0; i < SAMPLES; ++i)
    for (int lane = 0; lane < LANES; ++lane) {
      Sample& s = samples[i];
      s.u[lane] = number (random);
      s.v[lane] = number (random);
      (s.*value)[lane] = number (random);
      s.weight[lane] = 1.1 + number (random);
      if (lane == LANES - 1 && i >= 30)
        s.clear (lane);
    }
  return samples;
}

/** \brief The same least squares problem, weights included. */
template <typename Sample, typename Row>
Eigen::VectorXd
solveByQr (const std::vector<Sample>& samples,
           Lanes Sample::*value,
           int lane,
           int terms,
           const Row& row,
           Eigen::MatrixXd& matrix,
           double& residual)
{
  matrix.resize (SAMPLES, terms);
  Eigen::VectorXd values (SAMPLES);
  for (int i = 0; i < SAMPLES; ++i) {
    const Sample& s = samples[i];
    const double root = std::sqrt (s.weight[lane]);
    for (int j = 0; j < terms; ++j)
      matrix (i, j) = root * row (j, s.u[lane], s.v[lane]);
    values[i] = root * (s.*value)[lane];
  }
  const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve (values);
  residual = (matrix * solution - values).squaredNorm();
  return solution;
}

double
cubicTerm (int i, double u, double v)
{
  constexpr int A[] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
  constexpr int B[] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};
  return std::pow (u, A[i]) * std::pow (v, B[i]);
}

double
profileTerm (int i, double u, double v)
{
  const double terms[] = {1.0, u, u * u, v, u * v, v * v, u * v * v};
  return terms[i];
}

void
expectSame (const Lanes& a, const Lanes& b)
{
  for (int lane = 0; lane < LANES; ++lane)
    EXPECT_EQ (a[lane], b[lane]);
}

} // namespace

TEST (FitKernels, FitCubicsAsQrDoes)
{
  const auto samples = randomSamples<HeightSample> (&HeightSample::z);
  const FitKernels& kernels = fitKernels();
  // In parts, as windows that grow do.
  CubicSums sums;
  kernels.addHeights (samples.data(), 20, sums);
  kernels.addHeights (samples.data() + 20, SAMPLES - 20, sums);
  CubicFit fit;
  kernels.fitCubics (sums, fit);
  const double x = 0.6;
  const double y = 0.8;
  Lanes variance;
  kernels.bendVariance (fit, Lanes{} + x, Lanes{} + y, variance);
  for (int lane = 0; lane < LANES; ++lane) {
    Eigen::MatrixXd matrix;
    double residual = 0.0;
    const Eigen::VectorXd solution = solveByQr (
        samples, &HeightSample::z, lane, CubicSums::TERMS, cubicTerm, matrix, residual);
    for (int i = 0; i < CubicSums::TERMS; ++i)
      EXPECT_NEAR (fit.coefficients[i][lane], solution[i], 1e-6) << i;
    EXPECT_NEAR (fit.residual[lane], residual, 1e-6);
    // The second derivative along (x, y) is this linear function of the solution.
    Eigen::VectorXd bend = Eigen::VectorXd::Zero (CubicSums::TERMS);
    bend.segment<3> (3) << 2.0 * x * x, 2.0 * x * y, 2.0 * y * y;
    const Eigen::MatrixXd covariance = (matrix.transpose() * matrix).inverse();
    EXPECT_NEAR (variance[lane] / bend.dot (covariance * bend), 1.0, 1e-6);
  }
}

TEST (FitKernels, FitProfilesAsQrDoes)
{
  const auto samples = randomSamples<ProfileSample> (&ProfileSample::value);
  for (const bool bent : {false, true}) {
    ProfileFit fit;
    fitKernels().fitProfiles (samples.data(), SAMPLES, bent, fit);
    for (int lane = 0; lane < LANES; ++lane) {
      Eigen::MatrixXd matrix;
      double residual = 0.0;
      const int terms = bent ? ProfileFit::TERMS : ProfileFit::TERMS - 1;
      const Eigen::VectorXd solution = solveByQr (
          samples, &ProfileSample::value, lane, terms, profileTerm, matrix, residual);
      // Terms that samples leave open are damped a little.
      for (int i = 0; i < terms; ++i)
        EXPECT_NEAR (fit.coefficients[i][lane], solution[i], 1e-3) << i;
      if (!bent) {
        EXPECT_EQ (fit.coefficients[ProfileFit::TERMS - 1][lane], 0.0);
      }
    }
  }
}

TEST (FitKernels, AreTheSameForAllInstructions)
{
  // Where there is no AVX2 these are the portable kernels twice.
  const auto heights = randomSamples<HeightSample> (&HeightSample::z);
  const auto values = randomSamples<ProfileSample> (&ProfileSample::value);
  CubicSums sums[2];
  CubicFit cubics[2];
  Lanes variances[2];
  ProfileFit profiles[2];
  for (int i = 0; i < 2; ++i) {
    const FitKernels& kernels = fitKernels (i == 0 ? Simd::PORTABLE : Simd::AVX2);
    kernels.addHeights (heights.data(), SAMPLES, sums[i]);
    kernels.fitCubics (sums[i], cubics[i]);
    kernels.bendVariance (cubics[i], heights[0].u, heights[0].v, variances[i]);
    kernels.fitProfiles (values.data(), SAMPLES, true, profiles[i]);
  }
  for (int i = 0; i < CubicSums::TERMS; ++i)
    expectSame (cubics[0].coefficients[i], cubics[1].coefficients[i]);
  expectSame (cubics[0].residual, cubics[1].residual);
  expectSame (variances[0], variances[1]);
  for (int i = 0; i < ProfileFit::TERMS; ++i)
    expectSame (profiles[0].coefficients[i], profiles[1].coefficients[i]);
}

TEST (FitKernels, FitsThatHaveNothingToFitLeaveOthersAlone)
{
  auto samples = randomSamples<HeightSample> (&HeightSample::z);
  const auto fitted = [&samples] {
    CubicSums sums;
    fitKernels().addHeights (samples.data(), SAMPLES, sums);
    CubicFit fit;
    fitKernels().fitCubics (sums, fit);
    return fit;
  };
  const CubicFit full = fitted();
  for (HeightSample& sample : samples)
    sample.clear (1);
  const CubicFit emptied = fitted();
  for (int i = 0; i < CubicSums::TERMS; ++i) {
    EXPECT_FALSE (std::isfinite (emptied.coefficients[i][1]));
    for (const int lane : {0, 2, 3})
      EXPECT_EQ (emptied.coefficients[i][lane], full.coefficients[i][lane]);
  }
}
