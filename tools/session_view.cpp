// SPDX-License-Identifier: BSD-3-Clause
#include "session_view.h"

#include <vtkLookupTable.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include "direction_strokes.h"

namespace pcl {
namespace crest {

SessionView::SessionView (const ViewOptions& options)
: chart_ (scene_.getRenderer()), mode_ (options.color), directions_ (options.directions)
{
  const Eigen::Vector3d& background = options.background;
  scene_.getRenderer()->SetBackground (background.x(), background.y(), background.z());
  scene_.setPointSize (options.point_size);
  scene_.setOpacity (options.opacity);
  scene_.setLineWidth (options.line_width);
  scene_.setAxes (options.axes);
  chart_.setVisible (options.chart);

  bar_->SetNumberOfLabels (5);
  bar_->SetPosition (0.9, 0.1);
  bar_->SetWidth (0.08);
  bar_->SetHeight (0.4);
  bar_->UnconstrainedFontSizeOn();
  // Over the points, too, it can be read, and they can be seen behind it.
  constexpr double BAR_OPACITY = 0.6;
  bar_->DrawBackgroundOn();
  bar_->GetBackgroundProperty()->SetColor (
      background.x(), background.y(), background.z());
  bar_->GetBackgroundProperty()->SetOpacity (BAR_OPACITY);
  bar_->SetVerticalTitleSeparation (8);
  bar_->SetLabelFormat ("%-.3g");
  Eigen::Vector3d ink = inkOn (background);
  for (vtkTextProperty* const property :
       {bar_->GetLabelTextProperty(), bar_->GetTitleTextProperty()}) {
    property->SetColor (ink.data());
    property->SetFontSize (14);
    property->BoldOff();
    property->ItalicOff();
    property->ShadowOff();
    property->SetBackgroundColor (background.x(), background.y(), background.z());
    property->SetBackgroundOpacity (BAR_OPACITY);
  }
  bar_->VisibilityOff();
  scene_.getRenderer()->AddActor (bar_);
}

void
SessionView::show (const CrestSession& session, const SurfaceSplats& splats)
{
  session_ = &session;
  scene_.setCloud (session.getCloud().points, splats);
  setDirectionsVisible (directions_);
  recolor();
  update();
}

void
SessionView::update()
{
  const Parameters& parameters = session_->getParameters();
  scene_.setLines (session_->getLines(), session_->getLineCloud());
  chart_.setSizes (session_->getStatistics().line_sizes,
                   {minSize (parameters, CrestType::RIDGE),
                    minSize (parameters, CrestType::VALLEY)});
  if (mode_ == ColorMode::LABEL)
    recolor();
}

void
SessionView::highlight (int line)
{
  std::vector<CrestLine> lines;
  if (line >= 0)
    lines.push_back (session_->getLines()[static_cast<std::size_t> (line)]);
  scene_.setHighlight (lines, session_->getLineCloud());
}

bool
SessionView::setColorMode (ColorMode mode)
{
  if (mode == ColorMode::FILE && session_->getCloud().colors.empty())
    return false;
  mode_ = mode;
  recolor();
  return true;
}

void
SessionView::setDirectionsVisible (bool visible)
{
  directions_ = visible;
  scene_.setStrokes (visible ? makeDirectionStrokes (*session_).Get() : nullptr);
}

void
SessionView::recolor()
{
  const PointColors colors = colorPoints (*session_, mode_);
  // A photograph has its light already.
  scene_.setColors (colors.colors, mode_ != ColorMode::FILE);
  bar_->SetVisibility (colors.largest > 0.0);
  bar_->SetTitle (colors.title.c_str());
  constexpr int SHADES = 64;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues (SHADES);
  for (int i = 0; i < SHADES; ++i) {
    const CrestScene::Color color = colorOf (2.0 * i / (SHADES - 1) - 1.0);
    table->SetTableValue (i, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  }
  table->SetTableRange (-colors.largest, colors.largest);
  bar_->SetLookupTable (table);
}

} // namespace crest
} // namespace pcl
