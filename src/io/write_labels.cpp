// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/write_labels.h>

#include "io/format_number.h"
#include "io/output_file.h"
#include "io/placement.h"

#include <vector>

namespace pcl {
namespace crest {

namespace {

struct Field {
  const char* name;
  /** as in a PCD header: F for a floating point number, U for unsigned */
  char type;
  std::size_t size;
};

/** \brief A binary PCD file, point by point. pcl::PCDWriter writes a file in place,
 * where it stays in part if the disk is full.
 */
class PcdText {
public:
  /** \param[in] more the fields that follow those of the points */
  PcdText (const pcl::PointCloud<pcl::PointNormal>& cloud,
           const Placement& placement,
           const std::vector<Field>& more)
  : cloud_ (cloud)
  , placement_ (placement)
  , has_doubles_ (needsDoubles (placement))
  , next_apart_ (placement.apart.begin())
  {
    const std::size_t size = has_doubles_ ? sizeof (double) : sizeof (float);
    std::vector<Field> fields{{"x", 'F', size},
                              {"y", 'F', size},
                              {"z", 'F', size},
                              {"normal_x", 'F', sizeof (float)},
                              {"normal_y", 'F', sizeof (float)},
                              {"normal_z", 'F', sizeof (float)}};
    fields.insert (fields.end(), more.begin(), more.end());
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
    line ("SIZE", [] (const Field& field) { return std::to_string (field.size); });
    line ("TYPE", [] (const Field& field) { return field.type; });
    line ("COUNT", [] (const Field&) { return '1'; });
    text_ += "WIDTH " + std::to_string (cloud.width) + "\nHEIGHT " +
             std::to_string (cloud.height) + "\nVIEWPOINT";
    addViewpoint();
    text_ += "\nPOINTS " + std::to_string (cloud.size()) + "\nDATA binary\n";
    std::size_t point_size = 0;
    for (const Field& field : fields)
      point_size += field.size;
    text_.reserve (text_.size() + cloud.size() * point_size);
  }

  template <typename T>
  void
  add (T value)
  {
    text_.append (reinterpret_cast<const char*> (&value), sizeof (T));
  }

  /** \brief To be called for one point after the other. */
  void
  addPoint (std::size_t i)
  {
    const pcl::PointNormal& point = cloud_[i];
    const bool is_apart = next_apart_ != placement_.apart.end() &&
                          static_cast<std::size_t> (next_apart_->index) == i;
    const Eigen::Vector3f in_cloud = point.getVector3fMap();
    const Eigen::Vector3d in_file =
        is_apart ? (next_apart_++)->position : placement_.toFile (in_cloud);
    for (int axis = 0; axis < 3; ++axis)
      if (has_doubles_)
        add (in_file[axis]);
      else
        add (is_apart ? static_cast<float> (in_file[axis]) : in_cloud[axis]);
    for (const float value : {point.normal_x, point.normal_y, point.normal_z})
      add (value);
  }

  const std::string&
  text () const
  {
    return text_;
  }

private:
  void
  addViewpoint ()
  {
    const Eigen::Vector3f origin = cloud_.sensor_origin_.head<3>();
    text_ += ' ';
    // PCL's default, which tells nothing of a sensor, is the same everywhere.
    appendPlace (text_, origin, origin.isZero (0.0F) ? Placement() : placement_);
    const Eigen::Quaternionf& q = cloud_.sensor_orientation_;
    for (const float number : {q.w(), q.x(), q.y(), q.z()}) {
      text_ += ' ';
      appendNumber (text_, number);
    }
  }

  const pcl::PointCloud<pcl::PointNormal>& cloud_;
  const Placement& placement_;
  bool has_doubles_;
  std::vector<Placement::PointApart>::const_iterator next_apart_;
  std::string text_;
};

} // namespace

bool
writeLabels (const std::string& file,
             const pcl::PointCloud<pcl::PointNormal>& cloud,
             const pcl::PointCloud<pcl::Label>& labels,
             const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
             std::string& error,
             const Placement& placement)
{
  PcdText pcd (cloud, placement, {{"curvature", 'F', 4}, {"label", 'U', 4}});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    pcd.addPoint (i);
    pcd.add (curvatures[i].pc1);
    pcd.add (labels[i].label);
  }
  return replaceFile (file, pcd.text(), error);
}

bool
writeCurvatures (const std::string& file,
                 const pcl::PointCloud<pcl::PointNormal>& cloud,
                 const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
                 std::string& error,
                 const Placement& placement)
{
  PcdText pcd (cloud,
               placement,
               {{"principal_curvature_x", 'F', 4},
                {"principal_curvature_y", 'F', 4},
                {"principal_curvature_z", 'F', 4},
                {"pc1", 'F', 4},
                {"pc2", 'F', 4}});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const pcl::PrincipalCurvatures& c = curvatures[i];
    pcd.addPoint (i);
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
