// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_faces.h"

#include "meshes/face_samples.h"
#include "meshes/mesh_detail.h"
#include "meshes/shared_corners.h"
#include "meshes/triangulation.h"
#include "normals/face_winding.h"

#include <algorithm>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

std::string
shown (double number)
{
  std::ostringstream text;
  text.precision (3);
  text << number;
  return text.str();
}

/** \brief Turns all triangles over where the normals of the file are on the other side.
 */
void
takeSideOfNormals (PlacedContent& content, Faces& triangles)
{
  const pcl::PointCloud<pcl::PointNormal>& points = *content.points;
  double agreement = 0.0;
  for (std::size_t i = 0; i < triangles.corners.size(); i += 3) {
    const auto corner = [&] (std::size_t j) -> const pcl::PointNormal& {
      return points[triangles.corners[i + j]];
    };
    const Eigen::Vector3f twice_area =
        (corner (1).getVector3fMap() - corner (0).getVector3fMap())
            .cross (corner (2).getVector3fMap() - corner (0).getVector3fMap());
    for (std::size_t j = 0; j < 3; ++j)
      if (corner (j).getNormalVector3fMap().allFinite())
        agreement += corner (j).getNormalVector3fMap().dot (twice_area);
  }
  if (agreement >= 0.0)
    return;
  for (std::size_t i = 0; i < triangles.corners.size(); i += 3)
    std::swap (triangles.corners[i], triangles.corners[i + 1]);
  content.notes.emplace_back ("The faces run clockwise as the normals of the file see "
                              "them, and were turned over.");
}

void
checkSpacing (double spacing, double area)
{
  constexpr double LEAST_SAMPLES = 100.0;
  const double count = area / (spacing * spacing);
  const std::string samples = "a spacing of " + shown (spacing) + " makes " +
                              shown (count) + " samples of its faces, whose area is " +
                              shown (area) + ", but -sample has to make ";
  if (!(count <= MOST_FACE_SAMPLES))
    throw ReadError (samples + "at most " + shown (MOST_FACE_SAMPLES));
  if (count < LEAST_SAMPLES)
    throw ReadError (samples + "at least " + shown (LEAST_SAMPLES));
}

} // namespace

bool
unifyFaces (PlacedContent& content)
{
  const FaceWinding winding = unifyWinding (viewOf (*content.points), content.faces);
  if (winding.turned != 0)
    content.notes.push_back (std::to_string (winding.turned) + " of " +
                             std::to_string (content.faces.ends.size()) +
                             " faces run around the other way than those beside them, "
                             "and were turned over.");
  if (winding.contradictory != 0)
    content.notes.push_back ("At " + std::to_string (winding.contradictory) +
                             " edges no order of corners makes both faces look to the "
                             "same side: the surface has but one side, or crosses "
                             "itself.");
  return winding.turned == 0 && winding.contradictory == 0;
}

SampledFaces
replaceBySamples (PlacedContent& content, const ReadOptions& options, unsigned threads)
{
  const bool is_asked = options.sample_spacing > 0.0;
  if (is_asked && content.faces.ends.empty())
    throw ReadError ("it has no faces that -sample could sample");
  if (!options.samples_faces || content.faces.ends.empty())
    return {};
  const PointView cloud = viewOf (*content.points);
  const Workers workers (threads);
  PlacedContent mesh;
  mesh.points = content.points;
  mesh.faces = triangulate (cloud, shareCorners (cloud, content.faces));
  EdgeTable edges = tabulateEdges (mesh.faces, cloud.size);
  TriangleShapes shapes = measureTriangles (cloud, mesh.faces, edges);
  const MeshDetail detail = measureDetail (cloud, mesh.faces, edges, shapes, workers);
  if (!is_asked && !detail.needsSamples())
    return {};
  const double spacing = is_asked ? options.sample_spacing : detail.resolvingSpacing();
  checkSpacing (spacing, detail.area);

  const bool sides_agree = unifyFaces (mesh);
  if (content.has_normals)
    takeSideOfNormals (mesh, mesh.faces);
  edges = tabulateEdges (mesh.faces, cloud.size);
  shapes = measureTriangles (cloud, mesh.faces, edges);
  const FaceSamples samples = sampleFaces (cloud, mesh.faces, shapes, spacing, workers);
  checkPointCount (samples.positions.size());
  const std::size_t vertices = content.points->size();
  content.points.reset (new pcl::PointCloud<pcl::PointNormal>);
  content.points->resize (samples.positions.size());
  for (std::size_t i = 0; i < samples.positions.size(); ++i) {
    (*content.points)[i].getVector3fMap() = samples.positions[i];
    (*content.points)[i].getNormalVector3fMap() = samples.normals[i];
  }
  content.placement.apart.clear();
  content.placement.no_data = 0;
  content.has_normals = true;
  content.colors.clear();
  content.fields = {};
  content.notes.insert (content.notes.end(), mesh.notes.begin(), mesh.notes.end());
  content.notes.push_back (
      std::to_string (mesh.faces.size()) + " faces were sampled evenly, " +
      shown (spacing) + " apart" +
      (is_asked ? "" : ", as vertices alone do not tell what is between them") +
      ": labels and lines belong to " + std::to_string (samples.positions.size()) +
      " samples, not to the " + std::to_string (vertices) +
      " vertices of the file (-sample off takes these).");
  if (!is_asked && detail.isFinerThanSamples())
    content.notes.push_back ("Some features are only " + shown (detail.feature_width) +
                             " wide, and need a spacing of a fourth of that for all of "
                             "their edges (-sample).");
  return {mesh.faces.size(), spacing, sides_agree};
}

} // namespace crest
} // namespace pcl
