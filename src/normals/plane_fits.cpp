// SPDX-License-Identifier: BSD-3-Clause
#include "normals/plane_fits.h"

#include "base/parallel.h"
#include "base/quantile.h"
#include "base/scatter.h"
#include "search/leaf_search.h"

#include <array>
#include <limits>
#include <optional>

namespace pcl {
namespace crest {

namespace {

/** Doublings of the window, and how many neighbours are still found in no time. */
constexpr int GROWTHS = 4;
constexpr int WIDEST = 192;
/** From this one on a window serves all samples of a leaf. */
constexpr int SHARED = 2;
/** Leaves whose windows grow together. */
constexpr std::size_t GROUP = 8;
constexpr std::size_t MEMBERS = GROUP * LEAF_SIZE;
/** Standard deviation of heights over the radius of the window: where a plane is seen,
 * and where it may be a ball of noise as well. */
constexpr double FLAT = 0.2;
constexpr double ROUND = 0.45;
/** From here on it may be two sheets that are as far apart as the window is wide. */
constexpr double SHEETS = 0.38;
/** By how much wider windows scatter where they show a shape, not noise. */
constexpr double SHAPE = 1.3;

/** \brief Principal axes of a scatter, the smallest first. */
struct Axes {
  Eigen::Vector3d variances;
  Eigen::Vector3d normal;

  explicit Axes (const Eigen::Matrix3d& covariance)
  : normal (Scatter::shortestAxis (covariance, variances))
  {}

  /** \brief Whether they are wider than rounding makes a line.
   * \param[in] rounding of the coordinates
   */
  bool
  spanPlane (double rounding) const
  {
    // The closed form of eigenvalues is not more exact where two are nearly equal.
    constexpr double LINE = 1e-7;
    return variances[1] > LINE * variances[2] && variances[1] > rounding * rounding;
  }

  double
  radius () const
  {
    return std::sqrt (variances[1] + variances[2]);
  }
};

struct PlaneFit {
  Eigen::Vector3f plain = Eigen::Vector3f::Zero();
  double variation = 0.0;
  double plain_height = 0.0;
  double plain_sigma = 0.0;
  double radius = 0.0;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /** of the plane above the sample */
  double height = 0.0;
  double sigma = 0.0;
  /** sigma over the radius of the window */
  double roughness = std::numeric_limits<double>::infinity();
  /** as in PlaneFits; 0 for one sheet */
  double middle = 0.0;
  double kurtosis = 3.0;
  /** by two sheets, of the variance of heights above one plane */
  double kept = 1.0;

  [[nodiscard]] bool
  hasTwoSheets () const
  {
    return middle != 0.0;
  }

