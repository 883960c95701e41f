// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_cases.h"

#include <pcl/common/io.h>

#include "depth_cameras.h"
#include "lidar.h"
#include "marching_cubes.h"
#include "noisy_cloud.h"
#include "sensors.h"

#include <sstream>

namespace oracle {

namespace {

using Eigen::Vector3d;

/** In h of the even samples, of each frame and each scan. */
constexpr double NOISE = 0.1;

template <typename Number>
std::string
withNumber (const std::string& before, Number number, const std::string& after)
{
  std::ostringstream words;
  words << before << number << after;
  return words.str();
}

/** \brief Seen from all sides. */
template <typename PointT>
SensorCloud
withoutView (const pcl::PointCloud<PointT>& cloud)
{
  SensorCloud result{pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(), {}};
  pcl::copyPointCloud (cloud, *result.cloud);
  return result;
}

/** \brief Before the scene, looking down on it. */
Eigen::Isometry3d
cameraPose (double size)
{
  return lookAt (size * Vector3d (0.3, -1.7, 1.5), size * Vector3d (0.0, 0.0, 0.1));
}

/** \brief Desks of 1.2 m by structured light, floors of 2 m by time of flight. */
void
addDepthCameras (const Scene& unit_scene, std::vector<SensorCase>& all)
{
  constexpr double DESK = 0.6;
  const Scene desk = scaled (unit_scene, DESK);
  all.push_back ({"structured light", desk, [desk] (unsigned seed) {
                    const Eigen::Isometry3d pose = cameraPose (DESK);
                    return SensorCloud{depthImage (desk.cast, pose, seed).makeShared(),
                                       viewOfDepthCamera (pose)};
                  }});
  all.push_back ({"time of flight", unit_scene, [unit_scene] (unsigned seed) {
                    const Eigen::Isometry3d pose = cameraPose (1.0);
                    return SensorCloud{
                        timeOfFlightImage (unit_scene.cast, pose, seed).makeShared(),
                        viewOfTimeOfFlightCamera (pose)};
                  }});
}

/** \brief On a car in the middle of a yard of 40 m. */
void
addLidars (const Scene& unit_scene, std::vector<SensorCase>& all)
{
  const Scene yard = scaled (unit_scene, 20.0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 1.8;
  for (const int beams : {16, 32, 64, 128})
    all.push_back (
        {withNumber ("lidar of ", beams, " beams"), yard, [=] (unsigned seed) {
           const Lidar lidar = lidarOf (beams);
           return SensorCloud{lidarTurn (lidar, yard.cast, pose, seed).makeShared(),
                              viewOf (lidar, pose)};
         }});
}

void
addScansFromAllSides (const Scene& scene, std::vector<SensorCase>& all)
{
  constexpr std::size_t SAMPLES = 20000;
  constexpr std::size_t SAMPLES_OF_FRAME = 6000;
  for (const int frames : {5, 20, 50})
    all.push_back ({withNumber ("", frames, " frames"), scene, [=] (unsigned seed) {
                      const auto exact = scene.sample (SAMPLES_OF_FRAME, seed);
                      return withoutView (accumulatedFrames (
                          *exact, frames, NOISE * meanSpacing (*exact), seed));
                    }});
  for (const double apart : {0.25, 0.5, 1.0, 2.0})
    all.push_back (
        {withNumber ("two scans ", apart, " h apart"), scene, [=] (unsigned seed) {
           const auto first = scene.sample (SAMPLES, seed);
           const double h = meanSpacing (*first);
           return withoutView (registeredScans (*first,
                                                *scene.sample (SAMPLES, seed + 1),
                                                apart * h * Vector3d (0.36, 0.48, 0.8),
                                                NOISE * h,
                                                seed));
         }});
  for (const double length : {5.0, 10.0})
    all.push_back (
        {withNumber ("photogrammetry over ", length, " h"), scene, [=] (unsigned seed) {
           Photogrammetry how;
           how.correlation_length = length;
           return withoutView (
               photogrammetry (*scene.sample (SAMPLES, seed), how, seed));
         }});
  constexpr double STEP = 0.02;
  for (const auto& [name, values] :
       {std::pair ("marching cubes of distances", GridValues::DISTANCES),
        std::pair ("marching cubes of sides", GridValues::SIDES)})
    all.push_back ({name, scene, [scene, values = values] (unsigned) {
                      return withoutView (marchingCubesVertices (scene, STEP, values));
                    }});
}

} // namespace

std::vector<SensorCase>
sensorCases ()
{
  std::vector<SensorCase> all;
  const Scene sharp = sceneOf (blocks());
  const Scene smooth = heightFieldScene (ridgeAndValley());
  addLidars (sharp, all);
  for (const Scene& scene : {sharp, smooth}) {
    addDepthCameras (scene, all);
    addScansFromAllSides (scene, all);
  }
  return all;
}

} // namespace oracle
