// SPDX-License-Identifier: BSD-3-Clause
// What pictures show, pixel by pixel. Needs an X display.
#include <pcl_crest/visualization/crest_scene.h>
#include <pcl_crest/visualization/view.h>

#include <gtest/gtest.h>

#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkRenderWindow.h>

#include "support/picture.h"

using namespace oracle;
using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

std::string
render (const CrestScene& scene, const View& view)
{
  setCamera (view, *scene.getRenderer()->GetActiveCamera());
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering (1);
  window->SetSize (view.window_size.x(), view.window_size.y());
  window->AddRenderer (scene.getRenderer());
  std::string png = renderPicture (*window);
  window->RemoveRenderer (scene.getRenderer());
  return png;
}

} // namespace

TEST (CrestScene, ShowsTheSurfaceGreyAndWithoutHoles)
{
  const Cloud::Ptr cloud = waves();
  const View view = fitView (*cloud, {SIZE, SIZE});
  CrestScene scene;
  scene.setCloud (cloud);
  const Picture picture (render (scene, view));
  ASSERT_EQ (picture.width(), SIZE);
  ASSERT_EQ (picture.height(), SIZE);
  for (const int x : {0, SIZE - 1})
    for (const int y : {0, SIZE - 1})
      EXPECT_TRUE (isWhite (picture (x, y)));
  const Eigen::Vector2i low = project (view, {-0.88, -0.88, -0.1}).cast<int>();
  const Eigen::Vector2i high = project (view, {0.88, 0.88, -0.1}).cast<int>();
  int shades[256] = {};
  for (int y = low.y(); y <= high.y(); ++y)
    for (int x = low.x(); x <= high.x(); ++x) {
      ASSERT_TRUE (isGrey (picture (x, y))) << x << " " << y;
      ++shades[picture (x, y)[0]];
    }
  EXPECT_GT (256 - std::count (shades, shades + 256, 0), 30) << "it should be shaded";
}

TEST (CrestScene, PicksOnlyLinesThatAreSeen)
{
  const Cloud::Ptr cloud = waves();
  CrestLine ridge;
  ridge.type = CrestType::RIDGE;
  ridge.polylines = {{}};
  for (index_t column = 10; column < 140; ++column)
    ridge.polylines[0].push_back (50 * 150 + column);
  const Eigen::Vector3f left = (*cloud)[50 * 150 + 40].getVector3fMap();
  const Eigen::Vector3f right = (*cloud)[50 * 150 + 110].getVector3fMap();
  // A second sheet half a unit above covers the left half.
  const Cloud lower = *cloud;
  for (pcl::PointNormal point : lower)
    if (point.x < 0.0F) {
      point.z += 0.5F;
      cloud->push_back (point);
    }
  const View view = fitView (*cloud, {SIZE, SIZE});
  CrestScene scene;
  scene.setCloud (cloud);
  scene.setLines ({ridge});
  setCamera (view, *scene.getRenderer()->GetActiveCamera());
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering (1);
  window->SetSize (SIZE, SIZE);
  window->AddRenderer (scene.getRenderer());
  window->Render();
  const auto pick = [&] (const Eigen::Vector3f& point) {
    const Eigen::Vector2i at = project (view, point.cast<double>()).cast<int>();
    return scene.pickLine (at.x(), at.y());
  };
  ASSERT_LT (left.x(), -0.1F);
  ASSERT_GT (right.x(), 0.1F);
  EXPECT_EQ (pick (left), -1);
  EXPECT_EQ (pick (right), 0);
  scene.setLinesVisible (false);
  window->Render();
  EXPECT_EQ (pick (right), -1);
  window->RemoveRenderer (scene.getRenderer());
}

TEST (CrestScene, ShowsLinesInTheirColorsUntilOthersAreSet)
{
  const Cloud::Ptr cloud = waves();
  CrestLine ridge, valley;
  ridge.type = CrestType::RIDGE;
  valley.type = CrestType::VALLEY;
  // Rows of the grid: the ridge below the middle, the valley above it.
  ridge.polylines = {{}, {}};
  valley.polylines = {{}};
  for (index_t column = 10; column < 140; ++column) {
    ridge.polylines[column < 75 ? 0 : 1].push_back (50 * 150 + column);
    valley.polylines[0].push_back (100 * 150 + column);
  }
  const View view = fitView (*cloud, {SIZE, SIZE});
  CrestScene scene;
  scene.setCloud (cloud);
  scene.setLines ({ridge, valley});
  const Picture picture (render (scene, view));
  const auto place = [&] (index_t index) {
    return project (view, (*cloud)[index].getVector3fMap().cast<double>());
  };
  for (const auto& polyline : ridge.polylines)
    for (const index_t index : polyline)
      EXPECT_TRUE (isNear (picture, place (index), 1, isBlue)) << index;
  for (const index_t index : valley.polylines[0])
    EXPECT_TRUE (isNear (picture, place (index), 1, isRed)) << index;
  for (int y = 0; y < SIZE; ++y)
    for (int x = 0; x < SIZE; ++x) {
      EXPECT_FALSE (isBlue (picture (x, y)) && y > SIZE / 2);
      EXPECT_FALSE (isRed (picture (x, y)) && y < SIZE / 2);
    }

  scene.setLines ({});
  const Picture without (render (scene, view));
  EXPECT_EQ (count (without, isBlue) + count (without, isRed), 0);
}

