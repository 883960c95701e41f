// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/scale_fit.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "curvature/near_nodes.h"
#include "curvature/scale_kernels.h"
#include "search/kernels.h"
#include "surface/node_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** Fewer nodes than this leave too little to tell noise from shape by: four more than a
 * cubic has terms. */
constexpr std::size_t LEAST_NODES = 14;

/** Just beyond right angles, whose other face is part of the crest. */
constexpr float NO_OTHER_SHEET = -0.02F;

/** A little more than the distance of the farthest node, which, too, has a weight then.
 */
constexpr double LARGER_RADIUS = 1.02;

struct LoadNode {
  const PyramidLevel& level;

  SeenNode
  operator() (index_t q) const
  {
    return {level.positions[q], level.weights[q], level.normals[q], false};
  }
};

/** \brief Fits some nodes at a time. */
class CubicFitter : public LaneBatch<CubicFitter, FLOAT_LANES> {
public:
  CubicFitter (const PyramidLevel& level,
               const std::vector<SeenNode>& nodes,
               int nearest)
  : level_ (level)
  , nodes_ (nodes)
  , nearest_ (nearest)
  , walk_ (level.graph, {level})
  , rows_ (static_cast<std::size_t> (nearest))
  , room_ (rows_.size())
  {}

  /** \brief Fits a node together with others, at the latest when finish is called. */
  void
  fit (std::int32_t place, index_t node, const NearNodes& near, ScaleFit& result)
  {
    const float radius = takeNear (place, near) ? near_radius_ : walkedRadius (node);
    if (!(radius > 0.0F))
      return;
    const Eigen::Vector3f& p = level_.positions[node];
    const float per_radius = 1.0F / radius;
    std::size_t i = 0;
    for (; i < neighbors_.size(); ++i)
      set (i, (neighbors_[i].position - p) * per_radius, neighbors_[i].weight);
    for (; i < rows_.size(); ++i)
      set (i, Eigen::Vector3f::Zero(), 0.0F);
    const Eigen::Vector3f normal = level_.normals[node].normalized();
    normals_.x[queued_] = normal.x();
    normals_.y[queued_] = normal.y();
    normals_.z[queued_] = normal.z();
    radii_[queued_] = radius;
    results_[queued_] = &result;
    push();
  }

private:
  friend LaneBatch<CubicFitter, FLOAT_LANES>;

  struct Neighbor {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    float weight = 0.0F;
  };

  void
  set (std::size_t i, const Eigen::Vector3f& edge, float weight)
  {
    NodeRow& row = rows_[i];
    row.edge.x[queued_] = edge.x();
    row.edge.y[queued_] = edge.y();
    row.edge.z[queued_] = edge.z();
    row.weight[queued_] = weight;
  }

  void
  run ()
  {
    ScaleFitRow fits;
    kernels_.fit (
        rows_.data(), static_cast<int> (rows_.size()), normals_, room_.data(), fits);
    for (int lane = 0; lane < queued_; ++lane) {
      if (fits.valid[lane] == 0.0F)
        continue;
      const float radius = radii_[lane];
      *results_[lane] = {
          fits.k1[lane] / radius,
          fits.k2[lane] / radius,
          {fits.t1.x[lane], fits.t1.y[lane], fits.t1.z[lane]},
          {fits.normal.x[lane], fits.normal.y[lane], fits.normal.z[lane]},
          fits.offset[lane] * radius,
          radius,
          std::sqrt (fits.variance[lane]) * radius,
          std::sqrt (fits.k1_variance[lane]) / radius,
          true};
    }
  }

  /** \brief What a walk has reached: squared distance, index, and which of it. */
  struct Candidate {
    double squared;
    index_t node;
    std::uint32_t at;

    bool
    operator<(const Candidate& o) const
    {
      return std::tie (squared, node) < std::tie (o.squared, o.node);
    }
  };

