// SPDX-License-Identifier: BSD-3-Clause
// The method over plain arrays. No PCL is here: neither a header nor a library.
#include <pcl_crest/crest_extraction.h>
#include <pcl_crest/version.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#ifdef PCL_VERSION
#error "the core must not know PCL"
#endif

using namespace pcl::crest;

namespace {

/** \brief A straight ridge along y over a plane, z = .3 exp (-x^2 / .08), sampled at
 * random places of a grid's cells; six floats a point.
 */
class Ridge {
public:
  Ridge()
  {
    std::mt19937 random (1);
    std::uniform_real_distribution<float> jitter (-0.3F, 0.3F);
    for (int i = -50; i <= 50; ++i)
      for (int j = -50; j <= 50; ++j) {
        const float x = (static_cast<float> (i) + jitter (random)) * SPACING;
        const float y = (static_cast<float> (j) + jitter (random)) * SPACING;
        const float z = 0.3F * std::exp (-x * x / 0.08F);
        const Eigen::Vector3f normal =
            Eigen::Vector3f (z * x / 0.04F, 0.0F, 1.0F).normalized();
        floats.insert (floats.end(), {x, y, z, normal.x(), normal.y(), normal.z()});
      }
  }

  PointView
  view () const
  {
    return {floats.data(), floats.data() + 3, 6, floats.size() / 6};
  }