TEST (CrestScene, HidesLinesOnTheFarSide)
{
  // Rings of points on a sphere: ring r at the polar angle pi r / RINGS from +z.
  constexpr int RINGS = 100, PER_RING = 200;
  Cloud::Ptr sphere (new Cloud);
  CrestLine near_line, far_line;
  near_line.type = CrestType::VALLEY;
  far_line.type = CrestType::RIDGE;
  near_line.polylines = far_line.polylines = {{}};
  for (int ring = 1; ring < RINGS; ++ring)
    for (int i = 0; i < PER_RING; ++i) {
      const double polar = M_PI * ring / RINGS, turn = 2.0 * M_PI * i / PER_RING;
      const Eigen::Vector3f normal (
          static_cast<float> (std::sin (polar) * std::cos (turn)),
          static_cast<float> (std::sin (polar) * std::sin (turn)),
          static_cast<float> (std::cos (polar)));
      pcl::PointNormal point;
      point.getVector3fMap() = point.getNormalVector3fMap() = normal;
      if (ring == 20 || ring == 80)
        (ring == 20 ? near_line : far_line)
            .polylines[0]
            .push_back (static_cast<index_t> (sphere->size()));
      sphere->push_back (point);
    }
  CrestScene scene;
  scene.setCloud (sphere);
  scene.setLines ({near_line, far_line});
  View view = fitView (*sphere, {SIZE, SIZE});
  const auto shown = [&] (const CrestLine& line,
                          const Picture& picture,
                          PixelTest& color) {
    int drawn = 0;
    for (const index_t index : line.polylines[0])
      drawn += isNear (picture,
                       project (view, (*sphere)[index].getVector3fMap().cast<double>()),
                       1,
                       color);
    return drawn;
  };
  const Picture front (render (scene, view));
  EXPECT_EQ (shown (near_line, front, isRed), PER_RING);
  EXPECT_EQ (count (front, isBlue), 0);

  view.position = 2.0 * view.focal_point - view.position;
  const Picture back (render (scene, view));
  EXPECT_EQ (shown (far_line, back, isBlue), PER_RING);
  EXPECT_EQ (count (back, isRed), 0);

  scene.getRenderer()->GetActiveCamera()->ParallelProjectionOn();
  const Picture parallel (render (scene, view));
  EXPECT_GT (count (parallel, isBlue), PER_RING);
  EXPECT_EQ (count (parallel, isRed), 0);
}

/** The points and polygons that are drawn. */
vtkIdType
drawnCells (vtkRenderer& renderer)
{
  vtkIdType cells = 0;
  vtkPropCollection* const props = renderer.GetViewProps();
  props->InitTraversal();
  while (vtkProp* const prop = props->GetNextProp()) {
    auto* const actor = dynamic_cast<vtkActor*> (prop);
    if (actor == nullptr || actor->GetVisibility() == 0)
      continue;
    auto* const data =
        dynamic_cast<vtkPolyDataMapper*> (actor->GetMapper())->GetInput();
    cells += data->GetNumberOfVerts() + data->GetNumberOfPolys();
  }
  return cells;
}

// VTK's styles ask for 15 pictures a second or more while the mouse turns the view.
TEST (CrestScene, DrawsFewOfManyPointsWhileItMoves)
{
  constexpr int SIDE = 600;
  const Cloud::Ptr cloud (new Cloud);
  for (int row = 0; row < SIDE; ++row)
    for (int column = 0; column < SIDE; ++column)
      cloud->push_back ({static_cast<float> (column),
                         static_cast<float> (row),
                         0.0F,
                         0.0F,
                         0.0F,
                         1.0F});
  CrestScene scene;
  scene.setPoints (cloud);
  setCamera (fitView (*cloud, {SIZE, SIZE}), *scene.getRenderer()->GetActiveCamera());
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering (1);
  window->SetSize (SIZE, SIZE);
  window->AddRenderer (scene.getRenderer());
  window->SetDesiredUpdateRate (15.0);
  // They still cover most of what all do.
  const Picture few (renderPicture (*window));
  EXPECT_LE (drawnCells (*scene.getRenderer()), 300000);
  window->SetDesiredUpdateRate (0.0001);
  const Picture all (renderPicture (*window));
  EXPECT_EQ (SIDE * SIDE, drawnCells (*scene.getRenderer()));
  const int white = count (all, isWhite);
  EXPECT_LT (count (few, isWhite), white + (SIZE * SIZE - white) / 4);
  scene.setSurfaceVisible (false);
  window->SetDesiredUpdateRate (15.0);
  window->Render();
  EXPECT_EQ (0, drawnCells (*scene.getRenderer()));
  window->RemoveRenderer (scene.getRenderer());
}

TEST (CrestScene, ShowsPointsBeforeTheirSurface)
{
  const Cloud::Ptr cloud = waves();
  CrestScene scene;
  scene.setPoints (cloud);
  const View view = fitView (*cloud, {SIZE, SIZE});
  const Picture dots (render (scene, view));
  scene.setCloud (cloud);
  const Picture surface (render (scene, view));
  const int drawn = SIZE * SIZE - count (dots, isWhite);
  EXPECT_GT (drawn, 5000);
  EXPECT_GE (SIZE * SIZE - count (surface, isWhite), drawn);
}
