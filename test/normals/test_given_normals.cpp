// SPDX-License-Identifier: BSD-3-Clause
// Normals that come with a cloud, spoiled in ways that are known.
#include <gtest/gtest.h>

#include "normals/given_normals.h"
#include "support/noisy_cloud.h"
#include "support/solid_clouds.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <random>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

Cloud
solid (const std::string& name, double noise = 0.0)
{
  static std::map<std::string, oracle::SolidCloud> sampled;
  for (const oracle::NamedSolid& known : oracle::namedSolids())
    if (known.name == name && sampled.count (name) == 0)
      sampled.emplace (name, known.sample (1));
  const oracle::SolidCloud& exact = sampled.at (name);
  return *oracle::addNoise (*exact.cloud, noise * exact.spacing);
}

NormalCheck
check (const Cloud& cloud, const NormalHints& hints = {}, unsigned threads = 2)
{
  return checkNormals ({&cloud[0].x,
                        &cloud[0].normal_x,
                        sizeof (pcl::PointNormal) / sizeof (float),
                        cloud.size()},
                       hints,
                       threads);
}

using IsFlipped = std::function<bool (const pcl::PointNormal&)>;

Cloud
flipped (Cloud cloud, const IsFlipped& is_flipped)
{
  for (pcl::PointNormal& point : cloud)
    if (is_flipped (point))
      point.getNormalVector3fMap() *= -1.0F;
  return cloud;
}

/** \brief How many normals after a check are further than 60 degrees off. */
std::size_t
countOff (const NormalCheck& found, const Cloud& right)
{
  std::size_t off = 0;
  for (std::size_t i = 0; i < right.size(); ++i)
    off += found.normals[i].dot (right[i].getNormalVector3fMap()) < 0.5F ? 1 : 0;
  return off;
}

/** \brief Of a cloud whose normals are turned over where it says so how many are not
 * as they were after the check, as a part of all.
 */
double
wrongAfter (const Cloud& right,
            const IsFlipped& is_flipped,
            const NormalHints& hints = {})
{
  const Cloud cloud = flipped (right, is_flipped);
  const NormalCheck found = check (cloud, hints);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f normal = found.normals.empty()
                                       ? cloud[i].getNormalVector3fMap().eval()
                                       : found.normals[i];
    wrong += normal.dot (right[i].getNormalVector3fMap()) < 0.0F ? 1 : 0;
  }
  return static_cast<double> (wrong) / static_cast<double> (cloud.size());
}

IsFlipped
oneIn (double probability)
{
  return [random = std::mt19937 (1), coin = std::bernoulli_distribution (probability)] (
             const pcl::PointNormal&) mutable { return coin (random); };
}

TEST (GivenNormals, RightOnesStayAsTheyAre)
{
  for (const char* name : {"dodecahedron",
                           "cube with holes",
                           "star",
                           "plate of 1 h",
                           "plate of 3 h",
                           "channel of 4 h",
                           "hollow sphere",
                           "city"}) {
    EXPECT_LE (wrongAfter (solid (name), oneIn (0.0)), 1e-4) << name;
    // Noise that hides which sheet is which.
    EXPECT_LE (wrongAfter (solid (name, 1.0), oneIn (0.0)), 0.01) << name;
  }
  const NormalCheck none = check (solid ("torus"));
  EXPECT_TRUE (none.normals.empty());
  EXPECT_EQ (explainFindings (none.findings), "");
}

TEST (GivenNormals, FlippedOnesAreTurnedBack)
{
  for (const char* name :
       {"dodecahedron", "cube with holes", "plate of 1 h", "plate of 3 h", "terrain"}) {
    const Cloud cloud = solid (name);
    for (const double part : {0.01, 0.3})
      EXPECT_LE (wrongAfter (cloud, oneIn (part)), 1e-3) << name << " " << part;
    // The fifth that is farthest along x + y.
    std::vector<float> along;
    for (const pcl::PointNormal& point : cloud)
      along.push_back (point.x + point.y);
    std::sort (along.begin(), along.end());
    const float limit = along[along.size() - along.size() / 5];
    EXPECT_LE (wrongAfter (cloud,
                           [limit] (const pcl::PointNormal& point) {
                             return point.x + point.y >= limit;
                           }),
               1e-3)
        << name;
  }
  // Noise of the thickness of a plate hides which sheet a flipped one is of; no more is
  // lost then.
  EXPECT_LE (wrongAfter (solid ("plate of 1 h", 0.2), oneIn (0.1)), 0.102);
  for (const char* name :
       {"dodecahedron", "cube with holes", "plate of 3 h", "terrain"})
    EXPECT_LE (wrongAfter (solid (name, 0.2), oneIn (0.1)), 2e-3) << name;
}

TEST (GivenNormals, HalvesThatWereMirroredAreTurnedBack)
{
  // The middle of the box is where no curve through its cells makes a short step.
  for (const char* name : {"dodecahedron", "gear", "torus"}) {
    Cloud cloud = solid (name);
    Eigen::AlignedBox3f box;
    for (const pcl::PointNormal& point : cloud)
      box.extend (point.getVector3fMap());
    const Eigen::Vector3f middle = box.center();
    for (const int axis : {0, 1, 2})
      for (const float part : {0.0F, 0.25F}) {
        const float cut = middle[axis] + part * box.sizes()[axis];
        const double wrong =
            wrongAfter (cloud, [axis, cut] (const pcl::PointNormal& point) {
              return point.getVector3fMap()[axis] > cut;
            });
        EXPECT_LE (wrong, 1e-3) << name << " " << axis << " " << part;
      }
  }
}

