// SPDX-License-Identifier: BSD-3-Clause
// Eight profiles at a time against one at a time by QR decomposition in doubles.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "crests/profile_kernels.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace pcl::crest;

namespace {

constexpr int NODES = 60;
constexpr float ELONGATION = 4.0F;

/** \brief Fits around others, of which some are outside of the window; the last lane
 * has fewer.
 */
struct Surroundings {
  std::vector<NearFitRow> rows;
  FloatVectorRow normals;
  FloatVectorRow t1;
  float elongation;

  explicit Surroundings (float elongation_of) : rows (NODES), elongation (elongation_of)
  {
    std::mt19937 random (1);
    std::uniform_real_distribution<float> number (-1.2F, 1.2F);
    for (int lane = 0; lane < FLOAT_LANES; ++lane) {
      const float angle = 0.7F * static_cast<float> (lane);
      set ({0.0F, 0.0F, 1.0F}, lane, normals);
      set ({std::cos (angle), std::sin (angle), 0.0F}, lane, t1);
      for (NearFitRow& row : rows) {
        const float x = number (random);
        const float y = number (random);
        const float u = x * std::cos (angle) - elongation * y * std::sin (angle);
        const float v = x * std::sin (angle) + elongation * y * std::cos (angle);
        set ({u, v, 0.1F * number (random)}, lane, row.edge);
        row.value[lane] = number (random);
        row.squared_error[lane] = 2.0F + number (random);
      }
    }
    for (int i = NODES / 2; i < NODES; ++i)
      rows[i].clear (FLOAT_LANES - 1);
  }

  ProfileRow
  fit (Simd simd) const
  {
    std::vector<FrameRow> room (NODES);
    ProfileRow profiles;
    profileKernels (simd).fit (
        rows.data(), NODES, normals, t1, elongation, room.data(), profiles);
    return profiles;
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

} // namespace

TEST (ProfileKernels, FitAsQrDoes)
{
  for (const float elongation : {1.0F, ELONGATION}) {
    const Surroundings nodes (elongation);
    const ProfileRow profiles = nodes.fit (bestSimd());
    const int terms = elongation == 1.0F ? 6 : 7;
    for (int lane = 0; lane < FLOAT_LANES; ++lane) {
      const Eigen::Vector3d along = Surroundings::at (nodes.t1, lane);
      const Eigen::Vector3d across =
          Surroundings::at (nodes.normals, lane).cross (along);
      std::vector<double> us;
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero (NODES, terms);
      Eigen::VectorXd values = Eigen::VectorXd::Zero (NODES);
      double weight = 0.0;
      double variance = 0.0;
      for (int i = 0; i < NODES; ++i) {
        const Eigen::Vector3d e = Surroundings::at (nodes.rows[i].edge, lane);
        const double u = e.dot (along);
        const double v = e.dot (across);
        const double g =
            1.0 - u * u - (e.squaredNorm() - u * u) / (elongation * elongation);
        if (g <= 0.0)
          continue;
        us.push_back (u);
        weight += g * g;
        variance += g * g * nodes.rows[i].squared_error[lane];
        const double monomials[] = {1.0, u, v, u * u, u * v, v * v, u * v * v};
        for (int j = 0; j < terms; ++j)
          matrix (i, j) = g * monomials[j];
        values[i] = g * nodes.rows[i].value[lane];
      }
      const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve (values);
      // Terms that samples leave open are damped a little.
      for (int j = 0; j < terms; ++j)
        EXPECT_NEAR (profiles.coefficients[j][lane],
                     solution[j],
                     1e-2 * solution.cwiseAbs().maxCoeff())
            << j;
      if (terms < ProfileRow::TERMS) {
        EXPECT_EQ (profiles.coefficients[terms][lane], 0.0F);
      }
      std::sort (us.begin(), us.end());
      EXPECT_EQ (profiles.count[lane], static_cast<float> (us.size()));
      EXPECT_NEAR (profiles.first_u[lane], us[1], 1e-6);
      EXPECT_NEAR (profiles.last_u[lane], us[us.size() - 2], 1e-6);
      EXPECT_NEAR (profiles.squared_error[lane], variance / weight, 1e-5);
    }
  }
}

TEST (ProfileKernels, AreTheSameForAllInstructions)
{
  for (const float elongation : {1.0F, ELONGATION}) {
    const Surroundings nodes (elongation);
    const ProfileRow portable = nodes.fit (Simd::PORTABLE);
    const ProfileRow best = nodes.fit (bestSimd());
    for (int lane = 0; lane < FLOAT_LANES; ++lane) {
      for (int j = 0; j < ProfileRow::TERMS; ++j)
        EXPECT_EQ (portable.coefficients[j][lane], best.coefficients[j][lane]);
      EXPECT_EQ (portable.first_u[lane], best.first_u[lane]);
      EXPECT_EQ (portable.last_u[lane], best.last_u[lane]);
      EXPECT_EQ (portable.squared_error[lane], best.squared_error[lane]);
      EXPECT_EQ (portable.count[lane], best.count[lane]);
    }
  }
}
