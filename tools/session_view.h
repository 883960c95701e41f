// SPDX-License-Identifier: BSD-3-Clause
// What is seen of a session, in a window as in a picture.
#pragma once

#include <pcl_crest/visualization/size_chart.h>

#include <vtkScalarBarActor.h>

#include "point_colors.h"

namespace pcl {
namespace crest {

/** \brief A session's points, colored by what the user asks for, with its lines, the
 * chart of their sizes and the principal directions.
 */
class SessionView {
public:
  explicit SessionView (const ViewOptions& options);

  /** \brief Shows a session, which has to live as long as it is shown.
   * \param[in] splats of its cloud
   */
  void
  show (const CrestSession& session, const SurfaceSplats& splats);

  /** \brief Shows a line of the session over the others; none if that is -1. */
  void
  highlight (int line);

  /** \brief Shows what a change of thresholds changed. */
  void
  update ();

  /** \brief Returns whether the session knows these colors; else nothing changes. */
  bool
  setColorMode (ColorMode mode);
  ColorMode
  getColorMode () const
  {
    return mode_;
  }

  void
  setDirectionsVisible (bool visible);
  bool
  areDirectionsVisible () const
  {
    return directions_;
  }

  CrestScene&
  getScene ()
  {
    return scene_;
  }
  SizeChart&
  getChart ()
  {
    return chart_;
  }

private:
  void
  recolor ();

  CrestScene scene_;
  SizeChart chart_;
  vtkNew<vtkScalarBarActor> bar_;
  const CrestSession* session_ = nullptr;
  ColorMode mode_;
  bool directions_;
};

} // namespace crest
} // namespace pcl
