// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/write_labels.h>

#include "io/format_number.h"
#include "io/output_file.h"

#include <vector>

namespace pcl {
namespace crest {

namespace {

struct Field {
  const char* name;
  /** as in a PCD header: F for float, U for unsigned; all of 4 bytes */
  char type;
};

/** \brief A binary PCD file, point by point. pcl::PCDWriter writes a file in place,
 * where it stays in part if the disk is full.
 */
class PcdText {
public:
  PcdText (const pcl::PointCloud<pcl::PointNormal>& cloud,
           const std::vector<Field>& fields)
  {
    text_ = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n";
    const auto line = [this, &fields] (const char* key, const auto& value) {
      text_ += key;
      for (const Field& field : fields) {
        text_ += ' ';
        text_ += value (field);
      }
      text_ += '\n';
    };
    line ("FIELDS", [] (const Field& field) { return field.name; });
    line ("SIZE", [] (const Field&) { return '4'; });
    line ("TYPE", [] (const Field& field) { return field.type; });
    line ("COUNT", [] (const Field&) { return '1'; });
    text_ += "WIDTH " + std::to_string (cloud.width) + "\nHEIGHT " +
             std::to_string (cloud.height) + "\nVIEWPOINT";
    const Eigen::Quaternionf& q = cloud.sensor_orientation_;
    for (const float number : {cloud.sensor_origin_[0],
                               cloud.sensor_origin_[1],
                               cloud.sensor_origin_[2],
                               q.w(),
                               q.x(),
                               q.y(),
                               q.z()}) {
      text_ += ' ';
      appendNumber (text_, number);
    }
    text_ += "\nPOINTS " + std::to_string (cloud.size()) + "\nDATA binary\n";
    text_.reserve (text_.size() + cloud.size() * fields.size() * 4);
  }

  template <typename T>
  void
  add (T value)
  {
    static_assert (sizeof (T) == 4, "all fields are of 4 bytes");
    text_.append (reinterpret_cast<const char*> (&value), sizeof (T));
  }

  void
  addPoint (const pcl::PointNormal& point)
  {
    for (const float value :
         {point.x, point.y, point.z, point.normal_x, point.normal_y, point.normal_z})
      add (value);
  }

  const std::string&
  text () const
  {
    return text_;
  }

private:
  std::string text_;
};

const std::vector<Field> POINT_FIELDS{{"x", 'F'},
                                      {"y", 'F'},
                                      {"z", 'F'},
                                      {"normal_x", 'F'},
                                      {"normal_y", 'F'},
                                      {"normal_z", 'F'}};

std::vector<Field>
pointFieldsAnd (const std::vector<Field>& more)
{
  std::vector<Field> fields = POINT_FIELDS;
  fields.insert (fields.end(), more.begin(), more.end());
  return fields;
}

} // namespace

bool
writeLabels (const std::string& file,
             const pcl::PointCloud<pcl::PointNormal>& cloud,
             const pcl::PointCloud<pcl::Label>& labels,
             const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
             std::string& error)
{
  PcdText pcd (cloud, pointFieldsAnd ({{"curvature", 'F'}, {"label", 'U'}}));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    pcd.addPoint (cloud[i]);
    pcd.add (curvatures[i].pc1);
    pcd.add (labels[i].label);
  }
  return replaceFile (file, pcd.text(), error);
}

bool
writeCurvatures (const std::string& file,
                 const pcl::PointCloud<pcl::PointNormal>& cloud,
                 const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
                 std::string& error)
{
  PcdText pcd (cloud,
               pointFieldsAnd ({{"principal_curvature_x", 'F'},
                                {"principal_curvature_y", 'F'},
                                {"principal_curvature_z", 'F'},
                                {"pc1", 'F'},
                                {"pc2", 'F'}}));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const pcl::PrincipalCurvatures& c = curvatures[i];
    pcd.addPoint (cloud[i]);
    for (const float value : {c.principal_curvature_x,
                              c.principal_curvature_y,
                              c.principal_curvature_z,
                              c.pc1,
                              c.pc2})
      pcd.add (value);
  }
  return replaceFile (file, pcd.text(), error);
}

} // namespace crest
} // namespace pcl
