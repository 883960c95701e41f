// SPDX-License-Identifier: BSD-3-Clause
// crest_reading FOLDER POINTS ...: how fast files of so many points are read, beside
// PCL's readers of the same files, and what memory that takes. Writes them into FOLDER,
// takes them away again, and prints a table. Each is read in a process of its own,
// seven times, of which the middle one counts, and once from ten million points on.
// Times are those of a processor, which other work on the machine changes least; no
// reader has two threads.
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include "io/parse_number.h"
#include "io/placement.h"
#include "io/read_content.h"
#include "peak_memory.h"
#include "support/las_file.h"
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>

using namespace pcl::crest;

namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

/** \brief What reading a file took. */
struct Cost {
  double seconds = 0.0;
  /** bytes at the peak, and of the cloud with all that it carries */
  double memory = 0.0;
  double cloud = 0.0;
};

/** \brief A sheet of waves, which no format can tell in fewer bytes than it takes. */
Cloud
waves (std::size_t points)
{
  Cloud cloud;
  cloud.resize (points);
  const auto side = static_cast<std::size_t> (std::sqrt (static_cast<double> (points)));
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t row = i / side;
    const float x = 0.01F * static_cast<float> (i % side);
    const float y = 0.01F * static_cast<float> (row);
    pcl::PointNormal& p = cloud[i];
    p.getVector3fMap() = Eigen::Vector3f (x, y, std::sin (x) * std::sin (y));
    p.getNormalVector3fMap() = Eigen::Vector3f (-std::cos (x) * std::sin (y),
                                                -std::sin (x) * std::cos (y),
                                                1.0F)
                                   .normalized();
  }
  return cloud;
}

void
writeText (const Cloud& cloud, const std::string& file)
{
  std::ofstream stream (file);
  stream.precision (7);
  for (const pcl::PointNormal& p : cloud)
    stream << p.x << ' ' << p.y << ' ' << p.z << ' ' << p.normal_x << ' ' << p.normal_y
           << ' ' << p.normal_z << '\n';
}

void
writeLas (const Cloud& cloud, const std::string& file)
{
  constexpr std::size_t POINTS_BYTE = 107;
  std::string header = oracle::LasFile().bytes();
  const auto points = static_cast<std::uint32_t> (cloud.size());
  std::memcpy (header.data() + POINTS_BYTE, &points, sizeof (points));
  std::ofstream stream (file);
  stream << header;
  std::array<char, 20> record{};
  for (const pcl::PointNormal& p : cloud) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto steps =
          static_cast<std::int32_t> (std::lround (1000.0F * p.data[axis]));
      std::memcpy (record.data() + sizeof (steps) * axis, &steps, sizeof (steps));
    }
    stream.write (record.data(), record.size());
  }
}

/** \brief What work costs in a process of its own. */
Cost
costOf (const std::function<double()>& work)
{
  void* const shared = ::mmap (nullptr,
                               sizeof (Cost),
                               PROT_READ | PROT_WRITE,
                               MAP_SHARED | MAP_ANONYMOUS,
                               -1,
                               0);
  auto* const cost = new (shared) Cost;
  if (::fork() == 0) {
    cost->memory = static_cast<double> (performance::peakMemory ([&] {
      const std::clock_t start = std::clock();
      cost->cloud = work();
      cost->seconds = static_cast<double> (std::clock() - start) / CLOCKS_PER_SEC;
    }));
    ::_exit (0);
  }
  ::wait (nullptr);
  const Cost result = *cost;
  ::munmap (shared, sizeof (Cost));
  return result;
}

/** \brief That of several runs with the middle time. */
Cost
middleCost (std::size_t runs, const std::function<double()>& work)
{
  std::vector<Cost> costs (runs);
  for (Cost& cost : costs)
    cost = costOf (work);
  std::sort (costs.begin(), costs.end(), [] (const Cost& a, const Cost& b) {
    return a.seconds < b.seconds;
  });
  return costs[runs / 2];
}

