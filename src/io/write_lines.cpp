// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/write_lines.h>

#include "io/line_file.h"
#include "io/output_file.h"

#include <algorithm>
#include <filesystem>

namespace pcl {
namespace crest {

namespace {

using Writer = std::string (*) (const LinePoints& points,
                                const std::vector<CrestLine>& lines);

/** \brief A format by its extension; OBJ, which takes two files, has no writer here. */
struct LineFormat {
  const char* extension;
  Writer write;
};

constexpr LineFormat FORMATS[] = {{".obj", nullptr},
                                  {".ply", &toPly},
                                  {".vtk", &toVtk},
                                  {".vtp", &toVtp},
                                  {".dxf", &toDxf},
                                  {".geojson", &toGeoJson},
                                  {".csv", &toCsv}};

} // namespace

std::vector<std::string>
lineExtensions ()
{
  std::vector<std::string> extensions;
  for (const LineFormat& format : FORMATS)
    extensions.emplace_back (format.extension);
  return extensions;
}

std::vector<std::string>
lineFiles (const std::string& file)
{
  if (extensionOf (file) != ".obj")
    return {file};
  return {file, std::filesystem::path (file).replace_extension (".mtl").string()};
}

bool
writeLines (const std::string& file,
            const pcl::PointCloud<pcl::PointNormal>& cloud,
            const std::vector<CrestLine>& lines,
            std::string& error,
            const Placement& placement)
{
  if (!hasExtension (file, lineExtensions(), error))
    return false;
  const LinePoints points (cloud, lines, placement);
  const std::vector<std::string> files = lineFiles (file);
  if (files.size() == 2) {
    const std::string materials = std::filesystem::path (files[1]).filename().string();
    return replaceFiles (
        {{files[1], toMtl()}, {file, toObj (points, lines, materials)}}, error);
  }
  const std::string extension = extensionOf (file);
  const LineFormat* const format =
      std::find_if (std::begin (FORMATS),
                    std::end (FORMATS),
                    [&] (const LineFormat& f) { return extension == f.extension; });
  return replaceFile (file, format->write (points, lines), error);
}

} // namespace crest
} // namespace pcl
