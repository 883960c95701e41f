// SPDX-License-Identifier: BSD-3-Clause
#include "normals/face_winding.h"

#include <Eigen/Geometry>

#include "meshes/face_edges.h"
#include "normals/signed_sets.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** \brief Faces that edges connect. */
struct Body {
  std::size_t faces = 0;
  /** of these, that run the other way round than the first */
  std::size_t turned = 0;
  bool open = false;
  /** signed, where all faces run as the first */
  double volume = 0.0;

  /** \brief Whether the first is among those to turn. */
  bool
  turnsFirst () const
  {
    constexpr double DIVIDED = 1.0 / 3.0;
    const double few = static_cast<double> (std::min (turned, faces - turned));
    if (few > DIVIDED * static_cast<double> (faces) && !open && volume != 0.0)
      return volume < 0.0;
    return 2 * turned > faces;
  }
};

/** \brief Six times the volume between a face and the origin. */
double
volumeBelow (const PointView& cloud,
             const index_t* corners,
             std::size_t count,
             const Eigen::Vector3d& origin)
{
  const auto position = [&] (std::size_t i) -> Eigen::Vector3d {
    return cloud.positionOf (static_cast<std::size_t> (corners[i])).cast<double>() -
           origin;
  };
  double volume = 0.0;
  for (std::size_t i = 1; i + 1 < count; ++i)
    volume += position (0).dot (position (i).cross (position (i + 1)));
  return volume;
}

} // namespace

FaceWinding
unifyWinding (const PointView& cloud, Faces& faces)
{
  const std::size_t count = faces.ends.size();
  const EdgeTable table = tabulateEdges (faces, cloud.size);
  FaceWinding winding;
  SignedSets sets (count);
  std::vector<std::uint8_t> is_open (count, 0);
  forEachEdge (table, [&] (index_t, const FaceEdge* edge, std::size_t sides) {
    // More than two meet where bodies touch, which says nothing of their order.
    if (sides != 2) {
      for (std::size_t i = 0; i < sides; ++i)
        is_open[edge[i].face] |= sides == 1 ? 1 : 0;
      return;
    }
    const bool disagree = edge[0].rises == edge[1].rises;
    const SignedSets::Place a = sets.find (edge[0].face);
    const SignedSets::Place b = sets.find (edge[1].face);
    if (a.root != b.root)
      sets.unite (edge[0].face, edge[1].face, disagree);
    else if ((a.turned != b.turned) != disagree)
      ++winding.contradictory;
  });

  std::vector<Body> bodies (count);
  std::vector<SignedSets::Place> places;
  places.reserve (count);
  const auto corners_of = [&faces] (std::size_t face) {
    const std::size_t first = face == 0 ? 0 : faces.ends[face - 1];
    return std::make_pair (faces.corners.data() + first, faces.ends[face] - first);
  };
  for (std::size_t face = 0; face < count; ++face) {
    places.push_back (sets.find (static_cast<index_t> (face)));
    const SignedSets::Place& place = places.back();
    Body& body = bodies[place.root];
    ++body.faces;
    body.turned += place.turned ? 1 : 0;
    body.open = body.open || is_open[face] != 0;
    const auto [corners, size] = corners_of (face);
    if (size == 0)
      continue;
    // Anywhere near the body will do.
    const Eigen::Vector3d origin =
        cloud.positionOf (static_cast<std::size_t> (corners_of (place.root).first[0]))
            .cast<double>();
    const double volume = volumeBelow (cloud, corners, size, origin);
    body.volume += place.turned ? -volume : volume;
  }
  for (std::size_t face = 0; face < count; ++face) {
    const Body& body = bodies[places[face].root];
    if (body.turned == 0 || places[face].turned == body.turnsFirst())
      continue;
    const auto [corners, size] = corners_of (face);
    std::reverse (corners, corners + size);
    ++winding.turned;
  }
  return winding;
}

} // namespace crest
} // namespace pcl
