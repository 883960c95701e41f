// SPDX-License-Identifier: BSD-3-Clause
// The whole method over plain arrays, for those who have no clouds of PCL.
#pragma once

#include <pcl_crest/crest_line.h>
#include <pcl_crest/input.h>
#include <pcl_crest/normal_estimation.h>
#include <pcl_crest/parameters.h>
#include <pcl_crest/progress.h>
#include <pcl_crest/surface_analysis.h>

#include <memory>
#include <optional>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What to extract crest lines from, and how. */
struct ExtractionRequest {
  /** has to stay as it is until the extraction ends. Where it has no normals they are
   * estimated (see estimateNormals) */
  PointView cloud{nullptr, nullptr, 0, 0};
  /** of each point of the cloud how sure the sign of its normal is, 0 to 1 (see
   * CrestLine::sign_trust). With it normals are used as they are; null to have them
   * checked, and what contradicts its neighbours repaired (see NormalCheck) */
  const float* sign_trust = nullptr;
  /** how the cloud was sampled, as found when its normals were estimated
   * (NormalEstimate::nodes), which is then not measured again; null where it was not */
  std::shared_ptr<const SampleNodes> nodes;
  /** for normals that are estimated, or divided about their side */
  NormalHints hints;
  Parameters parameters;
  /** finds candidate neighbours in the cloud, k of them or those within the radius, in
   * the place of all other searches, and then samples are not gathered to nodes; empty
   * for none */
  NeighborSearch search;
  /** makes the searches that Parameters::batched_search is not for; where it is empty
   * the batched search takes their place */
  SearchMaker make_search;
  ProgressCallback progress;
  /** what an extraction from the same cloud found out: only what other thresholds
   * change is repeated; null to start anew. Searches are not compared */
  std::shared_ptr<const SurfaceAnalysis> analysis;
  /** whether to keep what is found out, some 120 bytes a point with the preset PAPER
   * and 200 with AUTO */
  bool keep_analysis = false;
};

/** \brief What an extraction found out beside labels and lines. */
struct ExtractionStatistics {
  /** mean over the samples, or the nodes that these were gathered to, of the mean
   * distance to their 6 nearest neighbours */
  double mean_spacing = 0.0;
  /** largest side of the bounding box of the valid points */
  double extent = 0.0;
  /** with the preset AUTO how the cloud was sampled */
  SamplingFindings sampling;
  /** none unless the cloud has normals that were checked */
  std::optional<NormalFindings> normals;
  /** the chart of section 4.7: how many lines of each size before S removed some */
  PerType<LineSizes> line_sizes;
  std::vector<StageTime> times;
};

/** \brief Where a line runs by a point. */
struct LinePlace {
  index_t point;
  Eigen::Vector3f position;
};

/** \brief The crests of a cloud. Labels and curvatures are those of its samples: the
 * finite points with a normal, one for all that are coincident or were gathered to one
 * node (see SamplingFindings).
 */
struct Extraction {
  /** for each point of the cloud its sample, or -1 if it is invalid */
  std::shared_ptr<const std::vector<index_t>> sample_of;
  std::vector<Label> labels;
  /** the same array as before where an analysis was taken over */
  std::shared_ptr<const std::vector<PrincipalCurvature>> curvatures;
  /** by indices into the cloud: ridges first, of each type the largest first */
  std::vector<CrestLine> lines;
  /** with Positions::CREST of the preset AUTO where the lines run by each of their
   * points; else empty, as they run through these */
  std::vector<LinePlace> places;
  ExtractionStatistics statistics;
  /** null unless normals were estimated */
  std::shared_ptr<const NormalEstimate> normals;
  /** null unless the cloud has normals that were checked */
  std::shared_ptr<const NormalCheck> normal_check;
  /** null unless it was to be kept */
  std::shared_ptr<const SurfaceAnalysis> analysis;

  /** \brief The label of a point of the cloud, or of -1, which is none. */
  Label
  labelOf (index_t point) const
  {
    const index_t sample = sampleAt (point);
    return sample < 0 ? LABEL_INVALID : labels[static_cast<std::size_t> (sample)];
  }

  /** \brief The curvature of a point of the cloud, or of -1; null where it has none. */
  const PrincipalCurvature*
  curvatureOf (index_t point) const
  {
    const index_t sample = sampleAt (point);
    if (sample < 0)
      return nullptr;
    const PrincipalCurvature& found = (*curvatures)[static_cast<std::size_t> (sample)];
    return found.valid ? &found : nullptr;
  }

private:
  index_t
  sampleAt (index_t point) const
  {
    return point < 0 ? -1 : (*sample_of)[static_cast<std::size_t> (point)];
  }
};

/** \brief Extracts crest lines: all of the paper's section 4, as the preset has it.
 *
 * The result depends neither on the order of the points, but for theirs in the output,
 * nor on the number of threads.
 *
 * \throw std::invalid_argument where a parameter, the cloud or the analysis is not
 * right, std::runtime_error where the search is not, or the radius holds more than
 * MOST_NEIGHBORS, both in words for the user; Cancelled where the callback says so; and
 * std::bad_alloc
 */
PCL_CREST_EXPORT Extraction
extractCrests (const ExtractionRequest& request);

} // namespace crest
} // namespace pcl
