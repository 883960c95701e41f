// SPDX-License-Identifier: BSD-3-Clause
#include "plain_cubic.h"

#include <pcl/search/kdtree.h>

#include <Eigen/Dense>

#include <cmath>

namespace accuracy {

namespace {

double
curvatureOf (const Eigen::MatrixXd& terms, const Eigen::VectorXd& heights)
{
  const Eigen::VectorXd c = terms.colPivHouseholderQr().solve (heights);
  Eigen::Matrix2d first;
  first << 1.0 + c[1] * c[1], c[1] * c[2], c[1] * c[2], 1.0 + c[2] * c[2];
  Eigen::Matrix2d second;
  second << 2.0 * c[3], c[4], c[4], 2.0 * c[5];
  const double norm = std::sqrt (1.0 + c[1] * c[1] + c[2] * c[2]);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> (
             second, first, Eigen::EigenvaluesOnly)
             .eigenvalues()
             .cwiseAbs()
             .maxCoeff() /
         norm;
}

} // namespace

std::vector<double>
plainCubicCurvatures (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  constexpr int FITTED = PLAIN_NEIGHBORS + 1;
  pcl::search::KdTree<pcl::PointNormal> tree;
  tree.setInputCloud (cloud.makeShared());
  pcl::Indices found;
  std::vector<float> squared;
  Eigen::MatrixXd terms (FITTED, 10);
  Eigen::VectorXd heights (FITTED);
  std::vector<double> curvatures;
  for (const pcl::PointNormal& p : cloud) {
    tree.nearestKSearch (p, FITTED, found, squared);
    const Eigen::Vector3d n = p.getNormalVector3fMap().cast<double>().normalized();
    const Eigen::Vector3d x = n.unitOrthogonal();
    const Eigen::Vector3d y = n.cross (x);
    for (int i = 0; i < FITTED; ++i) {
      const Eigen::Vector3d e =
          (cloud[found[i]].getVector3fMap() - p.getVector3fMap()).cast<double>();
      const double u = e.dot (x);
      const double v = e.dot (y);
      terms.row (i) << 1.0, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v,
          v * v * v;
      heights[i] = e.dot (n);
    }
    curvatures.push_back (curvatureOf (terms, heights));
  }
  return curvatures;
}

} // namespace accuracy