  static constexpr float SPACING = 0.02F;
  std::vector<float> floats;
};

ExtractionRequest
requestFor (const PointView& cloud, Preset preset = Preset::AUTO)
{
  ExtractionRequest request;
  request.cloud = cloud;
  request.parameters.preset = preset;
  return request;
}

/** \brief What is said where the request is refused. */
template <typename Error>
std::string
refusal (const ExtractionRequest& request)
{
  try {
    extractCrests (request);
  }
  catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

/** \brief By looking at all points. */
NeighborSearch
bruteForce (const PointView& cloud, double radius)
{
  return [cloud, radius] (index_t point, std::vector<index_t>& found) {
    found.clear();
    const Eigen::Vector3f p = cloud.positionOf (static_cast<std::size_t> (point));
    for (std::size_t i = 0; i < cloud.size; ++i)
      if ((cloud.positionOf (i) - p).norm() < static_cast<float> (radius))
        found.push_back (static_cast<index_t> (i));
  };
}

} // namespace

TEST (CrestExtraction, FindsTheRidge)
{
  const Ridge ridge;
  const Extraction found = extractCrests (requestFor (ridge.view()));
  ASSERT_FALSE (found.lines.empty());
  const CrestLine& line = found.lines.front();
  EXPECT_EQ (line.type, CrestType::RIDGE);
  EXPECT_GT (line.length, 1.8);
  ASSERT_FALSE (found.places.empty());
  std::size_t on_ridge = 0;
  for (const LinePlace& place : found.places) {
    if (found.labelOf (place.point) != LABEL_RIDGE)
      continue;
    ++on_ridge;
    EXPECT_NEAR (place.position.x(), 0.0, 0.5 * Ridge::SPACING);
    // z'' of the ridge's top, a principal curvature there.
    const PrincipalCurvature* const curvature = found.curvatureOf (place.point);
    ASSERT_NE (curvature, nullptr);
    EXPECT_NEAR (curvature->k1, 0.3 * 2.0 / 0.08, 0.1 * 0.3 * 2.0 / 0.08);
    EXPECT_GT (std::abs (curvature->t1.x()), 0.95);
  }
  EXPECT_GT (on_ridge, 80U);
  EXPECT_NEAR (found.statistics.extent, 2.0, 0.02);
  EXPECT_EQ (found.analysis, nullptr);
}

TEST (CrestExtraction, OfPaperRunsThroughTheSamples)
{
  const Ridge ridge;
  const Extraction found = extractCrests (requestFor (ridge.view(), Preset::PAPER));
  ASSERT_FALSE (found.lines.empty());
  EXPECT_EQ (found.lines.front().type, CrestType::RIDGE);
  EXPECT_TRUE (found.places.empty());
  // Crest points are beside the ridge, and growth adds what is beside these.
  for (const index_t point : found.lines.front().polylines.front())
    EXPECT_NEAR (ridge.view().positionOf (static_cast<std::size_t> (point)).x(),
                 0.0,
                 3.0 * Ridge::SPACING);
}

TEST (CrestExtraction, SearchesWithinARadiusAsBruteForceDoes)
{
  const Ridge ridge;
  for (const Preset preset : {Preset::AUTO, Preset::PAPER}) {
    ExtractionRequest request = requestFor (ridge.view(), preset);
    request.parameters.radius = 2.6 * Ridge::SPACING;
    const Extraction own = extractCrests (request);
    request.search = bruteForce (request.cloud, request.parameters.radius);
    const Extraction given = extractCrests (request);
    EXPECT_EQ (own.labels, given.labels);
    EXPECT_GT (std::count (own.labels.begin(), own.labels.end(), LABEL_RIDGE), 50);
  }
}

TEST (CrestExtraction, AsksForASearchWhereTheBatchedOneIsNotWanted)
{
  const Ridge ridge;
  ExtractionRequest request = requestFor (ridge.view(), Preset::PAPER);
  const Extraction batched = extractCrests (request);
  int k = 0;
  request.make_search = [&k] (const std::vector<Eigen::Vector3f>& points,
                              int wanted,
                              double radius) -> NeighborSearch {
    EXPECT_EQ (radius, 0.0);
    k = wanted;
    return [points] (index_t point, std::vector<index_t>& found) {
      // All are more than k: the nearest of them count.
      found.clear();
      for (std::size_t i = 0; i < points.size(); ++i)
        if ((points[i] - points[static_cast<std::size_t> (point)]).norm() < 0.1F)
          found.push_back (static_cast<index_t> (i));
    };
  };
  request.parameters.batched_search = true;
  EXPECT_EQ (extractCrests (request).labels, batched.labels);
  EXPECT_EQ (k, 0);
  request.parameters.batched_search = false;
  extractCrests (request);
  EXPECT_EQ (k, request.parameters.k);
}

TEST (CrestExtraction, SaysWhatIsWrong)
{
  const Ridge ridge;
  ExtractionRequest request = requestFor (ridge.view());
  request.parameters.k = 3;
  EXPECT_EQ (refusal<std::invalid_argument> (request),
             "Invalid parameter: k is 3, but must be from 4 (the point and three "
             "neighbours) to 1000");
  request.parameters = Parameters();
  request.parameters.preset = static_cast<Preset> (7);
  EXPECT_EQ (refusal<std::invalid_argument> (request),
             "Invalid parameter: the preset is 7, but must be one of the values of "
             "Preset");
  request.parameters = Parameters();
  request.parameters.radius = 1.0;
  EXPECT_NE (
      refusal<std::runtime_error> (request).find ("The search radius of 1 holds"),
      std::string::npos);
  request.parameters = Parameters();
  request.cloud.stride = 2;
  EXPECT_EQ (refusal<std::invalid_argument> (request),
             "The stride of the cloud is 2, but must be at least 3 floats");
  request.cloud = ridge.view();
  request.cloud.position = nullptr;
  EXPECT_EQ (refusal<std::invalid_argument> (request),
             "The cloud has no positions: point to three floats of each");
  request.cloud = ridge.view();
  request.make_search = [] (const std::vector<Eigen::Vector3f>&, int, double) {
    return NeighborSearch();
  };
  EXPECT_EQ (refusal<std::invalid_argument> (request),
             "The search maker of the request made no search");
  request.search = [] (index_t, std::vector<index_t>& found) { found = {0, 1 << 30}; };
  EXPECT_EQ (refusal<std::runtime_error> (request),
             "The search method returned points outside the cloud: it does not search "
             "the cloud that it was given");
}

TEST (CrestExtraction, OfNoPointsIsEmpty)
{
  for (const Preset preset : {Preset::AUTO, Preset::PAPER}) {
    const Extraction found =
        extractCrests (requestFor ({nullptr, nullptr, 6, 0}, preset));
    EXPECT_TRUE (found.labels.empty());
    EXPECT_TRUE (found.lines.empty());
  }
}

TEST (CrestExtraction, InvalidPointsAreNoSamples)
{
  Ridge ridge;
  ridge.floats[0] = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 3; ++i)
    ridge.floats[6 + 3 + i] = 0.0F;
  ExtractionRequest request = requestFor (ridge.view());
  const std::vector<float> sure (ridge.view().size, 1.0F);
  request.sign_trust = sure.data();
  const Extraction found = extractCrests (request);
  EXPECT_EQ (found.normal_check, nullptr);
  EXPECT_EQ (found.labels.size(), ridge.view().size - 2);
  for (const index_t point : {0, 1, -1}) {
    EXPECT_EQ (found.labelOf (point), LABEL_INVALID);
    EXPECT_EQ (found.curvatureOf (point), nullptr);
  }
  EXPECT_NE (found.curvatureOf (2), nullptr);

