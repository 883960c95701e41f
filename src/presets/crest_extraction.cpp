// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_extraction.h>

#include "base/stopwatch.h"
#include "normals/given_normals.h"
#include "normals/normal_estimation.h"
#include "presets/analysis_contents.h"
#include "presets/line_selection.h"
#include "search/point_view.h"
#include "search/stray_points.h"
#include "surface/flat_places.h"
#include "surface/surface_nodes.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace pcl {
namespace crest {

namespace {

/** \brief The user's search, which is over the cloud, for packed points. */
NeighborSearch
packedSearch (const NeighborSearch& given,
              const PointView& cloud,
              const OrientedPoints& points,
              const Parameters& parameters)
{
  return [&given, &cloud, &points, &parameters] (index_t point,
                                                 std::vector<index_t>& found) {
    given (points.cloud_index[point], found);
    std::size_t kept = 0;
    for (const index_t i : found) {
      if (i < 0 || static_cast<std::size_t> (i) >= cloud.size)
        throw std::runtime_error (
            "The search method returned points outside the cloud: "
            "it does not search the cloud that it was given");
      if (points.packed_index[i] != OrientedPoints::INVALID)
        found[kept++] = points.packed_index[i];
    }
    found.resize (kept);
    if (!(parameters.radius > 0.0))
      keepNearest (points, point, parameters.k, found);
  };
}

/** \brief Where candidates come from: the search of the request, the one that it makes,
 * or the batched one.
 */
NeighborSource
neighborSource (const ExtractionRequest& request,
                const OrientedPoints& points,
                Stopwatch& watch,
                Progress& progress)
{
  const Parameters& parameters = request.parameters;
  const bool radius = parameters.radius > 0.0;
  if (request.search)
    return packedSearch (request.search, request.cloud, points, parameters);
  progress.beginStage ("search tree", PACKED);
  NeighborSource source;
  if (request.make_search && (radius || !parameters.batched_search))
    source.pointwise = searchOver (points, request.make_search, parameters);
  else {
    source.tree = treeOver (points.positions, parameters.threads);
    if (radius)
      source.pointwise = radiusSearch (points, source.tree, parameters.radius);
  }
  watch.stageDone ("search tree");
  return source;
}

bool
haveSameHints (const AnalysisContents& known, const ExtractionRequest& request)
{
  const NormalHints& a = known.hints;
  const NormalHints& b = request.hints;
  return a.viewpoint == b.viewpoint && a.viewpoint_assumed == b.viewpoint_assumed &&
         a.origin == b.origin && a.organized == b.organized && a.up == b.up;
}

void
checkRequest (const ExtractionRequest& request)
{
  const auto refuse = [] (const std::string& why) {
    throw std::invalid_argument (why);
  };
  checkPoints (request.cloud);
  checkHints (request.hints);
  const std::string invalid = explainInvalid (request.parameters);
  if (!invalid.empty())
    refuse ("Invalid parameter: " + invalid);
  if (!request.analysis)
    return;
  const AnalysisContents& known = contentsOf (*request.analysis);
  const std::string other = explainOtherShape (known.parameters, request.parameters);
  if (!other.empty())
    refuse ("The analysis that is set was made with " + other +
            ": set none, or what it was made with");
  const bool used_hints =
      known.normals || (known.normal_check && !known.normal_check->normals.empty());
  if (used_hints && !haveSameHints (known, request))
    refuse ("The analysis that is set has normals that were estimated for another "
            "viewpoint or direction up: set none when these change");
  if (known.normals_trusted != (request.sign_trust != nullptr))
    refuse (std::string ("The analysis that is set was made ") +
            (known.normals_trusted ? "with" : "without") +
            " trusts of signs: set none when that changes");
  if (known.cloud != fingerprint (request.cloud, request.parameters.threads))
    refuse (
        "The analysis that is set is that of another cloud: set none when the cloud "
        "has changed");
}

/** \brief Refuses what another cloud was found to be sampled like. */
void
checkNodes (const ExtractionRequest& request)
{
  if (request.nodes && request.nodes->cloud != fingerprint (positionsOf (request.cloud),
                                                            request.parameters.threads))
    throw std::invalid_argument (
        "How the cloud was sampled is set for another cloud, or one that has changed: "
        "set what estimateNormals found for this one, or none");
}

/** \brief Refuses what is too large or too small for floats of lengths and of
 * curvatures, those of a surface of as many samples as there can be.
 */
void
checkExtent (double extent)
{
  constexpr double LARGEST = std::numeric_limits<float>::max();
  constexpr double SMALLEST = 1e-33;
  if (extent == 0.0 || (extent >= SMALLEST && extent <= LARGEST))
    return;
  std::ostringstream message;
  message << "The cloud is " << extent << " wide, but must be from " << SMALLEST
          << " to " << LARGEST
          << " for floats to hold its lengths and curvatures: scale it";
  throw std::invalid_argument (message.str());
}

/** The part of all work, as near as anything tells beforehand, of each of the times
 * that samples are gathered. */
constexpr double RESOLVED = 0.05;

/** \brief The nodes that the samples are gathered to where the preset does so, and no
 * search is given, which is over the samples.
 */
std::shared_ptr<const SampleNodes>
gatherWhereAsked (const ExtractionRequest& request,
                  const Pipeline& pipeline,
                  Progress& progress,
                  std::vector<StageTime>& times)
{
  if (!pipeline.gathersSamples() || request.search)
    return std::make_shared<const SampleNodes>();
  if (request.nodes)
    return request.nodes;
  progress.beginStage ("sampling", RESOLVED);
  Stopwatch watch (times);
  auto nodes = std::make_shared<const SampleNodes> (
      resolveSamples (request.cloud, {request.parameters.threads, &progress}));
  watch.stageDone ("sampling");
  progress.beginRest();
  return nodes;
}

/** \brief Whether each sample has nearly as much noise by itself as samples are apart.
 * Windows of all sheets, which the findings are of, have hardly less of it than those
 * of one have.
 */
bool
areTooNoisy (const OrientedPoints& points,
             const SamplingFindings& findings,
             const Workers& workers)
{
  constexpr double TOO_NOISY = 0.6;
  constexpr double HARDLY_LESS = 0.7;
  constexpr int NEIGHBORS = 48;
  return findings.spacing > 0.0 &&
         findings.noise.front() > HARDLY_LESS * TOO_NOISY * findings.spacing &&
         typicalNoise (points,
                       batchedSearch (treeOver (points.positions, workers.threads),
                                      NEIGHBORS)) > TOO_NOISY;
}

/** \brief Gathers samples that have too much noise to nodes of the surface.
 * \param[in,out] points get the nodes
 * \param[in,out] findings get what was gathered
 */
void
gatherNoisy (const Workers& workers, OrientedPoints& points, SamplingFindings& findings)
{
  // Less costs detail.
  constexpr double NOISE_OF_NODES = 0.4;
  findings.gathered = points.size();
  points = nodesOfCloud (points, gatherOnSurface (points, NOISE_OF_NODES, workers));
  findings.nodes = points.size();
  findings.resolving_spacing =
      findings.spacing * std::sqrt (static_cast<double> (findings.gathered) /
                                    static_cast<double> (findings.nodes));
  findings.flaws[static_cast<std::size_t> (SamplingFlaw::WHITE_NOISE)] = 1;
}

/** \brief The normals of a cloud that has none. */
std::shared_ptr<const NormalEstimate>
estimateMissing (const ExtractionRequest& request,
                 const SampleNodes& nodes,
                 Progress& progress,
                 std::vector<StageTime>& times)
{
  // Of all work, as near as anything tells beforehand.
  constexpr double ESTIMATED = 0.1;
  progress.beginStage ("normals", ESTIMATED);
  Stopwatch watch (times);
  NormalRequest wanted;
  wanted.cloud = request.cloud;
  wanted.hints = request.hints;
  auto found = std::make_shared<const NormalEstimate> (
      estimateNormals (wanted, nodes, {request.parameters.threads, &progress}));
  watch.stageDone ("normals");
  progress.beginRest();
  return found;
}

/** \brief How the normals of the cloud are used: those that it has as far as they are
 * right, or estimated ones where it has none.
 * \param[in] nodes that estimated ones are those of
 * \param[in,out] cloud gets the normals to use
 * \param[out] result gets what they were found to be
 */
void
provideNormals (const ExtractionRequest& request,
                const SampleNodes& nodes,
                Progress& progress,
                PointView& cloud,
                Extraction& result)
{
  if (cloud.size == 0)
    return;
  const auto use = [&cloud] (const std::vector<Eigen::Vector3f>& normals) {
    cloud.normal = normals.front().data();
    cloud.normal_stride = 3;
  };
  if (cloud.normal != nullptr && hasNormals (cloud)) {
    if (request.sign_trust != nullptr)
      return;
    // Of all work, where there is something to repair.
    constexpr double CHECKED = 0.1;
    progress.beginStage ("normal check", CHECKED);
    Stopwatch watch (result.statistics.times);
    auto check = std::make_shared<const NormalCheck> (
        checkNormals (cloud, request.hints, {request.parameters.threads, &progress}));
    progress.beginRest();
    watch.stageDone ("normal check");
    if (!check->normals.empty())
      use (check->normals);
    result.normal_check = std::move (check);
    return;
  }
  result.normals = estimateMissing (request, nodes, progress, result.statistics.times);
  use (result.normals->normals);
}

/** \brief Of each point how sure the sign of its normal is; null where all are. */
const float*
signTrust (const ExtractionRequest& request, const Extraction& result)
{
  if (result.normals)
    return result.normals->trust.data();
  if (result.normal_check && !result.normal_check->trust.empty())
    return result.normal_check->trust.data();
  return request.sign_trust;
}

/** \brief Lines with indices into the cloud.
 * \param[in] sign_trust of its points, or null
 */
std::vector<CrestLine>
linesOfCloud (const OrientedPoints& points,
              const float* sign_trust,
              std::vector<CrestLine> lines)
{
  for (CrestLine& line : lines) {
    double trust = 0.0;
    double count = 0.0;
    for (std::vector<index_t>& polyline : line.polylines)
      for (index_t& point : polyline) {
        point = points.cloud_index[point];
        count += 1.0;
        if (sign_trust != nullptr)
          trust += sign_trust[point];
      }
    if (sign_trust != nullptr)
      line.sign_trust = trust / count;
  }
  return lines;
}

/** \brief Where packed lines run, by indices into the cloud. */
std::vector<LinePlace>
placesOfLines (const OrientedPoints& points, const SelectedLines& selected)
{
  std::vector<LinePlace> places;
  if (!selected.positions.empty())
    for (const CrestLine& line : selected.lines)
      for (const std::vector<index_t>& polyline : line.polylines)
        for (const index_t point : polyline)
          places.push_back ({points.cloud_index[point], selected.positions[point]});
  return places;
}

} // namespace

Extraction
extractCrests (const ExtractionRequest& given)
{
  checkRequest (given);
  const NearPoints near_points (given.cloud);
  ExtractionRequest request = given;
  request.cloud = near_points.view();
  checkNodes (request);
  const Parameters& parameters = request.parameters;
  const Pipeline& pipeline = *findPipeline (parameters.preset);
  Progress progress (request.progress);
  Extraction result;
  std::vector<StageTime>& times = result.statistics.times;

  std::shared_ptr<const OrientedPoints> points;
  std::shared_ptr<const SurfaceShape> shape;
  std::shared_ptr<const Crests> traced;
  // What is made for this extraction alone, which goes as soon as it is not needed.
  std::shared_ptr<OrientedPoints> own_points;
  std::shared_ptr<SurfaceShape> own_shape;
  if (request.analysis) {
    const AnalysisContents& known = contentsOf (*request.analysis);
    result.normals = known.normals;
    result.normal_check = known.normal_check;
    result.statistics.sampling = known.sampling;
    points = known.points;
    shape = known.shape;
    if (haveSameTrace (known.parameters, parameters))
      traced = known.traced;
  }
  else {
    PointView cloud = request.cloud;
    const std::shared_ptr<const SampleNodes> gathered =
        gatherWhereAsked (request, pipeline, progress, times);
    const SampleNodes& nodes = *gathered;
    result.statistics.sampling = nodes.findings;
    provideNormals (request, nodes, progress, cloud, result);
    Stopwatch watch (times);
    points = own_points = std::make_shared<OrientedPoints> (
        nodes.isEmpty() ? packOrientedPoints (cloud, parameters.threads)
                        : packNodes (cloud, nodes, parameters.threads));
    watch.stageDone ("packing");
    if (nodes.isEmpty() &&
        areTooNoisy (*own_points, nodes.findings, parameters.threads)) {
      progress.beginStage ("sampling", RESOLVED);
      gatherNoisy (
          {parameters.threads, &progress}, *own_points, result.statistics.sampling);
      watch.stageDone ("sampling");
      progress.beginRest();
    }
    checkExtent (points->extent);
    NeighborSource neighbors = neighborSource (request, *points, watch, progress);
    shape = own_shape =
        pipeline.analyzeSurface (*points, std::move (neighbors), parameters, &progress);
    times.insert (times.end(), shape->times.begin(), shape->times.end());
  }
  if (request.keep_analysis) {
    own_points.reset();
    own_shape.reset();
  }

  if (!traced) {
    Stopwatch watch (times);
    std::vector<CrestType> crest_points =
        pipeline.findCrestPoints (*points, *shape, parameters, &progress);
    if (own_shape)
      pipeline.releaseForLines (*own_points, *own_shape);
    watch.stageDone ("crest points");
    Parameters wanted = parameters;
    if (request.keep_analysis)
      wanted.wanted = {true, true};
    traced = std::make_shared<const Crests> (pipeline.traceCrests (
        *points, *shape, std::move (crest_points), wanted, &progress));
    for (const StageTime& time : traced->times)
      addTime (times, time);
  }
  SelectedLines selected = selectLines (*points, *shape, *traced, parameters);
  result.labels = labelPoints (*shape, traced->points, selected.lines, parameters);
  result.statistics.mean_spacing = shape->graph.mean_spacing;
  result.statistics.extent = points->extent;
  if (result.normal_check)
    result.statistics.normals = result.normal_check->findings;
  for (const CrestType type : CREST_TYPES)
    if (parameters.wanted[type])
      result.statistics.line_sizes[type] = traced->sizes[type];
  if (request.keep_analysis)
    result.analysis =
        makeAnalysis ({request.analysis ? contentsOf (*request.analysis).cloud
                                        : fingerprint (given.cloud, parameters.threads),
                       result.normals,
                       result.normal_check,
                       request.hints,
                       request.sign_trust != nullptr,
                       result.statistics.sampling,
                       points,
                       shape,
                       traced,
                       parameters});
  if (own_shape) {
    result.curvatures = std::make_shared<const std::vector<PrincipalCurvature>> (
        std::move (own_shape->curvature));
    own_shape.reset();
    shape.reset();
    traced.reset();
  }
  else
    result.curvatures = {shape, &shape->curvature};
  result.places = placesOfLines (*points, selected);
  result.lines =
      linesOfCloud (*points, signTrust (request, result), std::move (selected.lines));
  if (own_points)
    result.sample_of = std::make_shared<const std::vector<index_t>> (
        std::move (own_points->packed_index));
  else
    result.sample_of = {points, &points->packed_index};
  progress.finish();
  return result;
}

} // namespace crest
} // namespace pcl