  /** \brief Whether the odds are less than a thousand to one that the sample is of the
   * sheet that it is nearer to, where noise is normally distributed.
   */
  [[nodiscard]] bool
  isBetweenSheets () const
  {
    constexpr double LEAST_LOG_ODDS = 6.9;
    return hasTwoSheets() &&
           2.0 * std::abs (middle * (height + middle)) < LEAST_LOG_ODDS * sigma * sigma;
  }
};

/** \brief A fit as seen from another sample. */
PlaneFit
seenFrom (const Eigen::Vector3f& offset, PlaneFit fit)
{
  fit.height -= fit.normal.dot (offset);
  // The sheet that a sample is nearer to is its own.
  if (fit.middle * (fit.height + fit.middle) < 0.0) {
    fit.height += 2.0 * fit.middle;
    fit.middle = -fit.middle;
  }
  return fit;
}

/** \brief What one window shows. */
struct WindowFit {
  PlaneFit fit;
  /** two sheets so close that one window does not tell them for certain from one */
  std::optional<PlaneFit> likely_sheets;
};

/** Of the points of a window, how many make a sheet. */
constexpr double LEAST_OF_SHEET = 6.0;

/** \brief The most kurtosis that heights in two clumps have, seen along a window that
 * is flat enough to be along both: where one has the least of points.
 */
double
mostOfTwoSheets (double count)
{
  // The clumps have some width.
  constexpr double WIDTH = 1.4;
  const double part = std::min (0.5, LEAST_OF_SHEET / count);
  const double variance = part * (1.0 - part);
  return WIDTH * (1.0 / variance - 3.0);
}

/** \brief The most of their variance that heights keep when split between two sheets:
 * where a window tells so by itself, and where others have to agree.
 */
struct MostKept {
  double by_certain;
  double by_likely;
};

/** \brief Heights that are spread evenly keep a quarter of their variance when split,
 * and more than a third if they are noise, but less by chance where they are few.
 * \param[in] count of points in the window
 */
MostKept
mostKept (double count)
{
  // Few points are as if in clumps where faces meet, too.
  if (count < 40.0)
    return {0.08, 0.08};
  if (count < 90.0)
    return {0.11, 0.14};
  return {0.11, count < 180.0 ? 0.2 : 0.235};
}

/** \brief Two parallel planes through offsets whose heights fall into two clumps, if
 * they do: found by turns of splitting the heights and fitting one normal to both.
 */
std::optional<PlaneFit>
fitTwoSheets (const Coordinates& offsets,
              std::size_t size,
              const Scatter& all,
              const Axes& axes)
{
  constexpr int ROUNDS = 4;
  constexpr double TURNED = 0.5;
  // Then no better normal will make clumps of them.
  constexpr double HOPELESS = 0.3;
  const double count = all.weight();
  Eigen::Vector3d normal = axes.normal;
  double split = normal.dot (all.center());
  std::array<Scatter, 2> sheets;
  double within = 0.0;
  double radius = 0.0;
  for (int round = 0; round < ROUNDS; ++round) {
    Scatter differences;
    differences.add (offsets, 0, size, [&] (std::size_t i) {
      return normal.x() * offsets.x[i] + normal.y() * offsets.y[i] +
                         normal.z() * offsets.z[i] <
                     split
                 ? 1.0
                 : -1.0;
    });
    sheets = {all.part (differences, 1.0), all.part (differences, -1.0)};
    if (std::min (sheets[0].weight(), sheets[1].weight()) < LEAST_OF_SHEET)
      return std::nullopt;
    const Axes pooled ((sheets[0].products() + sheets[1].products()) / count);
    const double cosine = pooled.normal.dot (normal);
    if (std::abs (cosine) <= TURNED)
      return std::nullopt;
    normal = cosine < 0.0 ? (-pooled.normal).eval() : pooled.normal;
    within = pooled.variances[0];
    radius = pooled.radius();
    split = 0.5 * normal.dot (sheets[0].center() + sheets[1].center());
    if (round > 0 && within * count > HOPELESS * normal.dot (all.products() * normal))
      return std::nullopt;
  }
  const double kept = within * count / normal.dot (all.products() * normal);
  if (!(kept < mostKept (count).by_likely))
    return std::nullopt;
  const int own = 0.0 < split ? 0 : 1;
  PlaneFit fit;
  fit.normal = normal.cast<float>();
  fit.height = normal.dot (sheets[own].center());
  fit.middle = split - fit.height;
  fit.sigma = std::sqrt (within * count / std::max (1.0, count - 4.0));
  fit.roughness = fit.sigma / radius;
  fit.kept = kept;
  return fit;
}

/** \brief The kurtosis of heights above a plane. */
double
kurtosisOf (const Coordinates& offsets,
            std::size_t count,
            const Eigen::Vector3d& normal,
            double plane)
{
  double squares = 0.0;
  double fourths = 0.0;
#pragma omp simd reduction(+ : squares, fourths)
  for (std::size_t i = 0; i < count; ++i) {
    const double height = normal.x() * offsets.x[i] + normal.y() * offsets.y[i] +
                          normal.z() * offsets.z[i] - plane;
    squares += height * height;
    fourths += height * height * height * height;
  }
  return squares > 0.0 ? fourths * static_cast<double> (count) / (squares * squares)
                       : 3.0;
}

/** \brief The plane, or two, through the offsets of neighbours from a sample.
 *
 * \param[in] offsets whose first ones are fitted
 * \param[in] size how many of them
 * \param[in] all their scatter
 * \param[in] rounding of the coordinates
 */
WindowFit
fitWindow (const Coordinates& offsets,
           std::size_t size,
           const Scatter& all,
           double rounding)
{
  WindowFit window;
  PlaneFit& fit = window.fit;
  const double count = all.weight();
  if (count < 3.0)
    return window;
  const Axes axes (all.products() / count);
  if (!axes.spanPlane (rounding))
    return window;
  fit.plain = fit.normal = axes.normal.cast<float>();
  fit.variation = axes.variances[0] / axes.variances.sum();
  fit.height = axes.normal.dot (all.center());
  fit.sigma = std::sqrt (axes.variances[0] * count / std::max (1.0, count - 3.0));
  fit.roughness = fit.sigma / axes.radius();
  if (fit.roughness > 0.5 * FLAT) {
    fit.kurtosis = kurtosisOf (offsets, size, axes.normal, fit.height);
    constexpr double ALONG = 1.5 * FLAT;
    std::optional<PlaneFit> sheets;
    if (fit.roughness > ALONG || fit.kurtosis < mostOfTwoSheets (count))
      sheets = fitTwoSheets (offsets, size, all, axes);
    if (sheets) {
      sheets->variation = fit.variation;
      sheets->radius = axes.radius();
      sheets->plain = sheets->normal;
      sheets->plain_height = sheets->height;
      sheets->plain_sigma = sheets->sigma;
      if (sheets->kept < mostKept (count).by_certain) {
        fit = *sheets;
        return window;
      }
      sheets->kurtosis = fit.kurtosis;
      window.likely_sheets = sheets;
    }
  }
  fit.plain_height = fit.height;
  fit.plain_sigma = fit.sigma;
  fit.radius = axes.radius();
  return window;
}

/** \brief Fits the windows of consecutive leaves. Belongs to one thread. */
class WindowFitter {
public:
  WindowFitter (const PointTree& tree, int k, PlaneFits& fits)
  : tree_ (tree), k_ (k), fits_ (fits)
  {}

