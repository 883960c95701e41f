// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_window.h"

#include <pcl_crest/visualization/view.h>

#include <pcl/console/print.h>

#include <vtkCommand.h>
#include <vtkTextProperty.h>

#include "export_session.h"
#include "io/output_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

// Before the interactor's style, whose keys of the same name ours take the place of.
constexpr float FIRST = 2.0F;
/** A threshold that repeats stages follows the mouse if they take no longer. */
constexpr double FAST_MILLISECONDS = 60.0;
constexpr int POLL_MILLISECONDS = 50;

/** \brief The prefix, with a number if need be, for files that are not there yet: what
 * was saved before is not overwritten.
 */
std::string
unusedPrefix (const std::string& prefix, const std::vector<std::string>& suffixes)
{
  std::string unused = prefix;
  const auto isUsed = [&unused] (const std::string& suffix) {
    std::error_code ignored;
    return std::filesystem::exists (unused + suffix, ignored);
  };
  for (int i = 2; std::any_of (suffixes.begin(), suffixes.end(), isUsed); ++i)
    unused = prefix + "_" + std::to_string (i);
  return unused;
}

/** \brief The character that a key stands for, or 0. VTK tells that of the key alone:
 * on keyboards without a plus of its own that is the equals sign.
 */
char
typedKey (vtkRenderWindowInteractor* interactor)
{
  const char key = interactor->GetKeyCode();
  return key == '=' && interactor->GetShiftKey() != 0 ? '+' : key;
}

/** \brief Takes events before the interactor's style does, which gets the others. */
class TakingCommand : public vtkCommand {
public:
  static TakingCommand*
  New ()
  {
    return new TakingCommand;
  }
  void
  Execute (vtkObject*, unsigned long event, void* data) override
  {
    if (take (event, data))
      AbortFlagOn();
  }
  std::function<bool (unsigned long event, void* data)> take;
};

} // namespace

std::string
ViewerWindow::keys()
{
  return "  1 ... 6     color by: nothing, label, k1, k2, boundary, the file's colors\n"
         "  d           principal directions on and off, t1 the long bar\n"
         "  i, v        ridges, valleys on and off\n"
         "  n           points on and off\n"
         "  +, -        larger and smaller dots; a surface instead if smaller than 1\n"
         "  [, ]        thinner and thicker lines\n"
         "  0           sliders back to where they were at first\n"
         "  t, y        chart of line sizes on and off, its logarithm\n"
         "  p           save a picture\n"
         "  e           export labels, lines, statistics and the command line for "
         "them\n"
         "  click       on a line tells its type, size, length and strength\n";
}

ViewerWindow::ViewerWindow (const WindowOptions& options)
: options_ (options)
, view_ (options.view)
, window_ (vtkSmartPointer<vtkRenderWindow>::New())
, viewer_ (std::make_unique<pcl::visualization::PCLVisualizer> (
      view_.getScene().getRenderer(), window_, "pcl_crest_viewer " + options.input))
{
  // Samples of every pixel would double the time of large surfaces.
  window_->SetMultiSamples (0);
  view_.getScene().getRenderer()->UseFXAAOn();
  viewer_->setShowFPS (false);
  if (options_.fits_screen) {
    // What the desktop has above and below windows.
    constexpr int FRAME = 80;
    const int* const screen = window_->GetScreenSize();
    options_.size =
        options_.size.cwiseMin (Eigen::Vector2i (screen[0], screen[1] - FRAME))
            .cwiseMax (1);
  }
  viewer_->setSize (options_.size.x(), options_.size.y());
  if (options_.camera)
    viewer_->setPosition (options_.camera->window_position.x(),
                          options_.camera->window_position.y());
  Eigen::Vector3d ink = inkOn (options_.view.background);
  text_->GetTextProperty()->SetColor (ink.data());
  text_->GetTextProperty()->SetFontSize (16);
  // So that it can be read over the points, too.
  Eigen::Vector3d paper = options_.view.background;
  text_->GetTextProperty()->SetBackgroundColor (paper.data());
  text_->GetTextProperty()->SetBackgroundOpacity (0.7);
  text_->SetPosition (12, 12);
  text_->SetInput (" ");
  view_.getScene().getRenderer()->AddActor (text_);
  vtkRenderWindowInteractor* const interactor = getInteractor();
  for (const auto event : {vtkCommand::KeyPressEvent, vtkCommand::CharEvent}) {
    vtkNew<TakingCommand> command;
    command->take = [this] (unsigned long id, void*) { return keyPressed (id); };
    interactor->AddObserver (event, command, FIRST);
  }
  // Between press and release the style has the mouse for itself: it passes both on.
  viewer_->registerMouseCallback (
      [this] (const pcl::visualization::MouseEvent& event) { mouseMoved (event); });
  // The style would render at each tick.
  vtkNew<TakingCommand> tick;
  tick->take = [this] (unsigned long, void* timer) {
    if (timer == nullptr || *static_cast<int*> (timer) != timer_)
      return false;
    poll();
    return true;
  };
  interactor->AddObserver (vtkCommand::TimerEvent, tick, FIRST);
}

