// SPDX-License-Identifier: BSD-3-Clause
// pcl_crest_viewer: shows the crest lines of a file over its points, in a window or as
// a picture. Exits with 0 when done, 1 on wrong usage, 2 where a file cannot be read or
// written, there is not enough memory for it, or no display.
#include <pcl_crest/visualization/view.h>

#include "io/output_file.h"
#include "io/parse_number.h"
#include "options.h"
#include "program.h"
#include "viewer_window.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>

using namespace pcl::crest;

namespace {

constexpr char PROGRAM[] = "pcl_crest_viewer";

constexpr int SAMPLES_PER_PIXEL = 8;

struct Request {
  WindowOptions window;
  std::string screenshot;
};

std::string
takeSize (const std::string& value, Eigen::Vector2i& size)
{
  const std::size_t cross = value.find ('x');
  Eigen::Vector2i taken;
  if (cross == std::string::npos ||
      !parseNumber (std::string_view (value).substr (0, cross), taken[0]) ||
      !parseNumber (std::string_view (value).substr (cross + 1), taken[1]) ||
      taken.minCoeff() < 1 || taken.maxCoeff() > LARGEST_WINDOW)
    return "two numbers of pixels up to " + std::to_string (LARGEST_WINDOW) +
           ", as in 800x600";
  size = taken;
  return {};
}

std::string
takeView (const std::string& value, std::optional<View>& view)
{
  View taken;
  std::string wanted;
  if (readView (value, taken, wanted))
    view = taken;
  return wanted;
}

/** \brief All that is to know before anything can be shown. */
std::unique_ptr<CrestSession>
load (const WindowOptions& window,
      const Parameters& parameters,
      const ProgressCallback& progress,
      const ViewerWindow::Preview& preview,
      std::string& error)
{
  const std::string& input = window.input;
  progress ("reading " + input, 0.0);
  InputCloud cloud;
  if (!readCloud (
          input, parameters.k, parameters.threads, cloud, error, window.reading))
    return nullptr;
  for (const std::string& note : cloud.notes)
    std::cout << input << ": " << note << "\n";
  preview (cloud.points);
  if (!progress ("reading " + input, 1.0))
    return nullptr;
  if (window.view.color == ColorMode::FILE && cloud.colors.empty()) {
    error = input + ": it has no colors, which -color rgb is to show";
    return nullptr;
  }
  std::unique_ptr<CrestSession> session;
  try {
    session = std::make_unique<CrestSession> (std::move (cloud), parameters, progress);
  }
  catch (const std::bad_alloc&) {
    error = notEnoughMemory (input);
    return nullptr;
  }
  if (session->getLabels().empty()) {
    error = input + ": the crest lines could not be computed";
    return nullptr;
  }
  const pcl::PointCloud<pcl::Label>& labels = session->getLabels();
  if (std::any_of (labels.begin(), labels.end(), [] (const pcl::Label& l) {
        return l.label != LABEL_INVALID;
      }))
    return session;
  error = input + ": there is nothing to show, as no point is finite, has a normal and "
                  "neighbors enough";
  return nullptr;
}

int
savePicture (const Request& request, const Parameters& parameters)
{
  std::string error;
  const auto quiet = [] (const std::string&, double) { return true; };
  const std::unique_ptr<CrestSession> session = load (
      request.window, parameters, quiet, [] (const auto&) {}, error);
  if (!session)
    return fail (PROGRAM, EXIT_FILE, error);
  const Eigen::Vector2i& size = request.window.size;
  const std::optional<View>& camera = request.window.camera;
  const ViewOptions& options = request.window.view;
  SessionView view (options);
  view.show (*session, *makeSurfaceSplats (*session->getCloud().points));
  vtkRenderer& renderer = *view.getScene().getRenderer();
  if (options.sliders)
    drawSliders (
        thresholdsOf (*session), parameters, inkOn (options.background), renderer);
  setCamera (camera ? *camera : fitView (*session->getCloud().points, size),
             *renderer.GetActiveCamera());
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering (1);
  window->SetMultiSamples (SAMPLES_PER_PIXEL);
  window->SetSize (size.x(), size.y());
  window->AddRenderer (&renderer);
  if (!replaceFile (request.screenshot, renderPicture (*window), error))
    return fail (PROGRAM, EXIT_FILE, error);
  std::cout << "Wrote " << request.screenshot << "\n";
  return EXIT_DONE;
}

int
showWindow (const Request& request, const Parameters& parameters)
{
  const auto load_input = [&] (const ProgressCallback& progress,
                               const ViewerWindow::Preview& preview,
                               std::string& error) {
    return load (request.window, parameters, progress, preview, error);
  };
  std::string error;
  ViewerWindow (request.window).run (load_input, error);
  return error.empty() ? EXIT_DONE : fail (PROGRAM, EXIT_FILE, error);
}

} // namespace

