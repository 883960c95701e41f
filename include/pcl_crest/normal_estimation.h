// SPDX-License-Identifier: BSD-3-Clause
// Normals for clouds that have none, over plain arrays.
#pragma once

#include <pcl_crest/input.h>
#include <pcl_crest/progress.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief To which side the normals of a connected part look, the surest first. */
enum class NormalSide {
  /** of a closed surface, the far side of what it encloses */
  OUTWARD,
  /** where a sensor was */
  VIEWPOINT,
  /** of an open surface that nothing else is known of */
  UP
};

/** \brief What is known of the side that normals look to. */
struct NormalHints {
  /** where the cloud was seen from, in its unit */
  std::optional<Eigen::Vector3f> viewpoint;
  /** whether that is only the origin of a cloud which may say nothing of a sensor: then
   * it decides nothing that up does, nor of samples that are spaced as on a map; what
   * is closed around it is a model, while from a viewpoint that somebody set it is a
   * room; and where samples are not spaced as an image of a sensor there, it is a guess
   */
  bool viewpoint_assumed = false;
  /** where a sensor may have been that nobody told of, in the unit of the cloud: the
   * origin that its coordinates had before an offset was taken off them */
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  /** whether the cloud has rows and columns: then all was seen from the viewpoint, and
   * nothing from behind, unless it is assumed and samples are the grid of a map */
  bool organized = false;
  /** the side of open parts that no viewpoint decides, of any length but zero; +z if
   * there is none, which is a guess (see NormalPart::trust) */
  std::optional<Eigen::Vector3f> up;
};

/** \brief What normals to estimate, and from what. */
struct NormalRequest {
  /** its normals are not used; has to stay as it is meanwhile */
  PointView cloud{nullptr, nullptr, 0, 0};
  /** how many neighbours, with the point itself, a plane is fitted to: 3 to 1000 */
  int k = 24;
  NormalHints hints;
  /** whether samples that tell nothing by themselves, as of clumps or depth steps (see
   * SamplingFlaw), are gathered to nodes, and have the normals of these */
  bool gathers = false;
  /** 0 for all processors */
  unsigned threads = 1;
  ProgressCallback progress;
};

/** From this trust on a sign is taken to be known. */
constexpr float SURE_SIGN = 0.5F;

/** \brief Points that neighbours connect, whose normals are on one side of them; of a
 * single view all.
 */
struct NormalPart {
  std::size_t points = 0;
  NormalSide side = NormalSide::UP;
  /** how sure that side is for the part as a whole, from 0 to 1; less than SURE_SIGN
   * where it is a guess */
  float trust = 0.0F;
};

/** Fewer points are no surface: of such parts nothing is sure. */
constexpr std::size_t LEAST_PART = 16;

/** \brief Normals of the points of a cloud, and how sure their signs are. */
struct NormalEstimate {
  /** of unit length, or zero where a point is not finite or no plane fits */
  std::vector<Eigen::Vector3f> normals;
  /** of each point the variation of the surface around it: the smallest eigenvalue of
   * its k neighbours' covariance over the sum of all (Pauly et al. 2002) */
  std::vector<float> variation;
  /** of each point how sure the sign of its normal is, 0 to 1: how far the votes of
   * neighbours agree on the way to the rest of its part, and what decides that part */
  std::vector<float> trust;
  /** of each point its part; -1 where it has no normal */
  std::vector<index_t> part;
  /** the largest first */
  std::vector<NormalPart> parts;
  /** whether all was seen from the viewpoint alone, which all normals face */
  bool single_view = false;
  /** what samples were gathered to; null unless that was asked for */
  std::shared_ptr<const SampleNodes> nodes;

  /** \brief How many normals there are whose sign is not known. */
  std::size_t
  countUnsure () const
  {
    std::size_t unsure = 0;
    for (std::size_t i = 0; i < trust.size(); ++i)
      if (part[i] >= 0 && trust[i] < SURE_SIGN)
        ++unsure;
    return unsure;
  }

  /** \brief Whether a viewpoint or a direction up would tell what is not known. */
  bool
  canBeTold () const
  {
    return countUnsure() != 0 && !(single_view && parts.front().trust >= SURE_SIGN);
  }
};

/** \brief What of the signs is not to be trusted, in words for the user; empty if all
 * is but for a thousandth that belongs to no part of its own.
 */
PCL_CREST_EXPORT std::string
explainDoubt (const NormalEstimate& estimate);

/** \brief What was found of normals that came with a cloud, in finite points, and what
 * became of it.
 */
struct NormalFindings {
  /** lengths that are off 1 by more than a hundredth: directions alone are used */
  std::size_t not_unit = 0;
  /** zero or not finite */
  std::size_t missing = 0;
  /** of these, that were estimated; the others are left out */
  std::size_t filled = 0;
  /** that contradicted their neighbours for sure, and were turned over */
  std::size_t turned = 0;
  /** that seem to look to the wrong side, but for a doubt: used as they are */
  std::size_t doubtful = 0;
  /** of parts whose normals were so divided that their side is a guess */
  std::size_t guessed = 0;
  /** that stood across the surface, as no normals do but numbers of another meaning,
   * and with which all were estimated; 0 where fewer than a third do */
  std::size_t across = 0;
  /** of a cloud whose normals look, on the whole, to its middle from all around: right
   * for a room, the wrong side of a body */
  std::size_t inward = 0;
};

/** \brief The normals that a cloud came with, checked. */
struct NormalCheck {
  NormalFindings findings;
  /** of each point the normal that is used; empty where all are used as they came */
  std::vector<Eigen::Vector3f> normals;
  /** of each point how sure its sign is, as in NormalEstimate; empty with normals */
  std::vector<float> trust;
};

/** \brief What was found, in words for the user; empty if nothing was. */
PCL_CREST_EXPORT std::string
explainFindings (const NormalFindings& findings);

/** \brief Estimates the normals of a cloud and turns them to one side of the surface.
 *
 * Planes are fitted to the k nearest neighbours (Hoppe et al. 1992), to more only where
 * noise asks for it. Which of two neighbours' normals has to be turned over is decided
 * by votes (Xie et al. 2003) of whole borders between patches, not of single edges, and
 * of closed surfaces by rays that count sheets (Mullen et al. 2010).
 *
 * Where there is no viewpoint, but samples are spaced as the pixels of a sensor at the
 * origin are, and all seen from there, it is taken for one.
 *
 * Where all was seen from the viewpoint alone, because the cloud is an image or because
 * no points hide others, all normals face it, unless it is assumed and the cloud one
 * closed surface around it. Otherwise each connected part looks outward if it is
 * closed; else toward the viewpoint, if there is one and most of the part faces it or
 * most faces away; else up.
 *
 * The result depends neither on the order of the points, but for theirs in the output,
 * nor on the number of threads.
 *
 * \throw std::invalid_argument where the request is not right, in words for the user;
 * Cancelled where the callback says so; and std::bad_alloc
 */
PCL_CREST_EXPORT NormalEstimate
estimateNormals (const NormalRequest& request);

} // namespace crest
} // namespace pcl
