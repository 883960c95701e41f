// SPDX-License-Identifier: BSD-3-Clause
// Back from parameters to the options that set them.
#pragma once

#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/parameters.h>

#include <string>

namespace pcl {
namespace crest {

/** \brief The options of addEstimationOptions that give these parameters, those at
 * their defaults left out; each with a space before it.
 * \param[in] parameters points_per_quadrant and max_normal_angle, which have no option,
 * at their defaults
 */
std::string
optionsOf (const Parameters& parameters);

/** \brief The options of addReadingOptions that give this cloud with its normals. */
std::string
optionsOf (const InputCloud& cloud);

/** \brief A word as the shell reads it back, quoted if need be. */
std::string
quoted (const std::string& word);

} // namespace crest
} // namespace pcl
