// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>

#include "base/disjoint_sets.h"
#include "creases/crease_chains.h"
#include "creases/place_search.h"

#include <cmath>
#include <limits>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

using Eigen::Vector3d;

/** In spacings: how far an end may be from what it is joined to. Windows see one edge
 * alone from about half of that on. */
constexpr double FARTHEST_JOIN = 4.5;
/** How far two lines may pass each other that meet in a corner. */
constexpr double LARGEST_GAP = 0.8;

struct End {
  CreaseEnd end;
  CrestType type;
  Vector3d foot;
  /** unit, out of its chain */
  Vector3d out;
  double spacing;
};

/** \brief Two ends that may be joined. */
struct Pair {
  double cost;
  int a, b;
  /** whether they go on in each other's direction */
  bool facing;
};

class Joiner {
public:
  Joiner (const OrientedPoints& points, const CreaseChains& chains)
  : points_ (points), chains_ (chains)
  {
    // Shorter ones are chance, and their ends point anywhere.
    constexpr double LEAST_LENGTH = 1.5;
    for (int i = 0; i < static_cast<int> (chains.nodes.size()); ++i)
      for (int way = 0; way < 2; ++way)
        if (chains.next[i][way] == CreaseChains::NO_NODE &&
            chains.chains[chains.chain_of[i]].length >= LEAST_LENGTH) {
          const CreaseNode& node = chains.nodes[i];
          ends_.push_back ({{i, way},
                            node.type,
                            node.foot,
                            way == 1 ? node.direction : Vector3d (-node.direction),
                            node.spacing});
        }
    state_.assign (ends_.size(), FREE);
  }

  CreaseJoins
  join ()
  {
    CreaseJoins joins;
    DisjointSets corners (ends_.size());
    for (const Pair& pair : pairs()) {
      if (pair.facing && state_[pair.a] == FREE && state_[pair.b] == FREE) {
        state_[pair.a] = state_[pair.b] = BRIDGED;
        joins.bridges.emplace_back (ends_[pair.a].end, ends_[pair.b].end.node);
      }
      else if (!pair.facing && state_[pair.a] != BRIDGED && state_[pair.b] != BRIDGED) {
        state_[pair.a] = state_[pair.b] = IN_CORNER;
        corners.unite (pair.a, pair.b);
      }
    }
    std::vector<std::vector<int>> members (ends_.size());
    for (int i = 0; i < static_cast<int> (ends_.size()); ++i)
      if (state_[i] == IN_CORNER)
        members[corners.find (i)].push_back (i);
    for (const std::vector<int>& of_corner : members)
      if (of_corner.size() > 1)
        joins.corners.push_back (cornerOf (of_corner));
    bridgeToLines (joins);
    return joins;
  }

private:
  enum State : std::uint8_t { FREE, IN_CORNER, BRIDGED };

  /** \brief What may be joined, nearest first. */
  std::vector<Pair>
  pairs () const
  {
    std::vector<Vector3d> places;
    for (const End& end : ends_)
      places.push_back (end.foot);
    const PlaceSearch search (points_, places);
    std::vector<Pair> pairs;
    std::vector<int> around;
    for (int a = 0; a < static_cast<int> (ends_.size()); ++a) {
      search.within (ends_[a].foot, 2.0 * FARTHEST_JOIN * ends_[a].spacing, around);
      for (const int b : around)
        if (b > a && ends_[a].end.node != ends_[b].end.node)
          addPair (a, b, pairs);
    }
    std::sort (pairs.begin(), pairs.end(), [] (const Pair& x, const Pair& y) {
      return std::tie (x.cost, x.a, x.b) < std::tie (y.cost, y.a, y.b);
    });
    return pairs;
  }

