// SPDX-License-Identifier: BSD-3-Clause
#include "surface_list.h"

#include "support/benchmark_surfaces.h"
#include "support/held_out_surfaces.h"
#include "support/surface_cases.h"

#include <algorithm>

namespace accuracy {

namespace {

std::vector<ListedSurface>
allSurfaces ()
{
  std::vector<ListedSurface> all;
  for (const oracle::SurfaceCase& c : oracle::surfaceCases())
    all.push_back ({c.surface, "tuned"});
  for (const auto& make : {oracle::ringRidge,
                           oracle::gentleWaves,
                           oracle::ellipticKnot,
                           oracle::crossingRidges,
                           oracle::parallelRidges,
                           oracle::unevenRidges,
                           oracle::superellipsoid,
                           oracle::spiralRidge})
    all.push_back ({make(), "tuned"});
  for (const auto& make :
       {oracle::heldOutHarmonics, oracle::heldOutDunes, oracle::heldOutRoof})
    all.push_back ({make(), "held_out"});
  all.push_back ({oracle::plane(), "silent"});
  all.push_back ({oracle::sphere (1.0), "silent"});
  all.push_back ({oracle::cylinder (0.5), "silent"});
  all.push_back ({oracle::torus (1.0, 0.4), "silent"});
  return all;
}

} // namespace

std::vector<ListedSurface>
listSurfaces (const std::vector<std::string>& wanted, std::string& unknown)
{
  const std::vector<ListedSurface> all = allSurfaces();
  const auto isCalled = [] (const ListedSurface& listed, const std::string& name) {
    return listed.surface.name == name || listed.group == name;
  };
  for (const std::string& name : wanted)
    if (std::none_of (all.begin(), all.end(), [&] (const ListedSurface& listed) {
          return isCalled (listed, name);
        }))
      unknown = name;
  std::vector<ListedSurface> chosen;
  for (const ListedSurface& listed : all)
    if (wanted.empty() ||
        std::any_of (wanted.begin(), wanted.end(), [&] (const std::string& name) {
          return isCalled (listed, name);
        }))
      chosen.push_back (listed);
  return chosen;
}

} // namespace accuracy