ViewerWindow::~ViewerWindow()
{
  sliders_.reset();
  for (const auto event :
       {vtkCommand::KeyPressEvent, vtkCommand::CharEvent, vtkCommand::TimerEvent})
    getInteractor()->RemoveObservers (event);
}

vtkRenderWindowInteractor*
ViewerWindow::getInteractor()
{
  return window_->GetInteractor();
}

void
ViewerWindow::show (std::unique_ptr<CrestSession> session, const SurfaceSplats& splats)
{
  session_ = std::move (session);
  shown_ = session_->getParameters().wanted;
  first_ = session_->getParameters();
  view_.show (*session_, splats);
  // Where the points were shown before, it may have been turned meanwhile.
  if (!has_view_)
    setView (*session_->getCloud().points);
  sliders_ = std::make_unique<Sliders> (
      getInteractor(),
      thresholdsOf (*session_),
      session_->getParameters(),
      inkOn (options_.view.background),
      [this] (const Threshold& threshold, double place) {
        change ([&] (Parameters& p) { takeSliderPlace (threshold, place, p); });
      });
  say ("h lists the keys");
}

void
ViewerWindow::setView (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  has_view_ = true;
  setCamera (options_.camera ? *options_.camera : fitView (cloud, options_.size),
             *view_.getScene().getRenderer()->GetActiveCamera());
}

void
ViewerWindow::run (const Load& load, std::string& error)
{
  const auto progress = [this] (const std::string& stage, double done) {
    const std::lock_guard<std::mutex> lock (stage_mutex_);
    stage_ = stage + " ... " + std::to_string (std::lround (100.0 * done)) +
             " % (q quits, h lists the keys for when this is done)";
    // Nobody waits for what is then left out.
    if (closed_)
      pcl::console::setVerbosityLevel (pcl::console::L_ERROR);
    return !closed_;
  };
  const auto preview = [this] (const auto& points) {
    const std::lock_guard<std::mutex> lock (stage_mutex_);
    preview_ = points;
  };
  loading_ = std::async (std::launch::async, [this, load, progress, preview] {
    Loaded loaded;
    loaded.session = load (progress, preview, load_error_);
    if (loaded.session && progress ("surface to draw", 1.0))
      loaded.splats = makeSurfaceSplats (*loaded.session->getCloud().points);
    return loaded;
  });
  view_.getScene().getRenderer()->ResetCamera();
  window_->Render();
  timer_ = getInteractor()->CreateRepeatingTimer (POLL_MILLISECONDS);
  viewer_->spin();
  if (loading_.valid()) {
    closed_ = true;
    window_->Finalize();
    loading_.wait();
    return;
  }
  error = load_error_;
}

void
ViewerWindow::poll()
{
  if (!loading_.valid())
    return;
  if (loading_.wait_for (std::chrono::seconds (0)) != std::future_status::ready) {
    std::string stage;
    pcl::PointCloud<pcl::PointNormal>::ConstPtr points;
    {
      const std::lock_guard<std::mutex> lock (stage_mutex_);
      stage = stage_;
      points.swap (preview_);
    }
    if (points) {
      view_.getScene().setPoints (points);
      setView (*points);
      message_.clear();
    }
    if (message_ != stage)
      say (stage);
    return;
  }
  Loaded loaded = loading_.get();
  if (loaded.session)
    show (std::move (loaded.session), *loaded.splats);
  else
    getInteractor()->ExitCallback();
}

bool
ViewerWindow::keyPressed (unsigned long event)
{
  vtkRenderWindowInteractor* const interactor = getInteractor();
  if (interactor->GetControlKey() != 0 || interactor->GetAltKey() != 0)
    return false;
  const char key = typedKey (interactor);
  const bool pressed = event == vtkCommand::KeyPressEvent;
  if (key == 'h' && pressed)
    std::cout << "Keys of pcl_crest_viewer, before those of pcl_viewer:\n" << keys();
  if (key == '\0' ||
      std::string ("0123456divn+-[]type").find (key) == std::string::npos)
    return false;
  if (pressed && session_)
    act (key);
  return true;
}

void
ViewerWindow::act (char key)
{
  constexpr double LINE_STEP = 0.5;
  CrestScene& scene = view_.getScene();
  SizeChart& chart = view_.getChart();
  switch (key) {
  case 'i':
  case 'v': {
    const CrestType type = key == 'i' ? CrestType::RIDGE : CrestType::VALLEY;
    return setShown (type, !shown_[type]);
  }
  case 'n':
    scene.setSurfaceVisible (!scene.isSurfaceVisible());
    break;
  case 'd':
    view_.setDirectionsVisible (!view_.areDirectionsVisible());
    break;
  case '+':
    scene.setPointSize (std::min (scene.getPointSize() + 1, LARGEST_POINT));
    break;
  case '-':
    scene.setPointSize (std::max (scene.getPointSize() - 1, 0));
    break;
  case '[':
    scene.setLineWidth (std::max (scene.getLineWidth() - LINE_STEP, THINNEST_LINE));
    break;
  case ']':
    scene.setLineWidth (std::min (scene.getLineWidth() + LINE_STEP, THICKEST_LINE));
    break;
  case 't':
    chart.setVisible (!chart.isVisible());
    break;
  case 'y':
    chart.setLogarithmic (!chart.isLogarithmic());
    break;
  case '0':
    return reset();
  case 'p':
    return save();
  case 'e':
    return exportFiles();
  default:
    if (!view_.setColorMode (static_cast<ColorMode> (key - '1')))
      return say ("the file has no colors");
  }
  say ({});
}