  /** \brief Fits those of the samples from one place to another, of one group. */
  void
  fit (std::size_t first, std::size_t last)
  {
    int growth = 0;
    // Noise is that of the place: what was not enough for the last group will not be.
    int fitted = grew_ ? 1 : 0;
    fitWindows (0, fitted, first, last);
    std::optional<int> shape;
    while (roughness_[growth] >= FLAT && growth + 1 < GROWTHS &&
           k_ <= WIDEST >> (growth + 1)) {
      if (growth == fitted)
        fitWindows (growth + 1, ++fitted, first, last);
      if (!shape && sigma_[growth + 1] > SHAPE * sigma_[growth] &&
          roughness_[growth] < ROUND) {
        shape = growth;
        if (roughness_[growth] < SHEETS)
          break;
      }
      ++growth;
    }
    // Between the two it may be sheets as well, if wider windows find them.
    if (shape && !agree_[growth])
      growth = *shape;
    grew_ = growth > 0;
    for (std::size_t place = first; place < last; ++place) {
      const PlaneFit& nearest = windows_[0][place - first].fit;
      const PlaneFit& window = windows_[growth][place - first].fit;
      fits_.plain[place] = window.hasTwoSheets() ? window.plain : nearest.plain;
      fits_.variation[place] = static_cast<float> (nearest.variation);
      fits_.heights[place] = static_cast<float> (nearest.plain_height);
      fits_.sigmas[place] = static_cast<float> (nearest.plain_sigma);
      fits_.radii[place] = static_cast<float> (nearest.radius);
      // Both have a normal, or none: on lines it is rounding that decides.
      if (!nearest.plain.isZero (0.0F))
        keep (place, window.normal.isZero (0.0F) ? nearest : window, sigma_[growth]);
    }
  }

private:
  using Windows = std::array<WindowFit, MEMBERS>;

  const Eigen::Vector3f&
  position (std::size_t place) const
  {
    return fits_.positions[place];
  }

