// SPDX-License-Identifier: BSD-3-Clause
// The viewer's window: what keys, sliders and clicks do.
#pragma once

#include <pcl_crest/visualization/view.h>

#include <pcl/visualization/pcl_visualizer.h>

#include <vtkTextActor.h>

#include "session_view.h"
#include "sliders.h"

#include <atomic>
#include <future>
#include <mutex>
#include <optional>

namespace pcl {
namespace crest {

/** \brief What the window opens with. */
struct WindowOptions {
  std::string input;
  ReadOptions reading;
  /** of the names of files that are saved */
  std::string prefix;
  Eigen::Vector2i size{1200, 1200};
  /** whether it is less on a screen that has no room for it */
  bool fits_screen = true;
  /** else the view is fitted to the cloud */
  std::optional<View> camera;
  ViewOptions view;
};

/** \brief A window in the way of pcl_viewer that shows a session, and keys of its own.
 */
class ViewerWindow {
public:
  /** \brief Told of the points as soon as they are known; they stay as they are. */
  using Preview =
      std::function<void (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& points)>;

  /** \brief Long work: makes the session, telling how far it is, and of the points
   * before; none, with what is wrong, on failure. Runs in a thread of its own. */
  using Load = std::function<std::unique_ptr<CrestSession> (
      const ProgressCallback& progress, const Preview& preview, std::string& error)>;

  explicit ViewerWindow (const WindowOptions& options);
  ~ViewerWindow();
  ViewerWindow (const ViewerWindow&) = delete;
  ViewerWindow&
  operator= (const ViewerWindow&) = delete;

  /** \brief Shows a session.
   * \param[in] splats of its cloud
   */
  void
  show (std::unique_ptr<CrestSession> session, const SurfaceSplats& splats);

  /** \brief Opens the window, responsive while the session is loaded, until the user
   * closes it. Loading that is not done then is told not to go on, and waited for.
   * \param[out] error what went wrong with loading, if it did
   */
  void
  run (const Load& load, std::string& error);

  vtkRenderWindowInteractor*
  getInteractor ();
  const CrestSession&
  getSession () const
  {
    return *session_;
  }
  const Sliders&
  getSliders () const
  {
    return *sliders_;
  }
  /** \brief The last line of text about what was clicked, saved or went wrong. */
  const std::string&
  getMessage () const
  {
    return message_;
  }

  /** \brief What -h and the key h say. */
  static std::string
  keys ();

private:
  /** \brief Returns whether the key is one of ours. */
  bool
  keyPressed (unsigned long event);
  void
  act (char key);
  void
  change (const std::function<void (Parameters&)>& edit);
  void
  mouseMoved (const pcl::visualization::MouseEvent& event);
  void
  setShown (CrestType type, bool shown);
  void
  save ();
  void
  exportFiles ();
  void
  describeLineAt (int x, int y);
  void
  reset ();
  void
  setView (const pcl::PointCloud<pcl::PointNormal>& cloud);
  void
  say (const std::string& message);
  void
  poll ();

  WindowOptions options_;
  SessionView view_;
  vtkSmartPointer<vtkRenderWindow> window_;
  std::unique_ptr<pcl::visualization::PCLVisualizer> viewer_;
  std::unique_ptr<CrestSession> session_;
  std::unique_ptr<Sliders> sliders_;
  vtkNew<vtkTextActor> text_;
  std::string message_;
  std::array<int, 2> pressed_{};
  PerType<bool> shown_{true, true};
  /** those that the session came with */
  Parameters first_;
  bool has_view_ = false;

  struct Loaded {
    std::unique_ptr<CrestSession> session;
    std::shared_ptr<const SurfaceSplats> splats;
  };
  std::mutex stage_mutex_;
  std::string stage_;
  /** points that are not on the screen yet */
  pcl::PointCloud<pcl::PointNormal>::ConstPtr preview_;
  std::string load_error_;
  std::atomic<bool> closed_{false};
  int timer_ = -1;
  /** the last member, as its end waits for the thread that uses those above */
  std::future<Loaded> loading_;
};

} // namespace crest
} // namespace pcl