  // Unless normals are trusted the one that is missing is estimated.
  request.sign_trust = nullptr;
  const Extraction repaired = extractCrests (request);
  ASSERT_TRUE (repaired.statistics.normals);
  EXPECT_EQ (repaired.statistics.normals->filled, 1U);
  EXPECT_EQ (repaired.labelOf (0), LABEL_INVALID);
  EXPECT_NE (repaired.curvatureOf (1), nullptr);
}

TEST (CrestExtraction, FlippedNormalsAreTurnedBack)
{
  const Ridge right;
  const Extraction expected = extractCrests (requestFor (right.view()));
  EXPECT_FALSE (expected.lines.empty());
  Ridge ridge;
  for (std::size_t i = 0; i < ridge.view().size; i += 7)
    for (int j = 3; j < 6; ++j)
      ridge.floats[6 * i + j] *= -1.0F;
  ExtractionRequest request = requestFor (ridge.view());
  request.keep_analysis = true;
  const Extraction found = extractCrests (request);
  EXPECT_EQ (found.statistics.normals->turned, (ridge.view().size + 6) / 7);
  EXPECT_EQ (found.labels, expected.labels);
  for (const CrestLine& line : found.lines)
    EXPECT_GE (line.sign_trust, SURE_SIGN);
  // An analysis knows what was found; only its normals depend on hints.
  request.analysis = found.analysis;
  EXPECT_EQ (extractCrests (request).normal_check, found.normal_check);
  const std::vector<float> sure (ridge.view().size, 1.0F);
  request.sign_trust = sure.data();
  EXPECT_NE (refusal<std::invalid_argument> (request).find ("without trusts of signs"),
             std::string::npos);
  request.sign_trust = nullptr;
  request.hints.up = Eigen::Vector3f::UnitX();
  EXPECT_NE (refusal<std::invalid_argument> (request).find ("direction up"),
             std::string::npos);
}

TEST (CrestExtraction, StopsWhereTheCallbackSaysSo)
{
  const Ridge ridge;
  ExtractionRequest request = requestFor (ridge.view());
  for (const char* last : {"normal check", "curvature"}) {
    request.progress = [last] (const std::string& stage, double) {
      return stage != last;
    };
    EXPECT_THROW (extractCrests (request), Cancelled) << last;
  }
}

TEST (CrestExtraction, AnAnalysisSparesTheStagesThatAreTheSame)
{
  const Ridge ridge;
  ExtractionRequest request = requestFor (ridge.view());
  request.keep_analysis = true;
  const Extraction first = extractCrests (request);
  ASSERT_NE (first.analysis, nullptr);
  request.analysis = first.analysis;
  request.parameters.angle = 60.0;
  const Extraction again = extractCrests (request);
  EXPECT_EQ (again.curvatures, first.curvatures);
  request.analysis = nullptr;
  EXPECT_EQ (extractCrests (request).labels, again.labels);

  request.analysis = first.analysis;
  request.parameters.preset = Preset::PAPER;
  request.parameters.angle = Parameters().angle;
  EXPECT_EQ (
      refusal<std::invalid_argument> (request),
      "The analysis that is set was made with the preset auto, not paper: set none, "
      "or what it was made with");
  const Ridge other = [] {
    Ridge changed;
    changed.floats[2] += 1e-3F;
    return changed;
  }();
  request.cloud = other.view();
  request.parameters = Parameters();
  EXPECT_EQ (
      refusal<std::invalid_argument> (request),
      "The analysis that is set is that of another cloud: set none when the cloud "
      "has changed");
}

