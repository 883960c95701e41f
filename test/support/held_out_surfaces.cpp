// SPDX-License-Identifier: BSD-3-Clause
#include "held_out_surfaces.h"

#include "surface_formula.h"

namespace oracle {

AnalyticSurface
heldOutHarmonics ()
{
  return makeRadial ("held-out harmonics", 1.35, [] (auto x, auto y, auto z) {
    return 1.0 + 0.18 * (x * x * x - 3.0 * x * y * y) +
           0.5 * x * y * z * (1.0 + 0.6 * z);
  });
}

AnalyticSurface
heldOutSpiral ()
{
  return make ("held-out spiral", 0.25, 1.15, -PI, PI, [] (auto radius, auto angle) {
    using T = decltype (radius);
    const T winding = cos (angle - 2.0 * PI * radius / 0.45);
    return std::array<T, 3>{radius * cos (angle),
                            radius * sin (angle),
                            0.11 * exp (3.5 * (winding - 1.0)) -
                                0.25 * radius * radius};
  });
}

AnalyticSurface
heldOutRoof ()
{
  return make ("held-out roof", -1.0, 1.0, -0.7, 0.7, [] (auto u, auto v) {
    using T = decltype (u);
    static constexpr double ROUND = 0.05;
    const auto plane = [] (auto height) { return exp (height / ROUND); };
    const T soft = plane (1.2 * v) + plane (-1.2 * v) + plane (1.4 * (u - 0.4)) +
                   plane (-1.4 * (u + 0.4));
    return std::array<T, 3>{u, v, -ROUND * log (soft)};
  });
}

} // namespace oracle