  /** \brief Fits all windows of some growths, with one search for the widest. */
  void
  fitWindows (int narrowest, int widest, std::size_t first, std::size_t last)
  {
    std::optional<LeafSearch>& search = searches_[widest];
    if (!search)
      search.emplace (tree_,
                      NeighborCount{std::max ((k_ << widest) - 1, PlaneFits::NEAREST)});
    for (std::size_t begin = first; begin < last; begin += LEAF_SIZE) {
      const std::size_t end = std::min (begin + LEAF_SIZE, last);
      if (widest < SHARED)
        fitEach (narrowest, widest, first, search->searchLeaf (begin / LEAF_SIZE));
      else
        shareWindow (widest, first, begin, end);
    }
    const std::size_t count = last - first;
    std::array<double, MEMBERS> values{};
    for (int growth = narrowest; growth <= widest; ++growth) {
      agree_[growth] = agreeOnSheets (windows_[growth], count);
      // Where windows agree on sheets, those that do not see them yet have to grow.
      const std::size_t nth = (agree_[growth] ? 3 * count : count) / 4;
      const auto quartile = [&] (double PlaneFit::*value) {
        for (std::size_t i = 0; i < count; ++i)
          values[i] = windows_[growth][i].fit.*value;
        std::nth_element (values.begin(), values.begin() + nth, values.begin() + count);
        return values[nth];
      };
      roughness_[growth] = quartile (&PlaneFit::roughness);
      sigma_[growth] = quartile (&PlaneFit::sigma);
    }
  }

  /** \brief Takes the likely sheets of a group where most windows have some, and too
   * few to tell have them for certain. Returns whether that is so.
   */
  static bool
  agreeOnSheets (Windows& windows, std::size_t count)
  {
    constexpr double MOST = 0.6;
    std::size_t likely = 0;
    std::size_t certain = 0;
    for (std::size_t i = 0; i < count; ++i) {
      certain += windows[i].fit.hasTwoSheets() ? 1 : 0;
      likely += windows[i].likely_sheets ? 1 : 0;
    }
    if (static_cast<double> (certain + likely) < MOST * static_cast<double> (count) ||
        2 * certain > count)
      return false;
    for (std::size_t i = 0; i < count; ++i)
      if (windows[i].likely_sheets)
        windows[i].fit = *windows[i].likely_sheets;
    return true;
  }

  void
  fitEach (int narrowest, int widest, std::size_t group, const LeafNeighbors& found)
  {
    for (int i = 0; i < found.count; ++i) {
      const auto place =
          static_cast<std::size_t> (found.first) + static_cast<std::size_t> (i);
      const std::size_t begin = found.offsets[i];
      const std::size_t end = found.offsets[i + 1];
      const auto sizeOf = [&] (int growth) {
        return 1 +
               std::min (static_cast<std::size_t> ((k_ << growth) - 1), end - begin);
      };
      offsets_.resize (sizeOf (widest));
      offsets_.set (0, Eigen::Vector3d::Zero());
      for (std::size_t j = 1; j < offsets_.size(); ++j)
        offsets_.set (
            j,
            (position (found.places[begin + j - 1]) - position (place)).cast<double>());
      constexpr double PRECISION = 2e-7;
      const double rounding = PRECISION * position (place).cwiseAbs().maxCoeff();
      Scatter all;
      std::size_t added = 0;
      for (int growth = narrowest; growth <= widest; ++growth) {
        const std::size_t size = sizeOf (growth);
        all.add (offsets_, added, size, [] (std::size_t) { return 1.0; });
        added = size;
        windows_[growth][place - group] = fitWindow (offsets_, size, all, rounding);
      }
      if (narrowest == 0 && end != begin)
        fits_.reach[place] =
            found.squared_distances[std::min (begin + PlaneFits::NEAREST, end) - 1];
    }
  }

  /** \brief Fits one window for a leaf: wide ones are nearly the same for all of its
   * samples.
   */
  void
  shareWindow (int growth, std::size_t group, std::size_t begin, std::size_t end)
  {
    const std::size_t middle = begin + (end - begin) / 2;
    fitEach (growth,
             growth,
             group,
             searches_[growth]->searchPoint (static_cast<std::int32_t> (middle)));
    const WindowFit shared = windows_[growth][middle - group];
    for (std::size_t place = begin; place < end; ++place) {
      const Eigen::Vector3f offset = position (place) - position (middle);
      WindowFit& window = windows_[growth][place - group];
      window.fit = seenFrom (offset, shared.fit);
      window.likely_sheets.reset();
      if (shared.likely_sheets)
        window.likely_sheets = seenFrom (offset, *shared.likely_sheets);
    }
  }