int
main (int argc, char** argv)
{
  cleanUpOnSignals();
  Parameters parameters;
  Request request;
  bool asked = false;
  std::vector<OptionGroup> groups{{"Picture and window", {}},
                                  {"Input", {}},
                                  {"Crest lines", {}},
                                  {"Questions", {}}};
  Options& view = groups[0].options;
  auto add = view.add_options();
  add ("-screenshot",
       fileName ("FILE.png", request.screenshot),
       "write a picture instead of opening a window");
  add ("-size",
       value ("WxH",
              [&request] (const std::string& text) {
                return takeSize (text, request.window.size);
              }),
       "size of window or picture (default 1200x1200, of windows\nas far as the screen "
       "has room, or as -cam says)");
  add ("-cam",
       value ("CAMERA",
              [&request] (const std::string& text) {
                return takeView (text, request.window.camera);
              }),
       "a file that pcl_viewer saved the camera to, or what is in it\n"
       "(default: the whole cloud from its broadest side)");
  addViewOptions (view, request.window.view);
  addReadingOptions (groups[1].options, request.window.reading);
  addEstimationOptions (groups[2].options, parameters);
  addQuestions (groups[3].options, asked);
  if (wantsHelp (argc, argv)) {
    std::cout
        << "Usage: pcl_crest_viewer INPUT [options]\n\n"
           "Shows a point cloud and its crest lines, ridges blue and valleys red, in\n"
           "a window with the mouse and keys of pcl_viewer (h lists them, q quits).\n"
           "INPUT is a file of one of the formats that -format lists.\n\n"
        << usage (groups) << "\nKeys in the window:\n"
        << ViewerWindow::keys();
    return EXIT_DONE;
  }
  if (wantsVersion (argc, argv)) {
    std::cout << describeVersion (PROGRAM);
    return EXIT_DONE;
  }

  Arguments arguments;
  std::string error =
      takeArguments (argc, argv, {"INPUT"}, allOptions (groups), parameters, arguments);
  if (!error.empty())
    return fail (PROGRAM, EXIT_USAGE, error);
  request.window.input = arguments.files[0];
  request.window.prefix = std::filesystem::path (request.window.input).stem().string();
  request.window.fits_screen =
      !request.window.camera && arguments.options.count ("-size") == 0;
  if (request.window.camera && arguments.options.count ("-size") == 0)
    request.window.size = request.window.camera->window_size;
  if (!request.screenshot.empty()) {
    if (!hasExtension (request.screenshot, {".png"}, error))
      return fail (PROGRAM, EXIT_USAGE, error);
    if (!checkWritable (request.screenshot, error))
      return fail (PROGRAM, EXIT_FILE, error);
  }
  if (!checkReadable (request.window.input, error) || !canRender (error))
    return fail (PROGRAM, EXIT_FILE, error);
  return request.screenshot.empty() ? showWindow (request, parameters)
                                    : savePicture (request, parameters);
}
