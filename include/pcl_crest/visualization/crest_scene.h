// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_lines.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace pcl {
namespace crest {

/** \brief The crest lines of a cloud as one polydata with a colour per line: ridges
 * blue, valleys red.
 */
vtkSmartPointer<vtkPolyData>
makeLinePolyData (const pcl::PointCloud<pcl::PointNormal>& cloud,
                  const std::vector<CrestLine>& lines);

/** \brief A cloud as a grey surface with its crest lines, on white: what a window or a
 * picture shows. Its renderer can be put into any vtkRenderWindow, or be given to
 * PCLVisualizer, and may outlive the scene.
 */
class CrestScene {
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

  /** \brief A color, red, green and blue up to 255. */
  using Color = std::array<unsigned char, 3>;

  /** \brief Colors the surface, shaded as before.
   * \param[in] colors one for each point of the cloud shown; none for all grey
   */
  void
  setColors (const std::vector<Color>& colors);

  void
  setSurfaceVisible (bool visible);
  bool
  isSurfaceVisible () const;

  /** \brief The place among the lines of the one within a few pixels of a place in the
   * renderer's window, or -1.
   */
  int
  pickLine (int x, int y);

private:
  /** \brief Brings the lines nearer to the camera by a little more than the surface's
   * uncertainty, and leaves them where they are in the picture. Lines on the far side
   * stay hidden, as that is farther away.
   */
  void
  liftLines ();

  pcl::PointCloud<pcl::PointNormal>::ConstPtr cloud_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkActor> surface_;
  vtkNew<vtkActor> lines_;
  /** for each polygon of the surface its point */
  std::vector<index_t> drawn_;
  /** for each cell of the lines its line */
  std::vector<int> line_of_cell_;
  double lift_ = 0.0;
  unsigned long observer_ = 0;
};

} // namespace crest
} // namespace pcl
