// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_files.h"

#include <fstream>

namespace accuracy {

bool
writeCloud (const pcl::PointCloud<pcl::PointNormal>& cloud, const std::string& file)
{
  std::ofstream stream (file);
  stream.precision (9);
  stream << "ply\nformat ascii 1.0\nelement vertex " << cloud.size() << '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    stream << "property float " << name << '\n';
  stream << "end_header\n";
  for (const pcl::PointNormal& p : cloud)
    stream << p.x << ' ' << p.y << ' ' << p.z << ' ' << p.normal_x << ' ' << p.normal_y
           << ' ' << p.normal_z << '\n';
  stream.close();
  return !stream.fail();
}

bool
writeScan (const pcl::PointCloud<pcl::PointXYZ>& cloud, const std::string& file)
{
  std::ofstream stream (file);
  stream.precision (9);
  stream << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
         << cloud.width << "\nHEIGHT " << cloud.height << "\nVIEWPOINT "
         << cloud.sensor_origin_.head<3>().transpose() << " 1 0 0 0\nPOINTS "
         << cloud.size() << "\nDATA ascii\n";
  for (const pcl::PointXYZ& p : cloud)
    stream << p.x << ' ' << p.y << ' ' << p.z << '\n';
  stream.close();
  return !stream.fail();
}

bool
writeTruth (const std::vector<oracle::TruthSegment>& truth, const std::string& file)
{
  std::ofstream stream (file);
  stream.precision (9);
  std::size_t vertices = 0;
  const auto write = [&] (const std::vector<oracle::TruthSegment>& segments,
                          pcl::crest::CrestType type,
                          const std::string& group) {
    stream << "g " << group << '\n';
    for (const oracle::TruthSegment& s : segments) {
      if (s.type != type)
        continue;
      for (const Eigen::Vector3d& p : {s.a, s.b})
        stream << "v " << p.transpose() << '\n';
      stream << "l " << vertices + 1 << ' ' << vertices + 2 << '\n';
      vertices += 2;
    }
  };
  const std::vector<oracle::TruthSegment> salient = oracle::salientLines (truth);
  for (const pcl::crest::CrestType type : pcl::crest::CREST_TYPES) {
    const std::string name = type == pcl::crest::CrestType::RIDGE ? "ridge" : "valley";
    write (truth, type, name);
    write (salient, type, name + "_salient");
  }
  stream.close();
  return !stream.fail();
}

} // namespace accuracy
