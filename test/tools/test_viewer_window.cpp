// SPDX-License-Identifier: BSD-3-Clause
// The viewer's window as its user works it: by keys, sliders and clicks. Needs an X
// display.
#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <vtkCallbackCommand.h>
#include <vtkInteractorEventRecorder.h>
#include <vtkSliderRepresentation2D.h>

#include "support/picture.h"
#include "support/temporary_directory.h"
#include "tools/command_line.h"
#include "tools/export_session.h"
#include "tools/viewer_window.h"
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

using namespace oracle;
using namespace pcl::crest;

namespace {

class Window : public testing::Test {
protected:
  void
  open (Preset preset)
  {
    pcl::io::savePCDFileBinary (input_, *cloud_);
    Parameters parameters;
    parameters.preset = preset;
    parameters.batched_search = true;
    InputCloud cloud;
    std::string error;
    ASSERT_TRUE (readCloud (input_, parameters.k, 0, cloud, error)) << error;
    WindowOptions options;
    options.input = input_;
    options.prefix = directory_.file ("waves");
    options.size = {SIZE, SIZE};
    window_ = std::make_unique<ViewerWindow> (options);
    const auto splats = makeSurfaceSplats (*cloud.points);
    window_->show (std::make_unique<CrestSession> (std::move (cloud), parameters),
                   *splats);
  }

  void
  press (char key, bool shift = false)
  {
    vtkRenderWindowInteractor* const interactor = window_->getInteractor();
    const std::string name (1, key);
    interactor->SetKeyEventInformation (0, shift ? 1 : 0, key, 1, name.c_str());
    for (const auto event : {vtkCommand::KeyPressEvent,
                             vtkCommand::CharEvent,
                             vtkCommand::KeyReleaseEvent})
      interactor->InvokeEvent (event);
  }

  void
  mouse (const Eigen::Vector2d& at, unsigned long event)
  {
    window_->getInteractor()->SetEventInformation (static_cast<int> (at.x()),
                                                   static_cast<int> (at.y()));
    window_->getInteractor()->InvokeEvent (event);
  }

  /** Drags a slider to a part of its way. */
  void
  drag (std::size_t slider, double to)
  {
    auto* const shown = dynamic_cast<vtkSliderRepresentation2D*> (
        window_->getSliders().getWidgets().at (slider)->GetRepresentation());
    const double part = (shown->GetValue() - shown->GetMinimumValue()) /
                        (shown->GetMaximumValue() - shown->GetMinimumValue());
    const auto place = [shown] (double along) {
      const double* const a = shown->GetPoint1Coordinate()->GetValue();
      const double* const b = shown->GetPoint2Coordinate()->GetValue();
      // The tube ends a slider's half before its points.
      const double inner = 0.04 + 0.92 * along;
      return Eigen::Vector2d (SIZE * (a[0] + inner * (b[0] - a[0])), SIZE * a[1]);
    };
    mouse (place (part), vtkCommand::MouseMoveEvent);
    mouse (place (part), vtkCommand::LeftButtonPressEvent);
    mouse (place (0.5 * (part + to)), vtkCommand::MouseMoveEvent);
    mouse (place (to), vtkCommand::MouseMoveEvent);
    mouse (place (to), vtkCommand::LeftButtonReleaseEvent);
  }

  Picture
  picture ()
  {
    std::filesystem::remove (directory_.file ("waves.png"));
    press ('p');
    return Picture (contentOf (directory_.file ("waves.png")));
  }

  /** Whether the files exported are those that the command line exported writes. */
  void
  expectExportOfLineTool ()
  {
    const std::string prefix = directory_.file ("waves");
    for (const std::string& suffix : exportSuffixes())
      std::filesystem::remove (prefix + suffix);
    press ('e');
    const auto contents = [&] {
      auto json = nlohmann::json::parse (contentOf (prefix + "_statistics.json"));
      json.erase ("milliseconds");
      return std::vector<std::string>{json.dump (1),
                                      contentOf (prefix + "_labels.pcd"),
                                      contentOf (prefix + "_lines.ply")};
    };
    const std::vector<std::string> exported = contents();
    for (const char* file : {"_labels.pcd", "_lines.ply", "_statistics.json"})
      std::filesystem::remove (prefix + file);
    std::string command = contentOf (prefix + "_command.txt");
    command.replace (0, command.find (' '), quoted (PCL_CREST_LINE_TOOL));
    command.back() = ' ';
    ASSERT_EQ (std::system ((command + ">/dev/null").c_str()), 0) << command;
    EXPECT_EQ (contents(), exported) << command;
  }

