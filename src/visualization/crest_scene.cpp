// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/visualization/crest_scene.h>

#include <pcl/common/point_tests.h>

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include "io/crest_colors.h"
#include "visualization/surface_splats.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

namespace {

constexpr double NOWHERE = std::numeric_limits<double>::infinity();
constexpr double LINE_WIDTH = 2.5;
constexpr double GREY = 0.85;
constexpr double DOT_GREY = 0.6;
constexpr double GREEN[] = {0.0, 0.45, 0.2};
constexpr double YELLOW[] = {1.0, 0.7, 0.0};
/** Points that any machine draws several times while a frame is on the screen. */
constexpr std::size_t MOST_MOVING = 300000;
/** Pictures a second from which on a window has to be fast: VTK asks for 15 or more
 * while the mouse turns the view, for less than one when it rests. */
constexpr double MOVING_RATE = 1.0;

/** One light from the upper left, as on maps and in drawings, so that relief shows when
 * it is looked at from straight above; and one from the camera, so that no side is
 * dark.
 */
void
addLights (vtkRenderer& renderer)
{
  renderer.AutomaticLightCreationOff();
  vtkNew<vtkLight> key;
  key->SetLightTypeToCameraLight();
  key->SetPosition (-0.8, 1.0, 1.6);
  key->SetIntensity (0.45);
  renderer.AddLight (key);
  vtkNew<vtkLight> fill;
  fill->SetLightTypeToHeadlight();
  fill->SetIntensity (0.6);
  renderer.AddLight (fill);
}

vtkPolyData*
dataOf (vtkActor* actor)
{
  return vtkPolyDataMapper::SafeDownCast (actor->GetMapper())->GetInput();
}

void
setDataOf (vtkActor* actor, vtkPolyData* data)
{
  vtkPolyDataMapper::SafeDownCast (actor->GetMapper())->SetInputData (data);
}

/** \brief How far from the eye's plane a depth of the window's buffer is. */
double
eyeDistance (vtkCamera& camera, double depth)
{
  std::array<double, 2> range{};
  camera.GetClippingRange (range.data());
  const auto [near, far] = range;
  return camera.GetParallelProjection() != 0
             ? near + depth * (far - near)
             : near * far / (far - depth * (far - near));
}

/** \brief A vertex for each of some points. */
vtkSmartPointer<vtkPolyData>
makeDots (const pcl::PointCloud<pcl::PointNormal>& cloud,
          const std::vector<index_t>& drawn)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  for (const index_t index : drawn) {
    vertices->InsertNextCell (1);
    vertices->InsertCellPoint (points->InsertNextPoint (cloud[index].data));
  }
  auto dots = vtkSmartPointer<vtkPolyData>::New();
  dots->SetPoints (points);
  dots->SetVerts (vertices);
  return dots;
}

} // namespace

vtkSmartPointer<vtkPolyData>
makeLinePolyData (const pcl::PointCloud<pcl::PointNormal>& cloud,
                  const std::vector<CrestLine>& lines)
{
  vtkIdType polylines = 0;
  vtkIdType places = 0;
  for (const CrestLine& line : lines)
    for (const std::vector<index_t>& polyline : line.polylines) {
      ++polylines;
      places += static_cast<vtkIdType> (polyline.size());
    }
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents (3);
  coordinates->SetNumberOfTuples (places);
  float* next = coordinates->GetPointer (0);
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact (polylines, places);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents (3);
  vtkIdType place = 0;
  for (const CrestLine& line : lines)
    for (const std::vector<index_t>& polyline : line.polylines) {
      cells->InsertNextCell (static_cast<int> (polyline.size()));
      for (const index_t index : polyline) {
        next = std::copy_n (cloud[index].data, 3, next);
        cells->InsertCellPoint (place++);
      }
      colors->InsertNextTypedTuple (colorOf (line.type).data());
    }
  vtkNew<vtkPoints> points;
  points->SetData (coordinates);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints (points);
  data->SetLines (cells);
  data->GetCellData()->SetScalars (colors);
  return data;
}

