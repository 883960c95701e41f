// SPDX-License-Identifier: BSD-3-Clause
#include "direction_strokes.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <cmath>

namespace pcl {
namespace crest {

vtkSmartPointer<vtkPolyData>
makeDirectionStrokes (const CrestSession& session)
{
  constexpr std::size_t MOST = 3000;
  // Of the distance to the next cross.
  constexpr float LONG_BAR = 0.7F;
  constexpr float SHORT_BAR = 0.3F;

  const OrientedPoints& points = session.getPoints();
  const SurfaceShape& shape = session.getShape();
  vtkNew<vtkPoints> ends;
  vtkNew<vtkCellArray> strokes;
  // Packed points are in spatial order: every n-th are spread over the surface.
  const std::size_t step = points.size() / MOST + 1;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const PrincipalCurvature& curvature = shape.curvature[i];
    if (!curvature.valid)
      continue;
    const float distance =
        shape.graph.spacing[i] * std::sqrt (static_cast<float> (step));
    const auto add = [&] (const Eigen::Vector3f& along) {
      strokes->InsertNextCell (2);
      for (const float side : {-0.5F, 0.5F}) {
        const Eigen::Vector3f end = points.positions[i] + side * along;
        strokes->InsertCellPoint (ends->InsertNextPoint (end.data()));
      }
    };
    add (LONG_BAR * distance * curvature.t1);
    add (SHORT_BAR * distance * points.normals[i].cross (curvature.t1).normalized());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints (ends);
  data->SetLines (strokes);
  return data;
}

} // namespace crest
} // namespace pcl
