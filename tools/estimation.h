// SPDX-License-Identifier: BSD-3-Clause
// From a file to its crest lines, as all programs do it.
#pragma once

#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>

#include "program.h"

#include <functional>
#include <memory>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The cloud of a file and what was extracted from it. */
struct Estimate {
  InputCloud cloud;
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  pcl::PointCloud<pcl::Label> labels;
};

/** \brief Gives an estimation a cloud, and all that is known of its normals. */
inline void
setInput (const InputCloud& cloud,
          pcl::CrestLineEstimation<pcl::PointNormal>& estimation)
{
  estimation.setInputCloud (cloud.points);
  if (cloud.estimate) {
    estimation.setSignTrust ({cloud.estimate, &cloud.estimate->trust});
    estimation.setSampleNodes (cloud.estimate->nodes);
  }
  else if (cloud.sampled.sides_agree)
    estimation.setSignTrust (
        std::make_shared<const std::vector<float>> (cloud.points->size(), 1.0F));
  if (const auto& viewpoint = cloud.options.normals.viewpoint) {
    const Eigen::Vector3f place = cloud.placement.toCloud (*viewpoint);
    estimation.setViewPoint (place.x(), place.y(), place.z());
  }
  if (const auto& up = cloud.options.normals.up)
    estimation.setUpDirection (up->x(), up->y(), up->z());
}

/** \brief Reads a file and computes its labels and lines.
 * \param[in] file the path
 * \param[in] parameters those of the estimation
 * \param[in] options how to read it
 * \param[in] tell called with what was read, before the computation
 * \param[in] progress told how far the computation is
 * \param[out] result all of it
 * \param[out] error on failure what is wrong
 * \return EXIT_DONE, or the code to exit with
 */
ExitCode
estimate (const std::string& file,
          const Parameters& parameters,
          const ReadOptions& options,
          const std::function<void (const InputCloud&)>& tell,
          const ProgressCallback& progress,
          Estimate& result,
          std::string& error);

} // namespace crest
} // namespace pcl