void
ViewerWindow::setShown (CrestType type, bool shown)
{
  shown_[type] = shown;
  const bool any = shown_.ridge || shown_.valley;
  view_.getScene().setLinesVisible (any);
  if (any)
    change ([this] (Parameters& p) { p.wanted = shown_; });
  else
    say ("ridges and valleys are hidden");
}

void
ViewerWindow::reset()
{
  change ([this] (Parameters& p) {
    const PerType<bool> wanted = p.wanted;
    p = first_;
    p.wanted = wanted;
  });
  sliders_->setParameters (session_->getParameters());
  window_->Render();
}

void
ViewerWindow::save()
{
  const std::string file = unusedPrefix (options_.prefix, {".png"}) + ".png";
  std::string error;
  say (replaceFile (file, renderPicture (*window_), error) ? "saved " + file : error);
}

void
ViewerWindow::exportFiles()
{
  if (!shown_.ridge && !shown_.valley)
    return say ("there are no lines to export: ridges and valleys are hidden");
  // What is on the screen has to be in the file.
  const Parameters asked = session_->getParameters();
  const bool adds_boundaries =
      !asked.boundaries && view_.getColorMode() == ColorMode::BOUNDARY;
  if (adds_boundaries) {
    Parameters shown = asked;
    shown.boundaries = true;
    session_->setThresholds (shown);
  }
  const std::string prefix = unusedPrefix (options_.prefix, exportSuffixes());
  std::string error;
  const bool exported = exportSession (*session_, options_.input, prefix, error);
  if (adds_boundaries)
    session_->setThresholds (asked);
  say (exported ? "exported " + prefix + "_*" : error);
}

void
ViewerWindow::change (const std::function<void (Parameters&)>& edit)
{
  Parameters parameters = session_->getParameters();
  edit (parameters);
  const std::string invalid = explainInvalid (parameters);
  if (!invalid.empty())
    return say (invalid);
  const auto start = std::chrono::steady_clock::now();
  session_->setThresholds (parameters);
  view_.update();
  const double took = std::chrono::duration<double, std::milli> (
                          std::chrono::steady_clock::now() - start)
                          .count();
  const auto& times = session_->getStatistics().times;
  if (!times.empty() && times.front().stage == "crest points")
    sliders_->setFast (took < FAST_MILLISECONDS);
  std::ostringstream text;
  const double drawing =
      1e3 * view_.getScene().getRenderer()->GetLastRenderTimeInSeconds();
  text << "updated in " << std::fixed << std::setprecision (1) << took
       << " ms, the last picture took " << drawing << " ms";
  say (text.str());
}

void
ViewerWindow::mouseMoved (const pcl::visualization::MouseEvent& event)
{
  using pcl::visualization::MouseEvent;
  const std::array<int, 2> at{static_cast<int> (event.getX()),
                              static_cast<int> (event.getY())};
  if (event.getButton() != MouseEvent::LeftButton)
    return;
  if (event.getType() == MouseEvent::MouseButtonPress)
    pressed_ = at;
  else if (event.getType() == MouseEvent::MouseButtonRelease && session_ &&
           pressed_ == at)
    describeLineAt (at[0], at[1]);
}

void
ViewerWindow::describeLineAt (int x, int y)
{
  const int picked = view_.getScene().pickLine (x, y);
  view_.highlight (picked);
  if (picked < 0)
    return say ({});
  const CrestLine& line = session_->getLines()[picked];
  std::ostringstream text;
  text.precision (4);
  text << (line.type == CrestType::RIDGE ? "ridge" : "valley") << " of " << line.size
       << " points, length " << line.length << ", strength " << line.strength;
  if (line.turning_angle > 0.0)
    text << ", turns by " << line.turning_angle << " degrees";
  say (text.str());
}

void
ViewerWindow::say (const std::string& message)
{
  message_ = message;
  std::string text = message;
  if (session_ && (shown_.ridge || shown_.valley)) {
    std::size_t ridges = 0;
    for (const CrestLine& line : session_->getLines())
      ridges += line.type == CrestType::RIDGE ? 1 : 0;
    text = std::to_string (ridges) + " ridges, " +
           std::to_string (session_->getLines().size() - ridges) + " valleys" +
           (message.empty() ? "" : "; " + message);
  }
  text_->SetInput (text.c_str());
  window_->Render();
}

} // namespace crest
} // namespace pcl
