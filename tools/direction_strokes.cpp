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
  constexpr index_t MOST = 3000;
  // Of the distance to the next cross.
  constexpr float LONG_BAR = 0.7F;
  constexpr float SHORT_BAR = 0.3F;

  const SurfaceAnalysis& analysis = session.getAnalysis();
  vtkNew<vtkPoints> ends;
  vtkNew<vtkCellArray> strokes;
  const index_t step = analysis.size() / MOST + 1;
  for (index_t i = 0; i < analysis.size(); i += step) {
    const Sample sample = analysis.sample (i);
    const PrincipalCurvature& curvature = sample.curvature;
    if (!curvature.valid)
      continue;
    const float distance = sample.spacing * std::sqrt (static_cast<float> (step));
    const auto add = [&] (const Eigen::Vector3f& along) {
      strokes->InsertNextCell (2);
      for (const float side : {-0.5F, 0.5F}) {
        const Eigen::Vector3f end = sample.position + side * along;
        strokes->InsertCellPoint (ends->InsertNextPoint (end.data()));
      }
    };
    add (LONG_BAR * distance * curvature.t1);
    add (SHORT_BAR * distance * sample.normal.cross (curvature.t1).normalized());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints (ends);
  data->SetLines (strokes);
  return data;
}

} // namespace crest
} // namespace pcl
