// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/visualization/view.h>

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderingOpenGLConfigure.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <memory>

#ifdef VTK_USE_X
#include <X11/Xlib.h>
#endif

namespace pcl {
namespace crest {

namespace {

#ifdef VTK_USE_X
/** What the X display lacks, or nothing. The connection stays open as long as the
 * program runs: a server whose last client leaves, as under xvfb-run, starts anew, and
 * would turn away VTK, which comes next.
 */
std::string
missingFromDisplay ()
{
  static const std::unique_ptr<Display, int (*) (Display*)> display (
      XOpenDisplay (nullptr), XCloseDisplay);
  if (display == nullptr)
    return "an X display";
  int unused;
  return XQueryExtension (display.get(), "GLX", &unused, &unused, &unused) != 0
             ? ""
             : "an X display with OpenGL (GLX)";
}
#else
std::string
missingFromDisplay ()
{
  return "";
}
#endif

} // namespace

bool
canRender (std::string& error)
{
  std::string missing = missingFromDisplay();
  if (missing.empty() && vtkNew<vtkRenderWindow>()->SupportsOpenGL() == 0)
    missing = "an X display with OpenGL 3.2";
  if (missing.empty())
    return true;
  error = "needs " + missing + ": run under xvfb-run or set DISPLAY";
  return false;
}

std::string
renderPicture (vtkRenderWindow& window)
{
  window.Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput (&window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection (image->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return {reinterpret_cast<const char*> (bytes->GetPointer (0)),
          static_cast<std::size_t> (bytes->GetNumberOfValues())};
}

} // namespace crest
} // namespace pcl
