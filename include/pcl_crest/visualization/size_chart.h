// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.7: the chart that the choice of S is made from.
#pragma once

#include <pcl_crest/crest_line.h>
#include <pcl_crest/parameters.h>
#include <pcl_crest/types.h>

#include <vtkBlockItem.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace pcl {
namespace crest {

/** \brief How many lines there are of each size, in the upper right corner of a
 * renderer: ridges blue, valleys red, and a black line where S cuts.
 */
class PCL_CREST_EXPORT SizeChart {
public:
  /** \brief Puts itself into a renderer; it is hidden at first. */
  explicit SizeChart (vtkRenderer* renderer);
  ~SizeChart();
  SizeChart (const SizeChart&) = delete;
  SizeChart&
  operator= (const SizeChart&) = delete;

  /** \brief Shows other sizes, at the next rendering.
   * \param[in] sizes before small lines were removed
   * \param[in] min_size S for each type; of two different ones both cuts are drawn
   */
  void
  setSizes (const PerType<LineSizes>& sizes, const PerType<int>& min_size);

  /** \brief Whether the numbers of lines are shown by their logarithms. */
  void
  setLogarithmic (bool logarithmic);

  bool
  isLogarithmic () const
  {
    return logarithmic_;
  }
  void
  setVisible (bool visible);
  bool
  isVisible () const;

private:
  void
  draw ();
  void
  place ();

  vtkSmartPointer<vtkRenderer> renderer_;
  vtkNew<vtkContextActor> actor_;
  /** the chart's own background lacks what is beside its axes */
  vtkNew<vtkBlockItem> background_;
  vtkNew<vtkChartXY> chart_;
  PerType<LineSizes> sizes_;
  PerType<int> min_size_{0, 0};
  bool logarithmic_ = false;
  unsigned long observer_ = 0;
};

} // namespace crest
} // namespace pcl
