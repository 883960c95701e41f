// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/write_lines.h>

#include "io/line_file.h"
#include "io/map_file.h"
#include "io/output_file.h"

#include <algorithm>
#include <filesystem>

namespace pcl {
namespace crest {

namespace {

using Writer = std::string (*) (const LinePoints& points,
                                const std::vector<CrestLine>& lines);

/** \brief A format by its extension; OBJ, which takes two files, and those of GDAL have
 * no writer here.
 */
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
                                  {".csv", &toCsv},
                                  {".gpkg", nullptr},
                                  {".shp", nullptr}};

/** \brief The extensions of the files of a format, the one that is named first. */
std::vector<std::string>
filesOf (const std::string& extension)
{
  if (extension == ".obj")
    return {extension, ".mtl"};
  // The last one tells of no coordinate system that none is known.
  if (extension == ".shp")
    return {extension, ".shx", ".dbf", ".cpg", ".prj"};
  return {extension};
}

bool
writeMap (const std::string& file,
          const LinePoints& points,
          const std::vector<CrestLine>& lines,
          std::string& error)
{
  MapFiles made;
  const std::string extension = extensionOf (file);
  const std::string failure = toMap (extension, points, lines, made);
  if (!failure.empty()) {
    error = file + ": " + failure;
    return false;
  }
  const std::vector<std::string> names = lineFiles (file);
  const std::vector<std::string> extensions = filesOf (extension);
  std::vector<OutputFile> outputs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto content = std::find_if (made.begin(), made.end(), [&] (const auto& m) {
      return m.first == extensions[i];
    });
    outputs.push_back ({names[i], content == made.end() ? "" : content->second});
  }
  return replaceFiles (outputs, error);
}

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
  std::vector<std::string> files;
  for (const std::string& extension : filesOf (extensionOf (file)))
    files.push_back (
        files.empty()
            ? file
            : std::filesystem::path (file).replace_extension (extension).string());
  return files;
}

bool
checkLines (const std::string& file, const std::string& crs, std::string& error)
{
  if (!hasExtension (file, lineExtensions(), error))
    return false;
  const std::string extension = extensionOf (file);
  std::string wrong;
  if (isMapFile (extension))
    wrong = explainNoMaps();
  else if (!crs.empty() && extension != ".geojson")
    wrong = "a coordinate system is written into .geojson, .gpkg and .shp alone";
  if (wrong.empty() && !crs.empty())
    wrong = explainCrs (crs);
  if (!wrong.empty())
    error = file + ": " + wrong;
  return wrong.empty();
}

bool
writeLines (const std::string& file,
            const pcl::PointCloud<pcl::PointNormal>& cloud,
            const std::vector<CrestLine>& lines,
            std::string& error,
            const Placement& placement,
            const std::string& crs)
{
  if (!checkLines (file, crs, error))
    return false;
  const LinePoints points (cloud, lines, placement, crs);
  const std::vector<std::string> files = lineFiles (file);
  const std::string extension = extensionOf (file);
  if (isMapFile (extension))
    return writeMap (file, points, lines, error);
  if (extension == ".obj") {
    const std::string materials = std::filesystem::path (files[1]).filename().string();
    return replaceFiles (
        {{files[1], toMtl()}, {file, toObj (points, lines, materials)}}, error);
  }
  const LineFormat* const format =
      std::find_if (std::begin (FORMATS),
                    std::end (FORMATS),
                    [&] (const LineFormat& f) { return extension == f.extension; });
  return replaceFile (file, format->write (points, lines), error);
}

} // namespace crest
} // namespace pcl