  /** \brief Takes the nearest of the node's sheet, unless there may be something in the
   * way to them.
   */
  bool
  takeNear (std::int32_t place, const NearNodes& near)
  {
    const SeenNode& own = nodes_[place];
    const auto wanted = static_cast<std::size_t> (nearest_);
    if (own.is_alone)
      return false;
    neighbors_.resize (wanted + 1);
    neighbors_[0] = {own.position, own.weight};
    std::size_t taken = 1;
    int others = 0;
    float farthest = 0.0F;
    for (std::size_t i = 0; i < near.count && taken < wanted; ++i) {
      const SeenNode& q = nodes_[near.places[i]];
      if (q.is_alone)
        return false;
      const float cosine = q.normal.dot (own.normal);
      neighbors_[taken] = {q.position, q.weight};
      taken += cosine > NO_OTHER_SHEET ? 1 : 0;
      others += cosine > SAME_SHEET_COSINE ? 0 : 1;
      farthest = near.squared_distances[i];
    }
    if (taken < wanted || others > mostOthers (nearest_))
      return false;
    neighbors_.resize (taken);
    near_radius_ = static_cast<float> (
        LARGER_RADIUS * std::sqrt (static_cast<double> (farthest)) * level_.tree->unit);
    return true;
  }

  /** \brief Takes the nearest nodes of those that a walk over the surface reaches
   * first: a quarter more than are wanted, as rings are no circles.
   * \return the radius of the fit, 0 if there are too few
   */
  float
  walkedRadius (index_t node)
  {
    const Eigen::Vector3f& n = level_.normals[node];
    const auto same_sheet = [&n] (const SeenNode& q) {
      return q.normal.dot (n) > NO_OTHER_SHEET;
    };
    const auto wanted = static_cast<std::size_t> (nearest_);
    const std::size_t enough = wanted + wanted / 4;
    walk_.start (node);
    while (walk_.size() < enough && walk_.advance (same_sheet)) {
    }
    const double farthest = takeNearest (level_.positions[node], neighbors_);
    return neighbors_.size() < LEAST_NODES
               ? 0.0F
               : static_cast<float> (LARGER_RADIUS * farthest);
  }

  /** \brief Takes the nearest nodes of the walk, of equally near ones those of lower
   * index.
   * \return the distance of the farthest of them
   */
  double
  takeNearest (const Eigen::Vector3f& p, std::vector<Neighbor>& neighbors)
  {
    candidates_.resize (walk_.size());
    double farthest = 0.0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const double squared = (walk_[i].position - p).cast<double>().squaredNorm();
      candidates_[i] = {squared, walk_.node (i), static_cast<std::uint32_t> (i)};
      farthest = std::max (farthest, squared);
    }
    // Ranking takes the square of what there is, which is few but around hubs.
    const auto wanted = static_cast<std::size_t> (nearest_);
    if (candidates_.size() > 4 * wanted) {
      std::nth_element (
          candidates_.begin(), candidates_.begin() + nearest_, candidates_.end());
      candidates_.resize (wanted);
    }
    const std::size_t count = candidates_.size();
    parts_.resize (count + KERNEL_SLACK);
    const double scale = farthest > 0.0 ? 1.0 / farthest : 0.0;
    for (std::size_t i = 0; i < count; ++i)
      parts_[i] = static_cast<float> (scale * candidates_[i].squared);
    const auto take = [&] (const auto& is_near) {
      // Which of them are is as good as random: there is no branch for it.
      neighbors.resize (count);
      farthest = 0.0;
      std::size_t taken = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const SeenNode& node = walk_[candidates_[i].at];
        const bool near = is_near (i);
        neighbors[taken] = {node.position, node.weight};
        taken += near ? 1 : 0;
        farthest = std::max (farthest, near ? candidates_[i].squared : 0.0);
      }
      neighbors.resize (taken);
    };
    const float limit = limitOfNearest (count);
    if (limit >= 0.0F)
      take ([&] (std::size_t i) { return parts_[i] <= limit; });
    else {
      rank (count);
      take ([&] (std::size_t i) { return ranks_[i] < nearest_; });
    }
    return std::sqrt (farthest);
  }

  /** \brief A limit that as many parts as wanted, or all if they are fewer, are up to;
   * negative if none is found, as where some are equal.
   */
  float
  limitOfNearest (std::size_t count) const
  {
    constexpr int MOST_STEPS = 12;
    if (count <= static_cast<std::size_t> (nearest_))
      return 1.0F;
    // Their number grows about as the squared distance does.
    float low = 0.0F;
    float high = 1.0F;
    int low_count = 0;
    int high_count = static_cast<int> (count);
    for (int step = 0; step < MOST_STEPS; ++step) {
      const float part = step % 2 == 0
                             ? (static_cast<float> (nearest_ - low_count) + 0.5F) /
                                   (static_cast<float> (high_count - low_count) + 1.0F)
                             : 0.5F;
      const float middle = low + part * (high - low);
      int inside = 0;
      for (std::size_t i = 0; i < count; ++i)
        inside += parts_[i] <= middle ? 1 : 0;
      if (inside == nearest_)
        return middle;
      (inside < nearest_ ? low : high) = middle;
      (inside < nearest_ ? low_count : high_count) = inside;
    }
    return -1.0F;
  }

  /** \brief Ranks the parts. */
  void
  rank (std::size_t count)
  {
    numbers_.resize (count + KERNEL_SLACK);
    ranks_.resize (count + KERNEL_SLACK);
    for (std::size_t i = 0; i < count; ++i)
      numbers_[i] = candidates_[i].node;
    const auto ranked = static_cast<int> (count);
    if (!search_kernels_.rankDistinct (parts_.data(), ranked, ranks_.data()))
      search_kernels_.rankTied (parts_.data(), numbers_.data(), ranked, ranks_.data());
  }

  const PyramidLevel& level_;
  const std::vector<SeenNode>& nodes_;
  const Kernels& search_kernels_ = kernelsFor (bestSimd());
  const ScaleKernels& kernels_ = scaleKernels();
  int nearest_;
  NodeWalk<LoadNode> walk_;
  /** what a walk has reached */
  std::vector<Candidate> candidates_;
  /** of these as parts of the largest */
  std::vector<float> parts_;
  std::vector<std::int32_t> numbers_;
  std::vector<std::int32_t> ranks_;
  /** the last that were taken, and how far they are */
  std::vector<Neighbor> neighbors_;
  float near_radius_ = 0.0F;
  std::vector<NodeRow> rows_;
  std::vector<FrameRow> room_;
  FloatVectorRow normals_;
  std::array<float, FLOAT_LANES> radii_{};
  std::array<ScaleFit*, FLOAT_LANES> results_{};
};

