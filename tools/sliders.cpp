// SPDX-License-Identifier: BSD-3-Clause
#include "sliders.h"

#include <vtkCommand.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkTextProperty.h>

#include <sstream>

namespace pcl {
namespace crest {

namespace {

std::string
titleOf (const Threshold& threshold, const Parameters& parameters)
{
  std::ostringstream text;
  text.precision (6);
  text << threshold.title << ": " << threshold.get (parameters);
  return text.str();
}

vtkSmartPointer<vtkSliderRepresentation2D>
makeRepresentation (const Threshold& threshold,
                    const Parameters& parameters,
                    std::size_t row,
                    Eigen::Vector3d ink)
{
  constexpr double BOTTOM = 0.12, STEP = 0.085, LEFT = 0.02, RIGHT = 0.27;
  auto slider = vtkSmartPointer<vtkSliderRepresentation2D>::New();
  const Threshold& t = threshold;
  Parameters end;
  t.set (end, t.least);
  slider->SetMinimumValue (sliderPlace (t, end));
  t.set (end, t.most);
  slider->SetMaximumValue (sliderPlace (t, end));
  const double y = BOTTOM + STEP * static_cast<double> (row);
  for (const bool left : {true, false}) {
    vtkCoordinate* const point =
        left ? slider->GetPoint1Coordinate() : slider->GetPoint2Coordinate();
    point->SetCoordinateSystemToNormalizedDisplay();
    point->SetValue (left ? LEFT : RIGHT, y);
  }
  slider->SetSliderLength (0.02);
  slider->SetSliderWidth (0.03);
  slider->SetTubeWidth (0.006);
  slider->SetEndCapLength (0.0);
  slider->SetTitleHeight (0.018);
  slider->ShowSliderLabelOff();
  slider->GetSliderProperty()->SetColor (0.2, 0.2, 0.2);
  slider->GetTubeProperty()->SetColor (0.6, 0.6, 0.6);
  slider->GetTitleProperty()->SetColor (ink.data());
  // So that it can be read over the points, too.
  Eigen::Vector3d paper = Eigen::Vector3d::Ones() - ink;
  slider->GetTitleProperty()->SetBackgroundColor (paper.data());
  slider->GetTitleProperty()->SetBackgroundOpacity (0.7);
  slider->GetTitleProperty()->BoldOff();
  slider->GetTitleProperty()->ItalicOff();
  slider->GetTitleProperty()->ShadowOff();
  slider->SetValue (sliderPlace (t, parameters));
  slider->SetTitleText (titleOf (t, parameters).c_str());
  return slider;
}

} // namespace

void
drawSliders (const std::vector<Threshold>& thresholds,
             const Parameters& parameters,
             const Eigen::Vector3d& ink,
             vtkRenderer& renderer)
{
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    const auto slider = makeRepresentation (thresholds[i], parameters, i, ink);
    slider->SetRenderer (&renderer);
    renderer.AddViewProp (slider);
  }
}

Sliders::Sliders (vtkRenderWindowInteractor* interactor,
                  std::vector<Threshold> thresholds,
                  const Parameters& parameters,
                  const Eigen::Vector3d& ink,
                  Moved moved)
: thresholds_ (std::move (thresholds))
, moved_ (std::move (moved))
, parameters_ (parameters)
{
  for (std::size_t i = 0; i < thresholds_.size(); ++i) {
    const auto slider = makeRepresentation (thresholds_[i], parameters_, i, ink);
    auto widget = vtkSmartPointer<vtkSliderWidget>::New();
    widget->SetInteractor (interactor);
    widget->SetRepresentation (slider);
    widget->SetAnimationModeToJump();
    widget->EnabledOn();
    for (const auto event :
         {vtkCommand::InteractionEvent, vtkCommand::EndInteractionEvent})
      widget->AddObserver (event, this, &Sliders::dragged);
    widgets_.push_back (widget);
  }
}

Sliders::~Sliders()
{
  for (vtkSliderWidget* const widget : widgets_) {
    widget->RemoveAllObservers();
    widget->EnabledOff();
  }
}

void
Sliders::setParameters (const Parameters& parameters)
{
  parameters_ = parameters;
  for (std::size_t i = 0; i < widgets_.size(); ++i) {
    auto* const slider =
        dynamic_cast<vtkSliderRepresentation*> (widgets_[i]->GetRepresentation());
    slider->SetValue (sliderPlace (thresholds_[i], parameters));
    slider->SetTitleText (titleOf (thresholds_[i], parameters).c_str());
  }
}

void
Sliders::dragged (vtkObject* widget, unsigned long event, void*)
{
  for (std::size_t i = 0; i < widgets_.size(); ++i) {
    if (widgets_[i] != widget)
      continue;
    const Threshold& threshold = thresholds_[i];
    const double place =
        dynamic_cast<vtkSliderRepresentation*> (widgets_[i]->GetRepresentation())
            ->GetValue();
    takeSliderPlace (threshold, place, parameters_);
    dynamic_cast<vtkSliderRepresentation*> (widgets_[i]->GetRepresentation())
        ->SetTitleText (titleOf (threshold, parameters_).c_str());
    if (event == vtkCommand::EndInteractionEvent || threshold.only_filters || fast_)
      moved_ (threshold, place);
  }
}

} // namespace crest
} // namespace pcl
