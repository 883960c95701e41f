// SPDX-License-Identifier: BSD-3-Clause
// Parametric surfaces with exact derivatives: the oracle of the tests.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace oracle {

/** \brief Position and partial derivatives of a surface up to the third order:
 * d[i][j] is the i-th derivative by u and the j-th by v, for i + j <= 3.
 */
struct Derivatives {
  Eigen::Vector3d d[4][4];
};

/** \brief A parametric surface over [u_min, u_max] x [v_min, v_max], its parameters
 * turned so that the normal x_u cross x_v points outward (or up).
 */
struct AnalyticSurface {
  std::string name;
  double u_min, u_max, v_min, v_max;
  std::function<Eigen::Vector3d (double, double)> position;
  /** by automatic differentiation, exact to rounding */
  std::function<Derivatives (double, double)> derivatives;
};

AnalyticSurface
sphere (double radius);
AnalyticSurface
plane ();
AnalyticSurface
cylinder (double radius);
AnalyticSurface
torus (double large_radius, double small_radius);
AnalyticSurface
ellipsoid (double a, double b, double c);
/** \brief A Gaussian ridge that winds over a plane, with a valley along either foot. */
AnalyticSurface
wavyRidge ();
/** \brief A sphere with six elongated Gaussian bumps. */
AnalyticSurface
bumpySphere ();
/** \brief x^6 + y^6 + z^6 = 1, a cube with rounded edges and corners. */
AnalyticSurface
roundedBox ();
/** \brief A torus with an elliptic tube: closed ridges on top and bottom. */
AnalyticSurface
ellipticTorus ();
/** \brief A winding ridge and, apart from it, a winding valley. */
AnalyticSurface
ridgeAndValley ();

Eigen::Vector3d
unitNormal (const AnalyticSurface& surface, double u, double v);

/** \brief About `count` points spread evenly over the surface at random (Poisson
 * disks), with exact normals. The same seed gives the same cloud.
 * \param[out] parameters the (u, v) of each point, if wanted
 */
pcl::PointCloud<pcl::PointNormal>::Ptr
sample (const AnalyticSurface& surface,
        std::size_t count,
        unsigned seed = 1,
        std::vector<Eigen::Vector2d>* parameters = nullptr);

/** \brief Mean distance to the 6 nearest neighbours. */
double
meanSpacing (const pcl::PointCloud<pcl::PointNormal>& cloud);

} // namespace oracle