  const TemporaryDirectory directory_;
  const std::string input_ = directory_.file ("waves.pcd");
  const pcl::PointCloud<pcl::PointNormal>::Ptr cloud_ = waves();
  std::unique_ptr<ViewerWindow> window_;
};

bool
isGreen (const std::array<int, 3>& pixel)
{
  return pixel[1] > pixel[0] + 50 && pixel[1] > pixel[2] + 30;
}

bool
isYellow (const std::array<int, 3>& pixel)
{
  return pixel[0] > 200 && pixel[1] > 120 && pixel[2] < 80;
}

bool
isColored (const std::array<int, 3>& pixel)
{
  const auto [low, high] = std::minmax_element (pixel.begin(), pixel.end());
  return *high - *low > 40;
}

} // namespace

TEST_F (Window, SlidersOfThePaper)
{
  open (Preset::PAPER);
  const CrestSession& session = window_->getSession();
  const std::size_t lines = session.getLines().size();
  ASSERT_GT (lines, 0U);
  drag (0, 0.3);
  const double ridge = session.getParameters().maximality.ridge;
  EXPECT_NE (ridge, Parameters().maximality.ridge);
  EXPECT_EQ (session.getParameters().maximality.valley, 0.01);
  EXPECT_NE (window_->getMessage().find (" ms"), std::string::npos);
  drag (1, 1.0);
  EXPECT_GT (session.getParameters().maximality.valley, 500.0);
  EXPECT_LT (session.getLines().size(), lines);
  drag (2, 0.5);
  EXPECT_NEAR (session.getParameters().min_size.ridge.value_or (0), 50, 8);
  expectExportOfLineTool();
}

TEST_F (Window, SlidersOfTheAutoPreset)
{
  open (Preset::AUTO);
  const CrestSession& session = window_->getSession();
  const std::size_t lines = session.getLines().size();
  drag (0, 0.1);
  EXPECT_NEAR (session.getParameters().angle, 9.0, 4.0);
  drag (3, 0.2);
  drag (4, 0.9);
  EXPECT_GT (session.getParameters().min_strength, 0.0);
  EXPECT_LE (session.getLines().size(), lines);
  expectExportOfLineTool();
}

TEST_F (Window, KeysShowAndHide)
{
  open (Preset::AUTO);
  const Picture first = picture();
  EXPECT_GT (count (first, isBlue), 300);
  EXPECT_GT (count (first, isRed), 300);
  press ('i');
  EXPECT_LT (count (picture(), isBlue), 20);
  expectExportOfLineTool();
  press ('v');
  EXPECT_LT (count (picture(), isRed), 20);
  EXPECT_LT (count (picture(), isBlue), 20);
  press ('e');
  EXPECT_NE (window_->getMessage().find ("no lines to export"), std::string::npos);
  press ('i');
  EXPECT_LT (count (picture(), isRed), 20);
  EXPECT_GT (count (picture(), isBlue), 300);
  press ('n');
  EXPECT_GT (count (picture(), isWhite), SIZE * SIZE * 8 / 10);
  press ('n');
  press ('v');
  const int before = count (picture(), isColored);
  for (const char mode : {'2', '3', '4', '5'}) {
    press (mode);
    EXPECT_GT (count (picture(), isColored), before + 100) << mode;
  }
  press ('1');
  // The text at the bottom, which changes, runs over the ends of lines.
  EXPECT_NEAR (count (picture(), isColored), before, 50);
}

TEST_F (Window, KeysOfPointsAndLines)
{
  open (Preset::AUTO);
  const Picture surface = picture();
  press ('d');
  EXPECT_GT (count (picture(), isGreen), 300);
  press ('d');
  EXPECT_EQ (count (picture(), isGreen), 0);
  press ('+');
  const int small_dots = count (picture(), isGrey);
  EXPECT_LT (small_dots, count (surface, isGrey) / 2);
  press ('+');
  EXPECT_GT (count (picture(), isGrey), small_dots + 1000);
  press ('-');
  EXPECT_EQ (count (picture(), isGrey), small_dots);
  // The plus of keyboards that have it above the equals sign.
  press ('=', true);
  EXPECT_GT (count (picture(), isGrey), small_dots + 1000);
  press ('-');
  press ('-');
  // The text at the bottom has changed.
  EXPECT_NEAR (count (picture(), isGrey), count (surface, isGrey), 2000);
  for (int i = 0; i < 4; ++i)
    press (']');
  EXPECT_GT (count (picture(), isBlue), count (surface, isBlue) * 5 / 4);
  for (int i = 0; i < 6; ++i)
    press ('[');
  EXPECT_LT (count (picture(), isBlue), count (surface, isBlue));
  press ('6');
  EXPECT_EQ (window_->getMessage(), "the file has no colors");
}