TEST (CrestExtraction, TakesOverHowTheCloudWasSampled)
{
  // Frames of the same places, whose samples are gathered to nodes.
  Ridge ridge;
  std::mt19937 random (2);
  std::normal_distribution<float> noise (0.0F, 0.02F * Ridge::SPACING);
  const std::vector<float> once = ridge.floats;
  for (int frame = 0; frame < 4; ++frame)
    for (std::size_t i = 0; i < once.size(); ++i)
      ridge.floats.push_back (once[i] + (i % 6 < 3 ? noise (random) : 0.0F));
  // What is astray is set apart by both.
  ridge.floats.insert (ridge.floats.end(), {1e7F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F});
  NormalRequest wanted;
  wanted.cloud = ridge.view();
  EXPECT_EQ (estimateNormals (wanted).nodes, nullptr);
  wanted.gathers = true;
  const NormalEstimate estimate = estimateNormals (wanted);
  ASSERT_NE (estimate.nodes, nullptr);

  ExtractionRequest request = requestFor (ridge.view());
  const auto is_sampling = [] (const StageTime& time) {
    return time.stage == "sampling";
  };
  const Extraction measured = extractCrests (request);
  const std::vector<StageTime>& times = measured.statistics.times;
  EXPECT_TRUE (std::any_of (times.begin(), times.end(), is_sampling));
  request.nodes = estimate.nodes;
  const Extraction taken = extractCrests (request);
  const std::vector<StageTime>& fewer = taken.statistics.times;
  EXPECT_FALSE (std::any_of (fewer.begin(), fewer.end(), is_sampling));
  EXPECT_GT (taken.statistics.sampling.nodes, 0U);
  EXPECT_EQ (taken.statistics.sampling.nodes, measured.statistics.sampling.nodes);
  EXPECT_EQ (taken.labels, measured.labels);

  const Ridge other;
  request.cloud = other.view();
  EXPECT_EQ (refusal<std::invalid_argument> (request),
             "How the cloud was sampled is set for another cloud, or one that has "
             "changed: set what estimateNormals found for this one, or none");
}

TEST (SurfaceAnalysis, KnowsTheSamples)
{
  const Ridge ridge;
  ExtractionRequest request = requestFor (ridge.view());
  request.keep_analysis = true;
  const Extraction found = extractCrests (request);
  const SurfaceAnalysis& analysis = *found.analysis;
  ASSERT_EQ (static_cast<std::size_t> (analysis.size()), ridge.view().size);
  index_t boundary = 0;
  for (index_t i = 0; i < analysis.size(); ++i) {
    const Sample sample = analysis.sample (i);
    EXPECT_EQ (analysis.sampleOf (sample.point), i);
    const auto point = static_cast<std::size_t> (sample.point);
    EXPECT_EQ (sample.position, ridge.view().positionOf (point));
    EXPECT_LT ((sample.normal - ridge.view().normalOf (point)).norm(), 1e-6F);
    EXPECT_GT (sample.spacing, 0.3F * Ridge::SPACING);
    EXPECT_LT (sample.spacing, 4.0F * Ridge::SPACING);
    boundary += sample.boundary ? 1 : 0;
    // The border of the samples, give or take a row.
    EXPECT_TRUE (!sample.boundary ||
                 sample.position.head<2>().cwiseAbs().maxCoeff() > 0.9F);
  }
  EXPECT_GT (boundary, 4 * 60);
}

TEST (Version, NamesThePortableKernelsLast)
{
  EXPECT_EQ (version(), PCL_CREST_VERSION);
  ASSERT_FALSE (kernelNames().empty());
  EXPECT_EQ (kernelNames().back(), "portable");
}
