// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "crest_session.h"

namespace pcl {
namespace crest {

/** \brief Crosses along the principal directions at some thousand points at most, of
 * which t1 (of the largest curvature) is the long bar.
 */
vtkSmartPointer<vtkPolyData>
makeDirectionStrokes (const CrestSession& session);

} // namespace crest
} // namespace pcl
