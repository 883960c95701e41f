// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are a file of the format of FUZZED_FILE, or refused with a ReadError: to
// the points near the origin and the normals of faces.
#include "fuzzed_file.h"
#include "io/file_faces.h"
#include "io/placement.h"
#include "io/read_content.h"
#include "normals/face_normals.h"

#include <cstdint>
#include <cstdlib>

using namespace pcl::crest;

extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* bytes, std::size_t size)
{
  try {
    PlacedContent content = placeContent (
        parseContent (FUZZED_FILE,
                      std::string (reinterpret_cast<const char*> (bytes), size),
                      ReadOptions()));
    const std::size_t points = content.points->size();
    const auto are_of_points = [points] (std::size_t count) {
      return count == 0 || count == points;
    };
    if (points == 0 ||
        points != std::size_t (content.points->width) * content.points->height ||
        !are_of_points (content.colors.size()) ||
        content.fields.records.size() != points * content.fields.record_size)
      std::abort();
    if (!content.faces.ends.empty()) {
      unifyFaces (content);
      faceNormals (viewOf (*content.points), content.faces);
    }
  }
  catch (const ReadError& error) {
    if (std::string (error.what()).empty())
      std::abort();
  }
  return 0;
}