CrestScene::CrestScene() : cloud_ (new pcl::PointCloud<pcl::PointNormal>)
{
  renderer_->SetBackground (1.0, 1.0, 1.0);
  addLights (*renderer_);
  for (vtkActor* actor : {surface_.Get(),
                          dots_.Get(),
                          coarse_.Get(),
                          strokes_.Get(),
                          lines_.Get(),
                          highlight_.Get()}) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData (vtkNew<vtkPolyData>());
    actor->SetMapper (mapper);
    renderer_->AddActor (actor);
  }
  surface_->GetProperty()->SetColor (GREY, GREY, GREY);
  // Light would leave those that face away black.
  for (vtkActor* actor : {dots_.Get(), coarse_.Get()}) {
    actor->GetProperty()->SetColor (DOT_GREY, DOT_GREY, DOT_GREY);
    actor->GetProperty()->LightingOff();
  }
  strokes_->GetProperty()->SetColor (GREEN[0], GREEN[1], GREEN[2]);
  strokes_->GetProperty()->LightingOff();
  axes_->AxisLabelsOff();
  axes_->SetConeRadius (0.15);
  renderer_->AddActor (axes_);
  setAxes (0.0);
  choose();
  setLineWidth (LINE_WIDTH);
  lines_->GetProperty()->LightingOff();
  highlight_->GetProperty()->SetColor (YELLOW[0], YELLOW[1], YELLOW[2]);
  highlight_->GetProperty()->LightingOff();
  highlight_->GetMapper()->ScalarVisibilityOff();
  observer_ =
      renderer_->AddObserver (vtkCommand::StartEvent, this, &CrestScene::prepare);
}

CrestScene::~CrestScene() { renderer_->RemoveObserver (observer_); }

void
CrestScene::setCloud (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud)
{
  setCloud (cloud, *makeSurfaceSplats (*cloud));
}

void
CrestScene::setCloud (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud,
                      const SurfaceSplats& splats)
{
  cloud_ = cloud;
  lift_ = splats.radius;
  drawn_ = splats.points;
  setDataOf (surface_, splats.polygons);
  setDataOf (dots_, makeDots (*cloud, drawn_));
  coarse_step_ = 1 + drawn_.size() / MOST_MOVING;
  std::vector<index_t> few;
  for (std::size_t i = 0; coarse_step_ > 1 && i < drawn_.size(); i += coarse_step_)
    few.push_back (drawn_[i]);
  setDataOf (coarse_, makeDots (*cloud, few));
  setStrokes (nullptr);
  setLines ({});
  choose();
}

void
CrestScene::setPoints (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud)
{
  SurfaceSplats none;
  none.polygons = vtkSmartPointer<vtkPolyData>::New();
  // Enough to see what it is, and soon.
  constexpr std::size_t ENOUGH = 1000000;
  for (std::size_t i = 0; i < cloud->size(); i += 1 + cloud->size() / ENOUGH)
    if (pcl::isXYZFinite ((*cloud)[i]))
      none.points.push_back (static_cast<index_t> (i));
  setCloud (cloud, none);
}

void
CrestScene::setLines (const std::vector<CrestLine>& lines)
{
  setLines (lines, *cloud_);
}

void
CrestScene::setLines (const std::vector<CrestLine>& lines,
                      const pcl::PointCloud<pcl::PointNormal>& line_cloud)
{
  setDataOf (lines_, makeLinePolyData (line_cloud, lines));
  line_of_cell_.clear();
  for (std::size_t i = 0; i < lines.size(); ++i)
    line_of_cell_.insert (
        line_of_cell_.end(), lines[i].polylines.size(), static_cast<int> (i));
  setHighlight ({}, line_cloud);
}

