// SPDX-License-Identifier: BSD-3-Clause
// Clouds with exact normals that make it hard to tell to which side these look.
#pragma once

#include "sharp_solids.h"

#include <ostream>

namespace oracle {

/** \brief Samples with exact normals, away from the material. */
struct SolidCloud {
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud;
  /** none where the surface is smooth */
  std::vector<SharpEdge> edges;
  /** h: mean distance to the 6 nearest */
  double spacing = 0.0;
};

/** \brief A solid, or a surface that is open below. */
struct NamedSolid {
  std::string name;
  /** of open ones the normals look up */
  bool closed;
  std::function<SolidCloud (unsigned seed)> sample;
};

inline std::ostream&
operator<< (std::ostream& stream, const NamedSolid& solid)
{
  return stream << solid.name;
}

/** \brief All of them. Sizes in h in their names hold within some hundredths. */
const std::vector<NamedSolid>&
namedSolids ();

} // namespace oracle
