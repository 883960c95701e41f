// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/surface_splats.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "surface/neighbor_search.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** In a square grid the eighth neighbour is a diagonal away, and a corner of a cell is
 * half a diagonal from its points; the rest is margin for uneven sampling and for the
 * sides of a polygon, which are nearer than its corners. */
constexpr int NEIGHBORS = 8;
constexpr float REACH = 0.87f;
constexpr int CORNERS = 6;
/** A splat this many times as large as the median would be a stray point's. */
constexpr float LARGEST = 3.0f;

struct Oriented {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
};

/** Moves a corner of the splat of `point` along its normal to where the tangent planes
 * of the neighbours on the same sheet are, the nearest counting most; no farther than a
 * smooth surface would, lest splats at sharp edges grow thorns. */
Oriented
onSurface (const OrientedPoints& points,
           std::size_t point,
           const std::vector<index_t>& neighbors,
           const Eigen::Vector3f& corner,
           float radius)
{
  const Eigen::Vector3f& axis = points.normals[point];
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float height = 0.0f, weights = 0.0f;
  for (const index_t neighbor : neighbors) {
    const float facing = axis.dot (points.normals[neighbor]);
    if (facing < 0.5f)
      continue;
    const Eigen::Vector3f offset = points.positions[neighbor] - corner;
    const float weight = std::exp (-2.0f * offset.squaredNorm() / (radius * radius));
    normal += weight * points.normals[neighbor];
    height += weight * offset.dot (points.normals[neighbor]) / facing;
    weights += weight;
  }
  height = std::clamp (height / weights, -0.4f * radius, 0.4f * radius);
  return {corner + axis * height, normal.normalized()};
}

float
median (std::vector<float> values)
{
  if (values.empty())
    return 0.0f;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t> (values.size() / 2);
  std::nth_element (values.begin(), middle, values.end());
  return *middle;
}

using Neighborhoods = std::vector<std::vector<index_t>>;

Neighborhoods
findNeighborhoods (const OrientedPoints& points)
{
  const NeighborSearch search =
      batchedSearch (treeOver (points.positions, 0), NEIGHBORS + 1);
  Neighborhoods neighborhoods (points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    search (static_cast<index_t> (i), neighborhoods[i]);
  return neighborhoods;
}

std::vector<float>
splatRadii (const OrientedPoints& points, const Neighborhoods& neighborhoods)
{
  std::vector<float> radii (points.size(), 0.0f);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const index_t neighbor : neighborhoods[i])
      radii[i] = std::max (
          radii[i], REACH * (points.positions[neighbor] - points.positions[i]).norm());
  const float largest = LARGEST * median (radii);
  for (float& radius : radii)
    radius = std::min (radius, largest);
  return radii;
}

} // namespace

std::shared_ptr<const SurfaceSplats>
makeSurfaceSplats (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  const auto result = std::make_shared<SurfaceSplats>();
  SurfaceSplats& splats = *result;
  splats.polygons = vtkSmartPointer<vtkPolyData>::New();
  const OrientedPoints points =
      packOrientedPoints ({&cloud.points.data()->x,
                           &cloud.points.data()->normal_x,
                           sizeof (PointNormal) / sizeof (float),
                           cloud.size()});
  // A single point has no spacing to take its size from.
  if (points.size() < 2)
    return result;
  const Neighborhoods neighborhoods = findNeighborhoods (points);
  const std::vector<float> radii = splatRadii (points, neighborhoods);

  vtkNew<vtkPoints> corners;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents (3);
  vtkNew<vtkCellArray> polygons;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f u = points.normals[i].unitOrthogonal();
    const Eigen::Vector3f v = points.normals[i].cross (u);
    polygons->InsertNextCell (CORNERS);
    for (int corner = 0; corner < CORNERS; ++corner) {
      const float angle = 2.0f * static_cast<float> (M_PI) * corner / CORNERS;
      const Eigen::Vector3f direction = std::cos (angle) * u + std::sin (angle) * v;
      const Oriented placed = onSurface (points,
                                         i,
                                         neighborhoods[i],
                                         points.positions[i] + radii[i] * direction,
                                         radii[i]);
      polygons->InsertCellPoint (corners->InsertNextPoint (placed.position.data()));
      normals->InsertNextTuple (placed.normal.data());
    }
  }
  splats.polygons->SetPoints (corners);
  splats.polygons->SetPolys (polygons);
  splats.polygons->GetPointData()->SetNormals (normals);
  splats.points = points.cloud_index;
  splats.radius = median (radii);
  return result;
}

} // namespace crest
} // namespace pcl