TEST (GivenNormals, NumbersThatAreNoneAreReplaced)
{
  const Cloud right = solid ("cube with holes");
  // One for all, and colors.
  std::mt19937 random (3);
  std::uniform_real_distribution<float> color (0.0F, 1.0F);
  Cloud constant = right;
  Cloud colored = right;
  for (std::size_t i = 0; i < right.size(); ++i) {
    constant[i].getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
    for (float& c : colored[i].getNormalVector3fMap())
      c = color (random);
  }
  for (const Cloud& cloud : {constant, colored}) {
    const NormalCheck found = check (cloud);
    EXPECT_EQ (found.findings.across, cloud.size());
    EXPECT_NE (explainFindings (found.findings).find ("stand across"),
               std::string::npos);
    EXPECT_LT (countOff (found, right), cloud.size() / 100);
  }
}

TEST (GivenNormals, ABodyTurnedInsideOutIsSaidToBe)
{
  for (const char* name : {"dodecahedron", "torus", "cube with holes"}) {
    const Cloud cloud = solid (name);
    EXPECT_EQ (check (cloud).findings.inward, 0U) << name;
    const Cloud turned = flipped (cloud, [] (const pcl::PointNormal&) { return true; });
    EXPECT_EQ (check (turned).findings.inward, cloud.size()) << name;
  }
  EXPECT_EQ (check (solid ("terrain")).findings.inward, 0U);
}

TEST (GivenNormals, AFewDecideNoSide)
{
  // All are missing but one, which looks into the body.
  const Cloud right = solid ("dodecahedron");
  Cloud cloud = right;
  for (std::size_t i = 1; i < cloud.size(); ++i)
    cloud[i].getNormalVector3fMap().setZero();
  cloud[0].getNormalVector3fMap() *= -1.0F;
  const NormalCheck found = check (cloud);
  EXPECT_LT (countOff (found, right), cloud.size() / 50);
}

TEST (GivenNormals, WhatIsDoubtfulIsNotSure)
{
  const NormalCheck found = check (flipped (solid ("plate of 1 h", 1.0), oneIn (0.1)));
  ASSERT_GT (found.findings.doubtful, 0U);
  EXPECT_GE (std::count_if (found.trust.begin(),
                            found.trust.end(),
                            [] (float trust) { return trust < SURE_SIGN; }),
             static_cast<std::ptrdiff_t> (found.findings.doubtful));
}

TEST (GivenNormals, ScansOfOppositeOrientationAgreeAfterwards)
{
  // They overlap.
  std::mt19937 random (2);
  std::bernoulli_distribution coin (0.5);
  const auto of_second = [&] (const pcl::PointNormal& point) {
    return point.x > 0.1F || (point.x > -0.1F && coin (random));
  };
  for (const char* name : {"dodecahedron", "torus"})
    EXPECT_LE (wrongAfter (solid (name), of_second), 1e-3) << name;
  NormalHints hints;
  const Cloud terrain = solid ("terrain");
  EXPECT_LE (wrongAfter (terrain, of_second, hints), 1e-3);
  hints.up = -Eigen::Vector3f::UnitZ();
  EXPECT_GE (wrongAfter (terrain, of_second, hints), 0.999);
}

TEST (GivenNormals, WhatIsFoundIsCounted)
{
  Cloud cloud = solid ("torus");
  constexpr float NAN_VALUE = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Vector3f exact = cloud[2].getNormalVector3fMap();
  cloud[0].getNormalVector3fMap() *= 3.0F;
  cloud[1].getNormalVector3fMap() *= -1.0F;
  cloud[2].getNormalVector3fMap().setZero();
  cloud[3].getNormalVector3fMap().setConstant (NAN_VALUE);
  cloud[4].getNormalVector3fMap().setZero();
  cloud[4].x = NAN_VALUE;
  // Too far from the others to have a plane of theirs.
  pcl::PointNormal stray (100.0F, 0.0F, 0.0F);
  stray.getNormalVector3fMap().setZero();
  cloud.push_back (stray);
  const NormalCheck found = check (cloud);
  EXPECT_EQ (found.findings.not_unit, 1U);
  EXPECT_EQ (found.findings.missing, 3U);
  EXPECT_EQ (found.findings.filled, 2U);
  EXPECT_EQ (found.findings.turned, 1U);
  EXPECT_EQ (found.findings.doubtful, 0U);
  ASSERT_EQ (found.normals.size(), cloud.size());
  EXPECT_GT (found.normals[2].dot (exact), 0.99F);
  EXPECT_EQ (explainFindings (found.findings),
             "Normals: 1 not of unit length, used as directions; 2 zero or not finite, "
             "estimated in their place; 1 zero or not finite, without a sure one in "
             "their place: left out; 1 against those around them, turned over");
}

TEST (GivenNormals, ThreadsDoNotMatter)
{
  const Cloud cloud = flipped (solid ("cube with holes", 0.5), oneIn (0.2));
  const NormalCheck one = check (cloud, {}, 1);
  const NormalCheck two = check (cloud, {}, 2);
  EXPECT_EQ (one.normals, two.normals);
  EXPECT_EQ (one.trust, two.trust);
}

} // namespace