TEST_F (Window, WhatWasSavedIsNotOverwritten)
{
  open (Preset::AUTO);
  press ('p');
  press ('e');
  const std::string prefix = directory_.file ("waves");
  const std::string picture = contentOf (prefix + ".png");
  const std::string lines = contentOf (prefix + "_lines.ply");
  // The command alone is not all of an export.
  std::filesystem::remove (prefix + "_command.txt");
  drag (0, 0.1);
  press ('i');
  press ('p');
  press ('e');
  EXPECT_EQ (window_->getMessage(), "exported " + prefix + "_2_*");
  EXPECT_EQ (contentOf (prefix + ".png"), picture);
  EXPECT_EQ (contentOf (prefix + "_lines.ply"), lines);
  EXPECT_NE (contentOf (prefix + "_2.png"), picture);
  EXPECT_NE (contentOf (prefix + "_2_lines.ply"), lines);
}

TEST_F (Window, ExportsTheBoundariesThatItShows)
{
  open (Preset::AUTO);
  const auto exportBoundaries = [this] {
    expectExportOfLineTool();
    pcl::PointCloud<pcl::PointXYZL> labels;
    pcl::io::loadPCDFile (directory_.file ("waves_labels.pcd"), labels);
    return std::count_if (labels.begin(), labels.end(), [] (const auto& point) {
      return point.label == LABEL_BOUNDARY;
    });
  };
  EXPECT_EQ (exportBoundaries(), 0);
  press ('5');
  EXPECT_GT (exportBoundaries(), 100);
  press ('1');
  EXPECT_EQ (exportBoundaries(), 0);
}

// What a user did is recorded here, and done again to a window that nobody has touched.
TEST_F (Window, RecordedInteractionReplays)
{
  const std::string log = directory_.file ("events.log");
  open (Preset::PAPER);
  vtkNew<vtkInteractorEventRecorder> recorder;
  recorder->SetInteractor (window_->getInteractor());
  recorder->SetFileName (log.c_str());
  // Before the window, which keeps its keys for itself; and i is one of these.
  recorder->SetPriority (3.0F);
  recorder->KeyPressActivationOff();
  recorder->On();
  recorder->Record();
  drag (0, 0.3);
  drag (1, 0.7);
  drag (2, 0.2);
  for (const char key : std::string ("23456divddv1n+-[]tyivnp"))
    press (key);
  recorder->Stop();
  recorder->Off();
  const auto& session = window_->getSession();
  const Parameters recorded = session.getParameters();
  const std::size_t lines = session.getLines().size();
  EXPECT_NE (recorded.maximality.ridge, Parameters().maximality.ridge);
  EXPECT_NE (recorded.maximality.valley, Parameters().maximality.valley);
  EXPECT_GT (recorded.min_size.ridge.value_or (0), 10);
  const std::string shown = contentOf (directory_.file ("waves.png"));
  std::filesystem::remove (directory_.file ("waves.png"));

  open (Preset::PAPER);
  vtkNew<vtkInteractorEventRecorder> player;
  player->SetInteractor (window_->getInteractor());
  player->SetFileName (log.c_str());
  player->Play();
  const Parameters& replayed = window_->getSession().getParameters();
  EXPECT_EQ (optionsOf (replayed), optionsOf (recorded));
  EXPECT_EQ (window_->getSession().getLines().size(), lines);
  const Picture again (contentOf (directory_.file ("waves.png")));
  EXPECT_GT (count (again, isBlue), 100);
  EXPECT_NEAR (count (again, isBlue), count (Picture (shown), isBlue), 20);
  expectExportOfLineTool();
}

TEST_F (Window, ChartHasBarsOfBothTypes)
{
  open (Preset::AUTO);
  const auto inCorner = [] (const Picture& shown, PixelTest& test) {
    int pixels = 0;
    for (int y = SIZE * 65 / 100; y < SIZE; ++y)
      for (int x = SIZE * 65 / 100; x < SIZE; ++x)
        pixels += test (shown (x, y)) ? 1 : 0;
    return pixels;
  };
  const Picture without = picture();
  press ('t');
  const Picture with = picture();
  EXPECT_GT (inCorner (with, isWhite), inCorner (without, isWhite) + 1000);
  EXPECT_GT (inCorner (with, isBlue), 50);
  EXPECT_GT (inCorner (with, isRed), 50);
  press ('y');
  EXPECT_GT (inCorner (picture(), isBlue), 50);
  press ('t');
  EXPECT_EQ (inCorner (picture(), isWhite), inCorner (without, isWhite));
}

