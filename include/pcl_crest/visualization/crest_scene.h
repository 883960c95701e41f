// SPDX-License-Identifier: BSD-3-Clause
// The component visualization: clouds, lines, charts and views in windows and pictures
// of VTK, which no other room knows. It shows what others have computed.
#pragma once

#include <pcl_crest/crest_line.h>
#include <pcl_crest/types.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vtkActor.h>
#include <vtkAxesActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <memory>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The crest lines of a cloud as one polydata with a colour per line: ridges
 * blue, valleys red.
 */
PCL_CREST_EXPORT vtkSmartPointer<vtkPolyData>
makeLinePolyData (const pcl::PointCloud<pcl::PointNormal>& cloud,
                  const std::vector<CrestLine>& lines);

struct SurfaceSplats;

/** \brief Draws every valid point as a small polygon, large enough to reach its
 * neighbours, so that the points cover the surface whatever their local density.
 *
 * The corners lie on the surface that the neighbours' tangent planes tell of, with the
 * normals in between theirs: flat discs would shade a curved surface in facets, and
 * stand out as beads along its edges. Points without a normal are not drawn.
 */
PCL_CREST_EXPORT std::shared_ptr<const SurfaceSplats>
makeSurfaceSplats (const pcl::PointCloud<pcl::PointNormal>& cloud);

/** \brief A cloud as a grey surface with its crest lines, on white: what a window or a
 * picture shows. Its renderer can be put into any vtkRenderWindow, or be given to
 * PCLVisualizer, and may outlive the scene.
 */
class PCL_CREST_EXPORT CrestScene {
public:
  CrestScene();
  ~CrestScene();
  CrestScene (const CrestScene&) = delete;
  CrestScene&
  operator= (const CrestScene&) = delete;

  vtkRenderer*
  getRenderer () const
  {
    return renderer_;
  }

  /** \brief Shows another cloud, without lines. */
  void
  setCloud (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud);

  /** \brief The same with splats that were made before, which takes time and can be
   * done in another thread.
   */
  void
  setCloud (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud,
            const SurfaceSplats& splats);

  /** \brief Shows the points of a cloud as dots, without lines, before more is known of
   * it than where they are.
   */
  void
  setPoints (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud);

  /** \brief Shows other lines, at the next rendering.
   * \param[in] lines indices into the cloud shown
   */
  void
  setLines (const std::vector<CrestLine>& lines);

  /** \brief Shows lines that do not run through the points of the cloud shown.
   * \param[in] lines indices into line_cloud
   * \param[in] line_cloud as CrestLineEstimation::getLineCloud gives it
   */
  void
  setLines (const std::vector<CrestLine>& lines,
            const pcl::PointCloud<pcl::PointNormal>& line_cloud);

  /** \brief Draws some of the lines once more, thicker and yellow, until others are
   * shown or highlighted.
   * \param[in] lines none for none
   * \param[in] line_cloud as for setLines
   */
  void
  setHighlight (const std::vector<CrestLine>& lines,
                const pcl::PointCloud<pcl::PointNormal>& line_cloud);

  /** \brief A color, red, green and blue up to 255. */
  using Color = std::array<unsigned char, 3>;

  /** \brief Colors the surface.
   * \param[in] colors one for each point of the cloud shown; none for all grey
   * \param[in] shaded by the normals, or exactly these colors as dots always are
   */
  void
  setColors (const std::vector<Color>& colors, bool shaded = true);

  /** \brief Draws the points as dots of so many pixels, or as a surface if that is 0,
   * as at first. Of more than 300 thousand points every so many are drawn, as dots,
   * while the view is turned by the mouse.
   */
  void
  setPointSize (int pixels);
  int
  getPointSize () const
  {
    return point_size_;
  }

  /** \brief How much of what is behind the surface it covers, 0 to 1. */
  void
  setOpacity (double opacity);

  /** \brief In pixels. */
  void
  setLineWidth (double pixels);
  double
  getLineWidth () const;

  /** \brief Draws strokes over the surface, as directions at its points.
   * \param[in] strokes lines; none to show none
   */
  void
  setStrokes (vtkPolyData* strokes);

  /** \brief Draws the axes x red, y green and z blue from the origin.
   * \param[in] length in the cloud's unit; 0 for none
   */
  void
  setAxes (double length);

  void
  setLinesVisible (bool visible);

  void
  setSurfaceVisible (bool visible);
  bool
  isSurfaceVisible () const
  {
    return surface_visible_;
  }

  /** \brief The place among the lines of the one that is seen within a few pixels of a
   * place in the renderer's window, or -1. The window shows what was rendered last.
   */
  int
  pickLine (int x, int y);

private:
  /** \brief Shows dots or surface, or none; of many points few while the window has to
   * be fast, as it is told by its desired update rate while the mouse turns the view.
   */
  void
  choose ();

  /** \brief Before each picture. */
  void
  prepare ();

  /** \brief Brings lines and strokes nearer to the camera by a little more than the
   * surface's uncertainty, and leaves them where they are in the picture. Lines on the
   * far side stay hidden, as that is farther away.
   */
  void
  liftLines ();

  pcl::PointCloud<pcl::PointNormal>::ConstPtr cloud_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkActor> surface_;
  vtkNew<vtkActor> dots_;
  /** few of them */
  vtkNew<vtkActor> coarse_;
  vtkNew<vtkActor> strokes_;
  vtkNew<vtkAxesActor> axes_;
  vtkNew<vtkActor> lines_;
  vtkNew<vtkActor> highlight_;
  /** for each polygon of the surface its point */
  std::vector<index_t> drawn_;
  /** every so many of these are among the few */
  std::size_t coarse_step_ = 1;
  /** for each cell of the lines its line */
  std::vector<int> line_of_cell_;
  double lift_ = 0.0;
  int point_size_ = 0;
  bool surface_visible_ = true;
  unsigned long observer_ = 0;
};

} // namespace crest
} // namespace pcl
