// SPDX-License-Identifier: BSD-3-Clause
// pcl_crest_viewer: shows the crest lines of a file over its points, in a window or as
// a picture. Exits with 0 when done, 1 on wrong usage, 2 where a file cannot be read or
// written or there is no display.
#include <pcl_crest/io/output_file.h>
#include <pcl_crest/io/parse_number.h>
#include <pcl_crest/visualization/crest_scene.h>
#include <pcl_crest/visualization/picture.h>
#include <pcl_crest/visualization/view.h>

#include <pcl/visualization/pcl_visualizer.h>

#include "estimation.h"
#include "options.h"

#include <algorithm>
#include <iostream>
#include <optional>

using namespace pcl::crest;

namespace {

constexpr char PROGRAM[] = "pcl_crest_viewer";

constexpr int SAMPLES_PER_PIXEL = 8;

struct Request {
  std::string input;
  std::string screenshot;
  Eigen::Vector2i size{1200, 1200};
  /** else the view is fitted to the cloud */
  std::optional<View> view;
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

int
savePicture (const CrestScene& scene, const Request& request)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering (1);
  window->SetMultiSamples (SAMPLES_PER_PIXEL);
  window->SetSize (request.size.x(), request.size.y());
  window->AddRenderer (scene.getRenderer());
  std::string error;
  if (!replaceFile (request.screenshot, renderPicture (*window), error))
    return fail (PROGRAM, EXIT_FILE, error);
  std::cout << "Wrote " << request.screenshot << "\n";
  return EXIT_DONE;
}

int
showWindow (const CrestScene& scene, const Request& request)
{
  const vtkSmartPointer<vtkRenderer> renderer = scene.getRenderer();
  const auto window = vtkSmartPointer<vtkRenderWindow>::New();
  pcl::visualization::PCLVisualizer viewer (
      renderer, window, "pcl_crest_viewer " + request.input);
  viewer.setShowFPS (false);
  viewer.setSize (request.size.x(), request.size.y());
  if (request.view)
    viewer.setPosition (request.view->window_position.x(),
                        request.view->window_position.y());
  viewer.spin();
  return EXIT_DONE;
}

int
run (const Request& request, const Parameters& parameters)
{
  std::string error;
  Estimate result;
  const auto tell = [&request] (const InputCloud& read) {
    for (const std::string& note : read.notes)
      std::cout << request.input << ": " << note << "\n";
  };
  const ExitCode code = estimate (request.input, parameters, tell, result, error);
  if (code != EXIT_DONE)
    return fail (PROGRAM, code, error);
  const auto& [cloud, estimation, labels] = result;
  if (std::all_of (labels.begin(), labels.end(), [] (const pcl::Label& label) {
        return label.label == LABEL_INVALID;
      }))
    return fail (PROGRAM,
                 EXIT_FILE,
                 request.input + ": there is nothing to show, as no point is finite, "
                                 "has a normal and neighbors enough");

  CrestScene scene;
  scene.setCloud (cloud.points);
  scene.setLines (estimation.getLines(), *estimation.getLineCloud());
  setCamera (request.view ? *request.view : fitView (*cloud.points, request.size),
             *scene.getRenderer()->GetActiveCamera());
  return request.screenshot.empty() ? showWindow (scene, request)
                                    : savePicture (scene, request);
}

} // namespace

int
main (int argc, char** argv)
{
  Parameters parameters;
  Request request;
  bool help = false;
  Options options;
  addEstimationOptions (options, parameters);
  options.addText ("-screenshot",
                   "FILE.png",
                   "write a picture instead of opening a window",
                   request.screenshot);
  options.add (
      "-size",
      "WxH",
      "size of window or picture (default 1200x1200, or as -cam says)",
      [&request] (const std::string& value) { return takeSize (value, request.size); });
  options.add (
      "-cam",
      "CAMERA",
      "a file that pcl_viewer saved the camera to, or what is in it\n"
      "                          (default: the whole cloud from its broadest "
      "side)",
      [&request] (const std::string& value) { return takeView (value, request.view); });
  options.addFlag ("-h", "show this and do nothing else", help);
  if (wantsHelp (argc, argv)) {
    std::cout
        << "Usage: pcl_crest_viewer INPUT [options]\n\n"
           "Shows a point cloud and its crest lines, ridges blue and valleys red, in\n"
           "a window with the mouse and keys of pcl_viewer (h lists them, q quits).\n"
           "INPUT is a .pcd, .ply, .obj, .off, .stl, .vtk, .xyz or .txt file.\n\n"
        << options.usage();
    return EXIT_DONE;
  }

  std::vector<std::string> arguments;
  std::string error =
      takeArguments (argc, argv, {"INPUT"}, options, parameters, arguments);
  if (!error.empty())
    return fail (PROGRAM, EXIT_USAGE, error);
  request.input = arguments[0];
  if (request.view && !options.given ("-size"))
    request.size = request.view->window_size;
  if (!request.screenshot.empty()) {
    if (!hasExtension (request.screenshot, {".png"}, error))
      return fail (PROGRAM, EXIT_USAGE, error);
    if (!checkWritable (request.screenshot, error))
      return fail (PROGRAM, EXIT_FILE, error);
  }
  if (!canRender (error))
    return fail (PROGRAM, EXIT_FILE, error);
  return run (request, parameters);
}
