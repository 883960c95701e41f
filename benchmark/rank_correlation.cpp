// SPDX-License-Identifier: BSD-3-Clause
#include "rank_correlation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace accuracy {

namespace {

/** \brief Ranks less their mean. */
std::vector<double>
centredRanks (const std::vector<double>& values)
{
  std::vector<std::size_t> order (values.size());
  std::iota (order.begin(), order.end(), std::size_t{0});
  std::sort (order.begin(), order.end(), [&] (std::size_t i, std::size_t j) {
    return values[i] < values[j];
  });
  const double mean = 0.5 * (static_cast<double> (values.size()) - 1.0);
  std::vector<double> ranks (values.size());
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && values[order[last]] == values[order[first]])
      ++last;
    for (std::size_t i = first; i < last; ++i)
      ranks[order[i]] = 0.5 * static_cast<double> (first + last - 1) - mean;
  }
  return ranks;
}

double
dot (const std::vector<double>& a, const std::vector<double>& b)
{
  return std::inner_product (a.begin(), a.end(), b.begin(), 0.0);
}

} // namespace

double
rankCorrelation (const std::vector<double>& a, const std::vector<double>& b)
{
  const std::vector<double> x = centredRanks (a);
  const std::vector<double> y = centredRanks (b);
  return dot (x, y) / std::sqrt (dot (x, x) * dot (y, y));
}

} // namespace accuracy
