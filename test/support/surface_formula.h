// SPDX-License-Identifier: BSD-3-Clause
// How a formula becomes a surface with exact derivatives. Takes long to compile: for
// the files that define surfaces alone.
#pragma once

#include <boost/math/differentiation/autodiff.hpp>

#include "analytic_surface.h"

#include <array>

namespace oracle {

constexpr double PI = 3.14159265358979323846;

/** \brief Makes a surface of a formula that maps (u, v) of any number type to xyz. */
template <typename Formula>
AnalyticSurface
make (std::string name,
      double u_min,
      double u_max,
      double v_min,
      double v_max,
      Formula formula)
{
  const auto position = [formula] (double u, double v) {
    const std::array<double, 3> x = formula (u, v);
    return Eigen::Vector3d (x[0], x[1], x[2]);
  };
  const auto derivatives = [formula] (double u, double v) {
    const auto variables =
        boost::math::differentiation::make_ftuple<double, 3, 3> (u, v);
    // The first variable knows nothing of the second: adding zero makes them one type.
    const auto zero = 0.0 * std::get<0> (variables) * std::get<1> (variables);
    const auto x =
        formula (std::get<0> (variables) + zero, std::get<1> (variables) + zero);
    Derivatives result;
    for (int i = 0; i <= 3; ++i)
      for (int j = 0; i + j <= 3; ++j)
        for (int axis = 0; axis < 3; ++axis)
          result.d[i][j][axis] = x[axis].derivative (i, j);
    return result;
  };
  return {std::move (name), u_min, u_max, v_min, v_max, position, derivatives};
}

/** \brief A surface that a radius as a function of the unit direction describes. */
template <typename Radius>
AnalyticSurface
makeRadial (std::string name, double v_limit, Radius radius)
{
  return make (std::move (name), -PI, PI, -v_limit, v_limit, [radius] (auto u, auto v) {
    using T = decltype (u);
    const T x = cos (u) * cos (v);
    const T y = sin (u) * cos (v);
    const T z = sin (v);
    const T r = radius (x, y, z);
    return std::array<T, 3>{r * x, r * y, r * z};
  });
}

} // namespace oracle
