// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark_surfaces.h"

#include "surface_formula.h"

namespace oracle {

AnalyticSurface
ringRidge ()
{
  return make ("ring ridge", -1.0, 1.0, -1.0, 1.0, [] (auto u, auto v) {
    using T = decltype (u);
    const T d = sqrt (u * u + v * v) - 0.6;
    return std::array<T, 3>{u, v, 0.16 * exp (-d * d / (2.0 * 0.1 * 0.1))};
  });
}

AnalyticSurface
gentleWaves ()
{
  return make ("gentle waves", -0.85, 0.95, -0.9, 0.9, [] (auto u, auto v) {
    using T = decltype (u);
    return std::array<T, 3>{
        u, v, 0.10 * sin (4.0 * u + 1.5 * v) + 0.08 * sin (-2.0 * u + 4.2 * v + 1.0)};
  });
}

AnalyticSurface
ellipticKnot ()
{
  return make ("elliptic knot", -PI, PI, -PI, PI, [] (auto u, auto v) {
    using T = decltype (u);
    constexpr double TUBE = 0.4; // of the torus that the knot lies on
    const T around = 1.0 + TUBE * cos (3.0 * u);
    const T sine = sin (2.0 * u);
    const T cosine = cos (2.0 * u);
    // Away from that torus, which is across the knot.
    const T ex = cos (3.0 * u) * cosine;
    const T ey = cos (3.0 * u) * sine;
    const T ez = sin (3.0 * u);
    const T tx = -3.0 * TUBE * ez * cosine - 2.0 * around * sine;
    const T ty = -3.0 * TUBE * ez * sine + 2.0 * around * cosine;
    const T tz = 3.0 * TUBE * cos (3.0 * u);
    const T speed = sqrt (tx * tx + ty * ty + tz * tz);
    const T far = TUBE + 0.2 * cos (v);
    const T aside = -0.1 * sin (v) / speed;
    return std::array<T, 3>{cosine + far * ex + aside * (ty * ez - tz * ey),
                            sine + far * ey + aside * (tz * ex - tx * ez),
                            far * ez + aside * (tx * ey - ty * ex)};
  });
}

AnalyticSurface
crossingRidges ()
{
  return make ("crossing ridges", -1.0, 1.0, -1.0, 1.0, [] (auto u, auto v) {
    using T = decltype (u);
    const auto ridge = [] (auto d) { return exp (-d * d / (2.0 * 0.09 * 0.09)); };
    const T along = v - 0.3 * u - 0.2;
    const T across = u + 0.25 * v * v - 0.3;
    // Fades where it comes near to the first.
    const T fading = ridge (u + 0.55) / (1.0 + exp (20.0 * (v - 0.02)));
    return std::array<T, 3>{u, v, 0.15 * (ridge (along) + ridge (across) + fading)};
  });
}

AnalyticSurface
parallelRidges ()
{
  return make ("parallel ridges", -1.0, 1.0, -0.6, 0.6, [] (auto u, auto v) {
    using T = decltype (u);
    const auto ridge = [] (auto d) { return exp (-d * d / (2.0 * 0.026 * 0.026)); };
    const T d = v - 0.1 * sin (2.0 * u);
    return std::array<T, 3>{u,
                            v,
                            0.03 * (ridge (d + 0.155) + ridge (d + 0.065) +
                                    ridge (d - 0.04) + ridge (d - 0.16))};
  });
}

AnalyticSurface
unevenRidges ()
{
  return make ("uneven ridges", -1.0, 1.0, -0.9, 0.9, [] (auto u, auto v) {
    using T = decltype (u);
    const T lower = v - 0.45 - 0.05 * sin (3.0 * u);
    const T wider = v + 0.4 + 0.05 * cos (2.0 * u);
    const T width = 0.11 + 0.07 * u;
    return std::array<T, 3>{u,
                            v,
                            (0.14 - 0.10 * u) *
                                    exp (-lower * lower / (2.0 * 0.09 * 0.09)) +
                                0.15 * exp (-wider * wider / (2.0 * width * width))};
  });
}

AnalyticSurface
superellipsoid ()
{
  return makeRadial ("superellipsoid", 1.4, [] (auto x, auto y, auto z) {
    const auto fourth_power = [] (auto a) { return a * a * a * a; };
    return exp (
        -log (fourth_power (x) + fourth_power (y / 0.8) + fourth_power (z / 0.6)) /
        4.0);
  });
}

AnalyticSurface
spiralRidge ()
{
  return make ("spiral", 0.25, 1.15, -PI, PI, [] (auto radius, auto angle) {
    using T = decltype (radius);
    const T winding = cos (angle - 2.0 * PI * radius / 0.45);
    return std::array<T, 3>{radius * cos (angle),
                            radius * sin (angle),
                            0.11 * exp (3.5 * (winding - 1.0)) -
                                0.25 * radius * radius};
  });
}

} // namespace oracle
