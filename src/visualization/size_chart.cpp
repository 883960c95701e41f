// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/visualization/size_chart.h>

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkCommand.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace pcl {
namespace crest {

namespace {

constexpr std::size_t MOST_BARS = 30;
/** the part of the renderer's width and height that the chart takes */
constexpr double PART = 0.38;

/** \brief Columns of a table, all of one length. */
vtkDoubleArray*
addColumn (vtkTable& table, const char* name, std::size_t rows)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName (name);
  column->SetNumberOfValues (static_cast<vtkIdType> (rows));
  column->FillValue (0.0);
  table.AddColumn (column);
  return column;
}

std::size_t
largest (const LineSizes& sizes)
{
  return sizes.empty() ? 0 : sizes.rbegin()->first;
}

void
setTitle (vtkAxis& axis, const char* title)
{
  axis.SetTitle (title);
  axis.GetTitleProperties()->BoldOff();
}

} // namespace

SizeChart::SizeChart (vtkRenderer* renderer) : renderer_ (renderer)
{
  chart_->SetAutoSize (false);
  background_->GetBrush()->SetColor (255, 255, 255, 255);
  background_->GetPen()->SetLineType (vtkPen::NO_PEN);
  vtkAxis& across = *chart_->GetAxis (vtkAxis::BOTTOM);
  setTitle (across, "points on a line");
  across.SetBehavior (vtkAxis::FIXED);
  actor_->GetScene()->AddItem (background_);
  actor_->GetScene()->AddItem (chart_);
  actor_->VisibilityOff();
  renderer_->AddActor (actor_);
  observer_ = renderer_->AddObserver (vtkCommand::StartEvent, this, &SizeChart::place);
}

SizeChart::~SizeChart()
{
  renderer_->RemoveObserver (observer_);
  renderer_->RemoveActor (actor_);
}

void
SizeChart::setSizes (const PerType<LineSizes>& sizes, const PerType<int>& min_size)
{
  sizes_ = sizes;
  min_size_ = min_size;
  draw();
}

void
SizeChart::setLogarithmic (bool logarithmic)
{
  logarithmic_ = logarithmic;
  draw();
}

void
SizeChart::setVisible (bool visible)
{
  actor_->SetVisibility (visible);
}

bool
SizeChart::isVisible() const
{
  return actor_->GetVisibility() != 0;
}

void
SizeChart::draw()
{
  const std::size_t longest =
      std::max<std::size_t> ({largest (sizes_.ridge), largest (sizes_.valley), 1});
  const std::size_t width = longest / MOST_BARS + 1;
  const std::size_t bars = longest / width + 1;
  vtkNew<vtkTable> table;
  vtkDoubleArray* const middles = addColumn (*table, "size", bars);
  const std::array<vtkDoubleArray*, 2> counts{addColumn (*table, "ridges", bars),
                                              addColumn (*table, "valleys", bars)};
  for (std::size_t bar = 0; bar < bars; ++bar)
    middles->SetValue (static_cast<vtkIdType> (bar),
                       static_cast<double> (width) * (static_cast<double> (bar) + 0.5));
  double most = 0.0;
  for (const CrestType type : CREST_TYPES) {
    vtkDoubleArray& column = *counts[type == CrestType::RIDGE ? 0 : 1];
    for (const auto& [size, lines] : sizes_[type]) {
      const auto bar = static_cast<vtkIdType> (size / width);
      column.SetValue (bar, column.GetValue (bar) + static_cast<double> (lines));
    }
    for (vtkIdType bar = 0; bar < column.GetNumberOfValues(); ++bar) {
      // One line has to show, too, which a logarithm of counts would draw as nothing.
      if (logarithmic_)
        column.SetValue (bar, std::log10 (1.0 + column.GetValue (bar)));
      most = std::max (most, column.GetValue (bar));
    }
  }

  chart_->ClearPlots();
  for (const int type : {1, 2}) {
    vtkPlot* const plot = chart_->AddPlot (vtkChart::BAR);
    plot->SetInputData (table, 0, type);
    plot->SetColor (
        type == 1 ? 10 : 220, type == 1 ? 40 : 15, type == 1 ? 220 : 15, 255);
    plot->GetPen()->SetLineType (vtkPen::NO_PEN);
  }
  for (const int cut : std::set<int>{min_size_.ridge, min_size_.valley}) {
    vtkNew<vtkTable> line;
    vtkDoubleArray* const x = addColumn (*line, "S", 2);
    vtkDoubleArray* const y = addColumn (*line, "cut", 2);
    x->FillValue (cut);
    y->SetValue (1, std::max (most, 1.0));
    vtkPlot* const plot = chart_->AddPlot (vtkChart::LINE);
    plot->SetInputData (line, 0, 1);
    plot->SetColor (0, 0, 0, 255);
    plot->SetWidth (2.0F);
  }
  setTitle (*chart_->GetAxis (vtkAxis::LEFT),
            logarithmic_ ? "log10 (1 + lines)" : "lines");
  chart_->GetAxis (vtkAxis::BOTTOM)
      ->SetRange (
          0.0,
          std::max<double> (static_cast<double> (bars * width),
                            1.05 * std::max (min_size_.ridge, min_size_.valley)));
  chart_->RecalculateBounds();
}

void
SizeChart::place()
{
  const int* const size = renderer_->GetSize();
  std::array<float, 4> corner{static_cast<float> ((1.0 - PART) * size[0]),
                              static_cast<float> ((1.0 - PART) * size[1]),
                              static_cast<float> (PART * size[0]),
                              static_cast<float> (PART * size[1])};
  background_->SetDimensions (corner.data());
  chart_->SetSize (vtkRectf (corner[0], corner[1], corner[2], corner[3]));
}

} // namespace crest
} // namespace pcl