  void
  addPair (int a, int b, std::vector<Pair>& pairs) const
  {
    constexpr double FACING_COSINE = -0.8;
    constexpr double LEAST_SINE_SQUARED = 0.05;
    // In spacings: how far chains may have gone beyond where they meet.
    constexpr double OVERSHOOT = 1.5;
    const End& x = ends_[a];
    const End& y = ends_[b];
    const double spacing = 0.5 * (x.spacing + y.spacing);
    const Vector3d e = (y.foot - x.foot) / spacing;
    const double length = e.norm();
    const double cosine = x.out.dot (y.out);
    const double along_x = e.dot (x.out);
    const double along_y = -e.dot (y.out);
    if (x.type == y.type && cosine < FACING_COSINE) {
      const double along = std::min (along_x, along_y);
      const double across = std::sqrt (std::max (0.0, length * length - along * along));
      if (along > -0.5 && length < FARTHEST_JOIN &&
          across < std::max (LARGEST_GAP, 0.35 * length))
        pairs.push_back ({length, a, b, true});
      return;
    }
    const double sine_squared = 1.0 - cosine * cosine;
    if (sine_squared < LEAST_SINE_SQUARED)
      return;
    // Where the two lines are nearest to each other.
    const double s = (along_x + cosine * along_y) / sine_squared;
    const double t = (along_y + cosine * along_x) / sine_squared;
    const double gap = (e + t * y.out - s * x.out).norm();
    if (gap < LARGEST_GAP && std::min (s, t) > -OVERSHOOT &&
        std::max (s, t) < FARTHEST_JOIN)
      pairs.push_back ({std::abs (s) + std::abs (t) + gap, a, b, false});
  }

  /** \brief The point nearest to the lines through all ends of a corner. */
  CreaseJoins::Corner
  cornerOf (const std::vector<int>& members) const
  {
    // Keeps what the lines do not determine where the ends are.
    constexpr double HOLD = 1e-3;
    CreaseJoins::Corner corner;
    Vector3d middle = Vector3d::Zero();
    for (const int i : members)
      middle += ends_[i].foot / static_cast<double> (members.size());
    Eigen::Matrix3d matrix = HOLD * Eigen::Matrix3d::Identity();
    Vector3d right_side = Vector3d::Zero();
    for (const int i : members) {
      const Vector3d& out = ends_[i].out;
      const Eigen::Matrix3d across =
          Eigen::Matrix3d::Identity() - out * out.transpose();
      matrix += across;
      right_side += across * (ends_[i].foot - middle);
      corner.ends.push_back (ends_[i].end);
    }
    corner.position = middle + matrix.ldlt().solve (right_side);
    return corner;
  }

  /** \brief Joins free ends to the lines that they run into. */
  void
  bridgeToLines (CreaseJoins& joins) const
  {
    const PlaceSearch search (points_, feet (chains_.nodes));
    std::vector<int> around;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      if (state_[i] != FREE)
        continue;
      // In spacings.
      constexpr double FARTHEST = 2.8;
      search.within (ends_[i].foot, FARTHEST * ends_[i].spacing, around);
      const int other = runsInto (ends_[i], around);
      if (other != CreaseChains::NO_NODE)
        joins.bridges.emplace_back (ends_[i].end, other);
    }
  }

  /** \brief The nearest node of another line that a free end points at, or NO_NODE.
   * \param[in] around the nodes that it may be
   */
  int
  runsInto (const End& end, const std::vector<int>& around) const
  {
    constexpr double LEAST_COSINE = 0.5;
    constexpr double SAME_LINE_COSINE = 0.7;
    // In spacings.
    constexpr double OWN_CHAIN_LENGTH = 8.0;
    int best = CreaseChains::NO_NODE;
    double nearest = std::numeric_limits<double>::infinity();
    const int chain = chains_.chain_of[end.end.node];
    for (const int i : around) {
      const CreaseNode& node = chains_.nodes[i];
      const Vector3d e = node.foot - end.foot;
      const double length = e.norm();
      if (length >= nearest || i == end.end.node ||
          e.dot (end.out) < LEAST_COSINE * length)
        continue;
      const bool own = chains_.chain_of[i] == chain;
      if (own && (chains_.chains[chain].length < OWN_CHAIN_LENGTH ||
                  std::abs (node.direction.dot (end.out)) > SAME_LINE_COSINE))
        continue;
      nearest = length;
      best = i;
    }
    return best;
  }

  const OrientedPoints& points_;
  const CreaseChains& chains_;
  std::vector<End> ends_;
  std::vector<State> state_;
};

} // namespace

CreaseJoins
joinEnds (const OrientedPoints& points, const CreaseChains& chains)
{
  return Joiner (points, chains).join();
}

} // namespace crest
} // namespace pcl