  void
  keep (std::size_t place, const PlaneFit& window, double sigma)
  {
    // In spacings of the samples: what noise is worth a move.
    constexpr double NOISE = 0.1;
    // A window that is not flat does not tell where the surface is.
    const bool moves =
        sigma > NOISE * fits_.spacing (place) && window.roughness < 1.5 * FLAT;
    fits_.normals[place] = window.normal;
    fits_.kurtosis[place] = static_cast<float> (window.kurtosis);
    fits_.middles[place] = static_cast<float> (window.middle);
    fits_.between[place] = window.isBetweenSheets() ? 1 : 0;
    fits_.errors[place] = static_cast<float> (moves ? 0.5 * sigma : sigma);
    if (moves)
      fits_.feet[place] += static_cast<float> (window.height) * window.normal;
  }

  const PointTree& tree_;
  int k_;
  PlaneFits& fits_;
  std::array<std::optional<LeafSearch>, GROWTHS> searches_;
  std::array<Windows, GROWTHS> windows_;
  /** of each growth the lower quartile over the group, the upper where windows agree on
   * two sheets */
  std::array<double, GROWTHS> roughness_{};
  std::array<double, GROWTHS> sigma_{};
  /** whether its windows agree on two sheets */
  std::array<bool, GROWTHS> agree_{};
  /** whether windows of the last group did */
  bool grew_ = false;
  Coordinates offsets_;
};

/** \brief Stray points stand for no more of the surface than what is near by: their own
 * neighbours are as far away as that is.
 */
void
limitReach (const PointTree& tree, PlaneFits& fits)
{
  std::vector<std::pair<std::size_t, float>> limits;
  LeafSearch search (tree, {PlaneFits::NEAREST});
  std::vector<float> reaches;
  for (std::size_t first = 0; first < fits.size(); first += MEMBERS) {
    const std::size_t last = std::min (first + MEMBERS, fits.size());
    reaches.assign (fits.reach.begin() + static_cast<std::ptrdiff_t> (first),
                    fits.reach.begin() + static_cast<std::ptrdiff_t> (last));
    const float quartile = quantile (reaches, 25);
    for (std::size_t place = first; place < last; ++place) {
      if (fits.reach[place] <= MOST_UNEVEN * quartile)
        continue;
      const LeafNeighbors& found =
          search.searchPoint (static_cast<std::int32_t> (place));
      float limit = fits.reach[place];
      for (std::size_t j = found.offsets[0]; j < found.offsets[1]; ++j)
        limit = std::min (limit, MOST_UNEVEN * fits.reach[found.places[j]]);
      limits.emplace_back (place, limit);
    }
  }
  for (const auto& [place, limit] : limits)
    fits.reach[place] = limit;
}

} // namespace

PlaneFits
fitPlanes (const PointTree& tree, int k, const Workers& workers)
{
  static_assert (BLOCK_SIZE % MEMBERS == 0, "groups must not straddle blocks");
  PlaneFits fits;
  const Eigen::Vector3f zero = Eigen::Vector3f::Zero();
  fits.positions.resize (tree.size);
  for (std::size_t place = 0; place < tree.size; ++place) {
    const PointLeaf& leaf = tree.leaves[place / LEAF_SIZE];
    const std::size_t i = place % LEAF_SIZE;
    fits.positions[place] = {leaf.x[i], leaf.y[i], leaf.z[i]};
  }
  fits.plain.assign (tree.size, zero);
  fits.variation.assign (tree.size, 0.0F);
  fits.heights.assign (tree.size, 0.0F);
  fits.sigmas.assign (tree.size, 0.0F);
  fits.radii.assign (tree.size, 0.0F);
  fits.normals.assign (tree.size, zero);
  fits.feet = fits.positions;
  fits.errors.assign (tree.size, 0.0F);
  fits.kurtosis.assign (tree.size, 3.0F);
  fits.middles.assign (tree.size, 0.0F);
  fits.between.assign (tree.size, 0);
  fits.reach.assign (tree.size, 0.0F);
  forEachBlock (
      tree.size, workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        WindowFitter fitter (tree, k, fits);
        for (; first < last; first += MEMBERS)
          fitter.fit (first, std::min (first + MEMBERS, last));
      });
  limitReach (tree, fits);
  return fits;
}

} // namespace crest
} // namespace pcl