TEST_F (Window, ClickTellsOfALine)
{
  open (Preset::AUTO);
  window_->getInteractor()->Render();
  const View view = fitView (*cloud_, {SIZE, SIZE});
  const auto click = [&] (double shift) {
    const double y = 0.4;
    const double z = 0.1 * std::cos (2.0 * M_PI * shift);
    const Eigen::Vector2d at = project (view, {windingOf (y) + shift, y, z});
    mouse (at, vtkCommand::LeftButtonPressEvent);
    mouse (at, vtkCommand::LeftButtonReleaseEvent);
    return window_->getMessage();
  };
  EXPECT_EQ (click (0.0).find ("ridge of "), 0U) << window_->getMessage();
  EXPECT_NE (window_->getMessage().find ("strength"), std::string::npos);
  EXPECT_EQ (click (0.5).find ("valley of "), 0U) << window_->getMessage();
}

TEST_F (Window, ClickedLineIsHighlighted)
{
  open (Preset::AUTO);
  window_->getInteractor()->Render();
  const View view = fitView (*cloud_, {SIZE, SIZE});
  const auto click = [&] (const Eigen::Vector2d& at) {
    mouse (at, vtkCommand::LeftButtonPressEvent);
    mouse (at, vtkCommand::LeftButtonReleaseEvent);
  };
  EXPECT_EQ (0, count (picture(), isYellow));
  click (project (view, {windingOf (0.4), 0.4, 0.1}));
  EXPECT_EQ (window_->getMessage().find ("ridge of "), 0U) << window_->getMessage();
  EXPECT_GT (count (picture(), isYellow), 50);
  click ({2.0, SIZE - 3.0});
  EXPECT_EQ (0, count (picture(), isYellow));
}

TEST_F (Window, SlidersGoBack)
{
  open (Preset::AUTO);
  const CrestSession& session = window_->getSession();
  const std::size_t lines = session.getLines().size();
  const auto placeOfFirst = [&] {
    return dynamic_cast<vtkSliderRepresentation2D*> (
               window_->getSliders().getWidgets().at (0)->GetRepresentation())
        ->GetValue();
  };
  const double place = placeOfFirst();
  drag (0, 0.9);
  drag (4, 0.9);
  press ('i');
  EXPECT_NE (place, placeOfFirst());
  EXPECT_NE (Parameters().angle, session.getParameters().angle);
  press ('0');
  EXPECT_EQ (place, placeOfFirst());
  EXPECT_EQ (Parameters().angle, session.getParameters().angle);
  EXPECT_EQ (0.0, session.getParameters().min_strength);
  EXPECT_FALSE (session.getParameters().wanted.ridge) << "which is no slider";
  press ('i');
  EXPECT_EQ (lines, session.getLines().size());
}

// PCL's event loop does not end where the process has had another window before: each
// of these cases has a process of its own.
class WindowDeathTest : public testing::Test {
protected:
  void
  SetUp () override
  {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
  }
};

TEST_F (WindowDeathTest, ReportsWhatCannotBeLoaded)
{
  const auto run = [] {
    WindowOptions options;
    options.size = {SIZE, SIZE};
    ViewerWindow window (options);
    std::string error;
    window.run (
        [] (const ProgressCallback& progress,
            const ViewerWindow::Preview&,
            std::string& why) {
          progress ("reading", 0.0);
          why = "no such cloud";
          return std::unique_ptr<CrestSession>();
        },
        error);
    std::_Exit (error == "no such cloud" ? 0 : 1);
  };
  EXPECT_EXIT (run(), testing::ExitedWithCode (0), "");
}

TEST_F (WindowDeathTest, ClosesDuringWork)
{
  const auto run = [] {
    WindowOptions options;
    options.size = {SIZE, SIZE};
    auto window = std::make_unique<ViewerWindow> (options);
    // The user presses q when the window says what is being done.
    vtkNew<vtkCallbackCommand> quit;
    quit->SetClientData (window.get());
    quit->SetCallback ([] (vtkObject*, unsigned long, void* data, void*) {
      auto* const waiting = static_cast<ViewerWindow*> (data);
      if (waiting->getMessage() ==
          "endless work ... 50 % (q quits, h lists the keys for when this is done)")
        waiting->getInteractor()->ExitCallback();
    });
    window->getInteractor()->AddObserver (vtkCommand::TimerEvent, quit, 3.0F);
    std::string error;
    window->run (
        [] (const ProgressCallback& progress,
            const ViewerWindow::Preview&,
            std::string& why) {
          while (progress ("endless work", 0.5))
            std::this_thread::sleep_for (std::chrono::milliseconds (1));
          why = "cancelled";
          return std::unique_ptr<CrestSession>();
        },
        error);
    window.reset();
    std::_Exit (error.empty() ? 0 : 1);
  };
  EXPECT_EXIT (run(), testing::ExitedWithCode (0), "");
}