/** \brief Reads a file as readCloud does; the bytes of what it gives. */
double
readOurs (const std::string& file)
{
  const PlacedContent content = placeContent (readContent (file, {}));
  return static_cast<double> (content.points->size() * sizeof (pcl::PointNormal) +
                              content.fields.records.size() +
                              3 * content.colors.size());
}

/** \brief A kind of file, and what reads and writes it. */
struct Kind {
  std::string name;
  std::string file;
  std::function<void (const Cloud& cloud, const std::string& file)> write;
  std::function<int (const std::string& file, Cloud& cloud)> read_by_pcl;
};

std::vector<Kind>
kinds ()
{
  const auto pcd = [] (const std::string& file, Cloud& cloud) {
    return pcl::io::loadPCDFile (file, cloud);
  };
  const auto ply = [] (const std::string& file, Cloud& cloud) {
    return pcl::io::loadPLYFile (file, cloud);
  };
  return {{"PCD, binary",
           "binary.pcd",
           [] (const Cloud& cloud, const std::string& file) {
             pcl::io::savePCDFileBinary (file, cloud);
           },
           pcd},
          {"PCD, compressed",
           "compressed.pcd",
           [] (const Cloud& cloud, const std::string& file) {
             pcl::io::savePCDFileBinaryCompressed (file, cloud);
           },
           pcd},
          {"PLY, binary",
           "binary.ply",
           [] (const Cloud& cloud, const std::string& file) {
             pcl::io::savePLYFileBinary (file, cloud);
           },
           ply},
          {"LAS", "points.las", &writeLas, nullptr},
          {"text of six columns", "points.xyz", &writeText, nullptr}};
}

void
measure (const Kind& kind, const std::string& folder, std::size_t points)
{
  constexpr std::size_t MANY = 10000000;
  const std::size_t runs = points < MANY ? 7 : 1;
  const std::string file = folder + "/" + kind.file;
  // A process of its own, so that what it leaves is in none of the others.
  costOf ([&] {
    kind.write (waves (points), file);
    return 0.0;
  });
  const auto megabytes = static_cast<double> (std::filesystem::file_size (file)) / 1e6;
  const Cost ours = middleCost (runs, [&] { return readOurs (file); });
  std::cout << "| " << kind.name << " | " << points << " | " << std::fixed
            << std::setprecision (0) << megabytes << " | " << std::setprecision (2)
            << ours.seconds << " | " << std::setprecision (0)
            << megabytes / ours.seconds << " | " << std::setprecision (2);
  if (kind.read_by_pcl) {
    const Cost by_pcl = middleCost (runs, [&] {
      Cloud cloud;
      kind.read_by_pcl (file, cloud);
      return static_cast<double> (cloud.size() * sizeof (pcl::PointNormal));
    });
    std::cout << ours.seconds / by_pcl.seconds << " | " << ours.memory / ours.cloud
              << " | " << by_pcl.memory / by_pcl.cloud;
  }
  else
    std::cout << "- | " << ours.memory / ours.cloud << " | -";
  std::cout << " |\n" << std::flush;
  std::filesystem::remove (file);
}

} // namespace

int
main (int argc, char** argv)
{
  std::vector<std::size_t> sizes;
  bool right = argc > 2;
  for (int i = 2; i < argc; ++i)
    right = parseNumber (argv[i], sizes.emplace_back()) && sizes.back() > 0 && right;
  if (!right) {
    std::cerr << "Usage: crest_reading FOLDER POINTS ...\n";
    return 1;
  }
  pcl::console::setVerbosityLevel (pcl::console::L_ERROR);
  std::cout << "| file | points | MB | s | MB/s | time / PCL's | memory / cloud | "
               "PCL's |\n|---|---|---|---|---|---|---|---|\n";
  for (const std::size_t points : sizes)
    for (const Kind& kind : kinds())
      measure (kind, argv[1], points);
  return 0;
}