void
CrestScene::setHighlight (const std::vector<CrestLine>& lines,
                          const pcl::PointCloud<pcl::PointNormal>& line_cloud)
{
  setDataOf (highlight_, makeLinePolyData (line_cloud, lines));
}

void
CrestScene::setColors (const std::vector<Color>& colors, bool shaded)
{
  vtkSmartPointer<vtkUnsignedCharArray> scalars;
  if (!colors.empty()) {
    scalars = vtkSmartPointer<vtkUnsignedCharArray>::New();
    scalars->SetNumberOfComponents (3);
    for (const index_t point : drawn_)
      scalars->InsertNextTypedTuple (colors[point].data());
  }
  for (vtkActor* actor : {surface_.Get(), dots_.Get()})
    dataOf (actor)->GetCellData()->SetScalars (scalars);
  vtkSmartPointer<vtkUnsignedCharArray> few;
  if (!colors.empty() && coarse_step_ > 1) {
    few = vtkSmartPointer<vtkUnsignedCharArray>::New();
    few->SetNumberOfComponents (3);
    for (std::size_t i = 0; i < drawn_.size(); i += coarse_step_)
      few->InsertNextTypedTuple (colors[drawn_[i]].data());
  }
  dataOf (coarse_)->GetCellData()->SetScalars (few);
  surface_->GetProperty()->SetLighting (shaded);
}

void
CrestScene::setPointSize (int pixels)
{
  point_size_ = pixels;
  choose();
}

void
CrestScene::setOpacity (double opacity)
{
  for (vtkActor* actor : {surface_.Get(), dots_.Get(), coarse_.Get()})
    actor->GetProperty()->SetOpacity (opacity);
}

void
CrestScene::setLineWidth (double pixels)
{
  lines_->GetProperty()->SetLineWidth (static_cast<float> (pixels));
  highlight_->GetProperty()->SetLineWidth (static_cast<float> (2.0 * pixels));
}

double
CrestScene::getLineWidth() const
{
  return lines_->GetProperty()->GetLineWidth();
}

void
CrestScene::setStrokes (vtkPolyData* strokes)
{
  setDataOf (strokes_, strokes != nullptr ? strokes : vtkNew<vtkPolyData>().Get());
}

void
CrestScene::setAxes (double length)
{
  if (length > 0.0)
    axes_->SetTotalLength (length, length, length);
  axes_->SetVisibility (length > 0.0);
}

void
CrestScene::setLinesVisible (bool visible)
{
  lines_->SetVisibility (visible);
  highlight_->SetVisibility (visible);
}

void
CrestScene::setSurfaceVisible (bool visible)
{
  surface_visible_ = visible;
  choose();
}

void
CrestScene::choose()
{
  vtkRenderWindow* const window = renderer_->GetRenderWindow();
  const bool is_coarse = coarse_step_ > 1 && window != nullptr &&
                         window->GetDesiredUpdateRate() >= MOVING_RATE;
  const bool has_surface =
      point_size_ == 0 && dataOf (surface_)->GetNumberOfCells() > 0;
  surface_->SetVisibility (surface_visible_ && !is_coarse && has_surface);
  dots_->SetVisibility (surface_visible_ && !is_coarse && !has_surface);
  coarse_->SetVisibility (surface_visible_ && is_coarse);
  dots_->GetProperty()->SetPointSize (static_cast<float> (std::max (1, point_size_)));
  // Few have to cover what many do.
  constexpr int LARGER = 2;
  coarse_->GetProperty()->SetPointSize (
      static_cast<float> (std::max (LARGER, point_size_)));
}

void
CrestScene::prepare()
{
  choose();
  liftLines();
}

