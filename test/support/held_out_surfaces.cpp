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
heldOutDunes ()
{
  return make ("held-out dunes", -1.0, 1.0, -1.0, 1.0, [] (auto u, auto v) {
    using T = decltype (u);
    const T wave = sin (4.2 * u + 0.8 * sin (2.1 * v + 0.4));
    return std::array<T, 3>{
        u, v, 0.14 * exp (2.2 * (wave - 1.0)) + 0.06 * sin (2.7 * v - 0.6 * u)};
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
