// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_line_estimation.h>

#include <pcl/io/pcd_io.h>

#include <iostream>

int
main (int argc, char** argv)
{
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud (new pcl::PointCloud<pcl::PointNormal>);
  if (argc != 2 || pcl::io::loadPCDFile (argv[1], *cloud) < 0) {
    std::cerr << "usage: example_crest_lines CLOUD_WITH_NORMALS.pcd\n";
    return 1;
  }

  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setTurningAngle (30.0); // degrees that the surface turns across a line
  estimation.setMinLength (8.0);     // of a line, in spacings of the points
  pcl::PointCloud<pcl::Label> labels;
  pcl::PolygonMesh lines;
  estimation.compute (labels, lines);

  for (const pcl::crest::CrestLine& line : estimation.getLines())
    std::cout << (line.type == pcl::crest::CrestType::RIDGE ? "ridge" : "valley")
              << " of " << line.size << " points, length " << line.length << '\n';
}
