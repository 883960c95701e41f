// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkRenderWindowInteractor.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>

#include "thresholds.h"

namespace pcl {
namespace crest {

/** \brief Draws sliders that nobody can move, for a picture.
 * \param[in] ink the color of the text
 */
void
drawSliders (const std::vector<Threshold>& thresholds,
             const Parameters& parameters,
             const Eigen::Vector3d& ink,
             vtkRenderer& renderer);

/** \brief A slider for each threshold, one above the other at the lower left. */
class Sliders {
public:
  /** \brief Called with a threshold that was moved and its place on the slider. */
  using Moved = std::function<void (const Threshold&, double place)>;

  /** \brief Shows the sliders.
   * \param[in] ink the color of the text
   * \param[in] moved called while the mouse moves for what only filters, and when it
   * is let go for all
   */
  Sliders (vtkRenderWindowInteractor* interactor,
           std::vector<Threshold> thresholds,
           const Parameters& parameters,
           const Eigen::Vector3d& ink,
           Moved moved);
  ~Sliders();
  Sliders (const Sliders&) = delete;
  Sliders&
  operator= (const Sliders&) = delete;

  /** \brief Moves all sliders to where parameters are, without calling anybody. */
  void
  setParameters (const Parameters& parameters);

  /** \brief Whether a threshold that repeats stages may follow the mouse, too. */
  void
  setFast (bool fast)
  {
    fast_ = fast;
  }

  const std::vector<vtkSmartPointer<vtkSliderWidget>>&
  getWidgets () const
  {
    return widgets_;
  }

private:
  void
  dragged (vtkObject* widget, unsigned long event, void* data);

  std::vector<Threshold> thresholds_;
  Moved moved_;
  Parameters parameters_;
  bool fast_ = false;
  std::vector<vtkSmartPointer<vtkSliderWidget>> widgets_;
};

} // namespace crest
} // namespace pcl
