// SPDX-License-Identifier: BSD-3-Clause
// Points at random, none of which is near another.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace oracle {

/** \brief Points of space that keep a distance from each other. */
class PoissonDisks {
public:
  /** \brief For about `count` points on a surface of an area: disks thrown until hardly
   * any more fit cover the plane to this degree.
   */
  PoissonDisks (double area, std::size_t count)
  : disk_ (0.77 * std::sqrt (area / static_cast<double> (count)))
  {}

  /** \brief Takes a point if it is far enough from all that are taken. */
  bool
  take (const Eigen::Vector3d& p)
  {
    const Eigen::Vector3i center = (p / disk_).array().floor().cast<int>();
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto cell = taken_.find (key (center + Eigen::Vector3i (i, j, k)));
          if (cell == taken_.end())
            continue;
          for (const Eigen::Vector3d& q : cell->second)
            if ((p - q).squaredNorm() < disk_ * disk_)
              return false;
        }
    taken_[key (center)].push_back (p);
    return true;
  }

private:
  /** Far more cells than any surface here has are told apart. */
  static std::int64_t
  key (const Eigen::Vector3i& cell)
  {
    constexpr std::int64_t WIDTH = 1 << 20;
    return (cell.x() * WIDTH + cell.y()) * WIDTH + cell.z();
  }

  double disk_;
  std::unordered_map<std::int64_t, std::vector<Eigen::Vector3d>> taken_;
};

} // namespace oracle
