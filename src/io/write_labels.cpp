// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/write_labels.h>

#include "io/output_file.h"
#include "io/point_file.h"

#include <vector>

namespace pcl {
namespace crest {

namespace {

/** \brief For each point the strongest line through it. */
struct LinesOfPoints {
  /** -1 where there is none */
  std::vector<std::int32_t> places;
  std::vector<float> strengths;

  LinesOfPoints (const std::vector<CrestLine>& lines, std::size_t points)
  : places (points, -1), strengths (points, 0.0F)
  {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto strength = static_cast<float> (lines[i].strength);
      for (const std::vector<index_t>& polyline : lines[i].polylines)
        for (const index_t point : polyline) {
          const auto p = static_cast<std::size_t> (point);
          if (places[p] >= 0 && strengths[p] >= strength)
            continue;
          places[p] = static_cast<std::int32_t> (i);
          strengths[p] = strength;
        }
    }
  }
};

} // namespace

std::vector<std::string>
labelExtensions ()
{
  return {".pcd", ".ply", ".las"};
}

bool
writeLabels (const std::string& file,
             const InputCloud& cloud,
             const pcl::PointCloud<pcl::Label>& labels,
             const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
             const std::vector<CrestLine>& lines,
             std::string& error)
{
  const LinesOfPoints of_points (lines, cloud.points->size());
  PointFile points{*cloud.points, cloud.placement};
  points.columns = {
      columnOf<pcl::PrincipalCurvatures> (
          "curvature", &curvatures.points.data()->pc1, NumberType::FLOAT32),
      columnOf<pcl::Label> ("label", &labels.points.data()->label, NumberType::UINT32),
      columnOf<std::int32_t> ("line", of_points.places.data(), NumberType::INT32),
      columnOf<float> ("strength", of_points.strengths.data(), NumberType::FLOAT32)};
  points.fields = &cloud.fields;
  points.colors = cloud.colors.empty() ? nullptr : &cloud.colors;
  points.labels = &labels;
  const std::string extension = extensionOf (file);
  if (extension == ".pcd")
    return replaceFile (file, toPcd (points), error);
  if (extension == ".ply")
    return replaceFile (file, toPly (points), error);
  if (!hasExtension (file, labelExtensions(), error))
    return false;
  std::string unfit;
  const std::string text = toLas (points, unfit);
  if (unfit.empty())
    return replaceFile (file, text, error);
  error = file + ": " + unfit;
  return false;
}

bool
writeCurvatures (const std::string& file,
                 const pcl::PointCloud<pcl::PointNormal>& cloud,
                 const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
                 std::string& error,
                 const Placement& placement)
{
  const pcl::PrincipalCurvatures* const first = curvatures.points.data();
  PointFile points{cloud, placement};
  const auto add = [&points] (const char* name, const float* number) {
    points.columns.push_back (
        columnOf<pcl::PrincipalCurvatures> (name, number, NumberType::FLOAT32));
  };
  add ("principal_curvature_x", &first->principal_curvature_x);
  add ("principal_curvature_y", &first->principal_curvature_y);
  add ("principal_curvature_z", &first->principal_curvature_z);
  add ("pc1", &first->pc1);
  add ("pc2", &first->pc2);
  return replaceFile (file, toPcd (points), error);
}

} // namespace crest
} // namespace pcl
