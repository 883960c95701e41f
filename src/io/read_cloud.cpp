// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/normal_estimation.h>

#include <pcl/common/point_tests.h>

#include "base/stopwatch.h"
#include "io/file_faces.h"
#include "io/placement.h"
#include "io/read_content.h"
#include "normals/face_normals.h"

#include <algorithm>
#include <new>

namespace pcl {
namespace crest {

namespace {

bool
hasUsableNormal (const pcl::PointNormal& point)
{
  return pcl::isNormalFinite (point) && !point.getNormalVector3fMap().isZero (0.0F);
}

std::size_t
countUsableNormals (const pcl::PointCloud<pcl::PointNormal>& points)
{
  return static_cast<std::size_t> (
      std::count_if (points.begin(), points.end(), hasUsableNormal));
}

std::string
describe (const NormalEstimate& estimate, std::size_t k, const NormalHints& hints)
{
  if (estimate.parts.empty())
    return "Normals could not be estimated: no three points span a plane.";
  std::string note =
      "Normals were estimated from " + std::to_string (k) + " neighbours";
  if (estimate.single_view) {
    const bool is_sure = estimate.parts.front().trust >= SURE_SIGN;
    return note + (!hints.viewpoint
                       ? " and turned toward the origin, which all points are seen "
                         "from, spaced as those of a sensor there."
                   : is_sure
                       ? " and turned toward the viewpoint, which all points are "
                         "seen from."
                       : " and turned toward the viewpoint 0 0 0, as a guess: it may "
                         "be no more than the default of the file.");
  }
  note += " and made consistent over each connected part.";
  const auto add = [&] (NormalSide side, bool is_sure, const char* where) {
    const auto parts = std::count_if (
        estimate.parts.begin(), estimate.parts.end(), [&] (const NormalPart& part) {
          return part.side == side && part.points >= LEAST_PART &&
                 (part.trust >= SURE_SIGN) == is_sure;
        });
    if (parts != 0)
      note += " " + std::to_string (parts) + (parts == 1 ? " part " : " parts ") +
              where + (is_sure ? "." : ", as a guess.");
  };
  for (const bool is_sure : {true, false}) {
    add (NormalSide::OUTWARD, is_sure, "closed: outward");
    add (NormalSide::VIEWPOINT, is_sure, "open: mostly toward the viewpoint");
    add (NormalSide::UP, is_sure, "open: upward (-up)");
  }
  return note;
}

void
setNormals (const std::vector<Eigen::Vector3f>& normals,
            pcl::PointCloud<pcl::PointNormal>& points)
{
  for (std::size_t i = 0; i < normals.size(); ++i)
    points[i].getNormalVector3fMap() = normals[i];
}

/** \brief Takes the normals from the best source that there is. */
NormalSource
provideNormals (PlacedContent& content,
                int k,
                unsigned threads,
                const NormalOptions& options,
                std::shared_ptr<const NormalEstimate>& estimate)
{
  const std::size_t size = content.points->size();
  if (content.has_normals) {
    const std::size_t usable = countUsableNormals (*content.points);
    if (usable != 0) {
      if (usable != size)
        content.notes.push_back (std::to_string (size - usable) + " of " +
                                 std::to_string (size) +
                                 " normals of the file are zero or not finite.");
      return NormalSource::FILE;
    }
    content.notes.push_back (
        "The normals of the file are all zero or not finite, and are not used.");
  }
  if (!content.faces.ends.empty()) {
    unifyFaces (content);
    setNormals (faceNormals (viewOf (*content.points), content.faces), *content.points);
    const std::size_t with_normal = countUsableNormals (*content.points);
    if (with_normal != 0) {
      if (with_normal != size)
        content.notes.push_back (
            std::to_string (size - with_normal) + " of " + std::to_string (size) +
            " points are in no face that has an area, and have no normal.");
      return NormalSource::FACES;
    }
    content.notes.push_back ("No face of the file has an area; they are not used.");
  }
  NormalRequest request;
  request.cloud = viewOf (*content.points);
  request.k = k;
  const Placement& placement = content.placement;
  if (const auto& place = options.viewpoint ? options.viewpoint : content.viewpoint)
    request.hints.viewpoint = placement.toCloud (*place);
  request.hints.viewpoint_assumed =
      !options.viewpoint && content.viewpoint && content.viewpoint->isZero (0.0);
  request.hints.origin = placement.toCloud (Eigen::Vector3d::Zero());
  request.hints.organized = content.points->height > 1;
  request.hints.up = options.up;
  request.gathers = true;
  request.threads = threads;
  estimate = std::make_shared<const NormalEstimate> (estimateNormals (request));
  setNormals (estimate->normals, *content.points);
  content.notes.push_back (
      describe (*estimate, std::min<std::size_t> (k, size), request.hints));
  const auto is_seen = [] (const NormalPart& part) {
    return part.side == NormalSide::VIEWPOINT;
  };
  if (options.viewpoint &&
      std::none_of (estimate->parts.begin(), estimate->parts.end(), is_seen))
    content.notes.emplace_back ("The viewpoint decides nothing: about as much of the "
                                "surface faces it as looks away.");
  const std::string doubt = explainDoubt (*estimate);
  if (!doubt.empty())
    content.notes.push_back (doubt + (estimate->canBeTold()
                                          ? ". A viewpoint tells it (-viewpoint), or a "
                                            "direction up (-up)."
                                          : "."));
  return NormalSource::ESTIMATED;
}

} // namespace

bool
readCloud (const std::string& file,
           int k,
           unsigned threads,
           InputCloud& cloud,
           std::string& error,
           const ReadOptions& options)
{
  try {
    const std::string invalid = explainInvalid (options);
    if (!invalid.empty())
      throw ReadError (invalid);
    const NormalOptions& normals = options.normals;
    if (k < 3)
      throw ReadError ("k is " + std::to_string (k) +
                       ", but normals need at least 3 neighbours");
    std::vector<StageTime> times;
    Stopwatch watch (times);
    PlacedContent content = placeContent (readContent (file, options));
    watch.stageDone ("reading");
    const SampledFaces sampled = replaceBySamples (content, options, threads);
    if (sampled.faces != 0)
      watch.stageDone ("sampling faces");
    if (normals.always_estimate) {
      content.has_normals = false;
      content.faces.ends.clear();
    }
    std::shared_ptr<const NormalEstimate> estimate;
    const NormalSource source =
        sampled.faces != 0 && !normals.always_estimate
            ? NormalSource::FACES
            : provideNormals (content, k, threads, normals, estimate);
    if (source != NormalSource::ESTIMATED && (normals.viewpoint || normals.up))
      content.notes.push_back (
          std::string (!normals.up         ? "The viewpoint counts"
                       : normals.viewpoint ? "The viewpoint and the direction up count"
                                           : "The direction up counts") +
          " only where the normals of the " + nameOf (source) +
          " are divided about their side: -estimate_normals takes none of these.");
    content.points->is_dense =
        std::all_of (content.points->begin(),
                     content.points->end(),
                     [] (const pcl::PointNormal& point) {
                       return pcl::isXYZFinite (point) && pcl::isNormalFinite (point);
                     });
    watch.stageDone ("normals");
    cloud = {content.points,
             std::move (content.placement),
             sampled,
             source,
             options,
             std::move (estimate),
             std::move (content.colors),
             std::move (content.fields),
             std::move (content.notes),
             std::move (times)};
    return true;
  }
  catch (const ReadError& problem) {
    error = file;
    if (problem.line() != 0)
      error += ":" + std::to_string (problem.line());
    error += std::string (": ") + problem.what();
  }
  catch (const std::bad_alloc&) {
    error = file + ": there is not enough memory to read it";
  }
  catch (const std::exception& problem) {
    error = file + ": it cannot be read: " + problem.what();
  }
  return false;
}

std::string
nameOf (NormalSource source)
{
  switch (source) {
  case NormalSource::FILE:
    return "file";
  case NormalSource::FACES:
    return "faces";
  case NormalSource::ESTIMATED:
    break;
  }
  return "estimated";
}

void
checkPointCount (std::size_t points)
{
  if (points > MOST_POINTS)
    throw ReadError (std::to_string (points) +
                     " points are too large a cloud for 32-bit indices, which tell " +
                     std::to_string (MOST_POINTS) + " points apart");
}

void
checkFaces (const FileContent& content)
{
  const std::size_t size = content.points.size();
  for (const index_t corner : content.faces.corners)
    if (corner < 0 || static_cast<std::size_t> (corner) >= size)
      throw ReadError ("a face has the corner " + std::to_string (corner) +
                       ", counted from 0, but there are only " + std::to_string (size) +
                       " points");
}

} // namespace crest
} // namespace pcl
