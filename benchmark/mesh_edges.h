// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sharp_edges.h"

#include <string>

namespace accuracy {

/** \brief Reads the vertices and faces of an OBJ or a text OFF file. The cloud is the
 * vertices with the means of their faces' normals; the edges are those between two
 * faces whose normals differ by more than eight degrees.
 * \param[out] error what is wrong with the file, if anything
 */
SharpObject
readSharpMesh (const std::string& file, std::string& error);

} // namespace accuracy