/** \brief Replaces each node's estimate of the noise by the mean over its star: one
 * alone, with some ten degrees of freedom, is too uncertain for a test.
 */
void
poolNoise (const PyramidLevel& level,
           std::vector<ScaleFit>& fits,
           const Workers& workers)
{
  constexpr double UNKNOWN = -1.0;
  std::vector<double> variance;
  reserveLarge (variance, fits.size());
  for (const ScaleFit& fit : fits)
    variance.push_back (fit.valid ? static_cast<double> (fit.noise) * fit.noise
                                  : UNKNOWN);
  forEachBlock (
      fits.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          ScaleFit& fit = fits[i];
          if (!(variance[i] > 0.0))
            continue;
          double sum = variance[i];
          int count = 1;
          for (const index_t q : level.graph.star (static_cast<index_t> (i)))
            if (variance[q] != UNKNOWN) {
              sum += variance[q];
              ++count;
            }
          const auto pooled = static_cast<float> (std::sqrt (sum / count));
          fit.k1_error *= pooled / fit.noise;
          fit.noise = pooled;
        }
      });
}

} // namespace

std::vector<ScaleFit>
fitAtScale (const PyramidLevel& level,
            int nearest,
            const std::vector<std::uint8_t>& needed,
            const Workers& workers)
{
  std::vector<ScaleFit> fits = makeLarge (level.size(), ScaleFit());
  const std::vector<SeenNode> nodes = nodesInTreeOrder (level, workers);
  const int others = nearest - 1 + mostOthers (nearest);
  forEachBlock (
      level.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        CubicFitter fitter (level, nodes, nearest);
        visitNearNodes (*level.tree,
                        needed,
                        others,
                        first,
                        last,
                        [&] (std::int32_t place, index_t node, const NearNodes& near) {
                          fitter.fit (place, node, near, fits[node]);
                        });
        fitter.finish();
      });
  poolNoise (level, fits, workers);
  return fits;
}

} // namespace crest
} // namespace pcl