int
CrestScene::pickLine (int x, int y)
{
  constexpr double REACH = 6.0;
  if (lines_->GetVisibility() == 0)
    return -1;
  liftLines();
  vtkNew<vtkMatrix4x4> to_view;
  vtkMatrix4x4::Multiply4x4 (
      renderer_->GetActiveCamera()->GetCompositeProjectionTransformMatrix (
          renderer_->GetTiledAspectRatio(), -1.0, 1.0),
      lines_->GetMatrix(),
      to_view);
  vtkPolyData* const lines = dataOf (lines_);
  const int* const size = renderer_->GetSize();
  const Eigen::Vector2d click (x, y);
  const auto project = [&] (vtkIdType point) {
    std::array<double, 4> p{0.0, 0.0, 0.0, 1.0};
    lines->GetPoint (point, p.data());
    to_view->MultiplyPoint (p.data(), p.data());
    // Behind the eye nothing is in view.
    if (p[3] <= 0.0)
      return Eigen::Vector3d (Eigen::Vector3d::Constant (NOWHERE));
    return Eigen::Vector3d (0.5 * size[0] * (1.0 + p[0] / p[3]),
                            0.5 * size[1] * (1.0 + p[1] / p[3]),
                            p[2] / p[3]);
  };
  const auto isCovered = [&] (const Eigen::Vector3d& p) {
    const auto pixel = [] (double at, int end) {
      return static_cast<int> (std::clamp (std::lround (at), 0L, end - 1L));
    };
    const double depth =
        renderer_->GetZ (pixel (p.x(), size[0]), pixel (p.y(), size[1]));
    vtkCamera& camera = *renderer_->GetActiveCamera();
    return eyeDistance (camera, 0.5 * (p.z() + 1.0)) >
           eyeDistance (camera, depth) + lift_;
  };

  // Of all lines seen within reach the one that is nearest to the eye.
  int picked = -1;
  double least_depth = 1.0;
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < lines->GetNumberOfCells(); ++cell) {
    lines->GetCellPoints (cell, points);
    Eigen::Vector3d end = project (points->GetId (0));
    for (vtkIdType i = 1; i < points->GetNumberOfIds(); ++i) {
      const Eigen::Vector3d start = end;
      end = project (points->GetId (i));
      if (start.z() == NOWHERE || end.z() == NOWHERE)
        continue;
      const Eigen::Vector2d way = (end - start).head<2>();
      const double along = way.squaredNorm() > 0.0
                               ? (click - start.head<2>()).dot (way) / way.squaredNorm()
                               : 0.0;
      const Eigen::Vector3d nearest =
          start + std::clamp (along, 0.0, 1.0) * (end - start);
      if ((nearest.head<2>() - click).norm() > REACH || nearest.z() >= least_depth ||
          nearest.z() < -1.0 || isCovered (nearest))
        continue;
      least_depth = nearest.z();
      picked = line_of_cell_[cell];
    }
  }
  return picked;
}

void
CrestScene::liftLines()
{
  vtkCamera* camera = renderer_->GetActiveCamera();
  const auto lift = [camera] (double by) {
    auto nearer = vtkSmartPointer<vtkMatrix4x4>::New();
    if (camera->GetParallelProjection()) {
      for (int axis = 0; axis < 3; ++axis)
        nearer->SetElement (axis, 3, -by * camera->GetDirectionOfProjection()[axis]);
    }
    else {
      // Scaling about the eye moves points along their rays only. From very near, the
      // lift is limited to a tenth of the way.
      const double scale = 1.0 - std::min (0.1, by / camera->GetDistance());
      for (int axis = 0; axis < 3; ++axis) {
        nearer->SetElement (axis, axis, scale);
        nearer->SetElement (axis, 3, (1.0 - scale) * camera->GetPosition()[axis]);
      }
    }
    return nearer;
  };
  const auto nearer = lift (lift_);
  lines_->SetUserMatrix (nearer);
  strokes_->SetUserMatrix (nearer);
  // In front of the line that it repeats.
  constexpr double ABOVE = 1.5;
  highlight_->SetUserMatrix (lift (ABOVE * lift_));
}

} // namespace crest
} // namespace pcl
