// SPDX-License-Identifier: BSD-3-Clause
// The component pcl: the method as a pcl::Feature. Clouds and searches of PCL go in;
// its labels, curvatures, line sets and messages come out. All else is done by
// extractCrests (crest_extraction.h), which knows no PCL.
#pragma once

#include <pcl_crest/crest_extraction.h>

#include <pcl/features/feature.h>
#include <pcl/point_types.h>
#include <pcl/PolygonMesh.h>

#include <memory>
#include <optional>
#include <vector>

namespace pcl {

/** \brief CrestLineEstimation extracts crest lines, that is ridges and valleys, from a
 * cloud of points, by the method of G. Stylianou and Y. Chrysanthou,
 * "Crest Line Extraction From Point Clouds". With the preset crest::Preset::AUTO, the
 * default, it finds the scale of each crest and the significance of each line by
 * itself; crest::Preset::PAPER is the method as published, with its threshold M.
 *
 * The method needs normals that point consistently to one side of the surface, outward
 * for closed ones: flipping them all swaps ridges and valleys. They are those of the
 * points, or of setInputNormals; else compute estimates them by itself. Those that
 * are zero or not finite are estimated, those that contradict their neighbours turned
 * over, where it is certain how; PCL_WARN says so (see getNormalCheck).
 *
 * \code
 * pcl::CrestLineEstimation<pcl::PointNormal> estimation;
 * estimation.setInputCloud (cloud); // positions and normals
 * estimation.setTurningAngle (30);  // degrees that the surface turns across a line
 * estimation.setMinLength (8);      // of a line, in spacings of the samples
 * pcl::PointCloud<pcl::Label> labels;
 * pcl::PolygonMesh lines;
 * estimation.compute (labels, lines);
 * \endcode
 *
 * Points are floats, which have some seven digits: coordinates of maps need an offset
 * taken off first. crest::placePoints of the component io does so for doubles, sets
 * points apart that are far from all others, and gives what the writers need to put the
 * lines where they belong.
 *
 * As in every Feature: setIndices restricts the points that labels are computed for,
 * not the surface, so that the labels are those of a run on the whole cloud and the
 * lines are all lines of the surface. With setSearchSurface every finite input point
 * has to be a point of that surface, because a crest is a property of the samples of a
 * surface; lines then index the surface. Without setSearchMethod, setKSearch and
 * setRadiusSearch, the 24 closest neighbours are found with PCL's KdTree over the valid
 * points, for organized clouds too, as OrganizedNeighbor takes only what comes from a
 * projective device. A search method that is set is given the surface at each compute,
 * because the points behind its pointer may have changed.
 *
 * Mistakes are reported with PCL_ERROR and leave all outputs empty, and so does a
 * search method that throws. Where memory does not suffice they are left empty, too,
 * and std::bad_alloc is thrown. A cloud without any usable point is no mistake: its
 * labels are all crest::LABEL_INVALID, and PCL_WARN says so.
 *
 * Compiled into the library for pcl::Label and PointXYZ, PointXYZI, PointXYZRGB,
 * PointXYZRGBA, PointNormal, PointXYZINormal, PointXYZRGBNormal, PointXYZLNormal and
 * PointSurfel; for other types include
 * pcl_crest/impl/crest_line_estimation.hpp, or define PCL_NO_PRECOMPILE.
 *
 * \tparam PointInT a point type with xyz, perhaps with normal
 * \tparam PointOutT a point type with a label; fields it shares with PointInT are
 * copied
 * \ingroup features
 */
template <typename PointInT, typename PointOutT = pcl::Label>
class PCL_CREST_EXPORT CrestLineEstimation : public Feature<PointInT, PointOutT> {
  static_assert (pcl::traits::has_xyz<PointInT>::value,
                 "the input points need x, y and z, as in pcl::PointXYZ");
  static_assert (pcl::traits::has_label<PointOutT>::value,
                 "the output points need a label, as in pcl::Label");

public:
  using Ptr = shared_ptr<CrestLineEstimation<PointInT, PointOutT>>;
  using ConstPtr = shared_ptr<const CrestLineEstimation<PointInT, PointOutT>>;
  using typename Feature<PointInT, PointOutT>::PointCloudIn;
  using typename Feature<PointInT, PointOutT>::PointCloudOut;

  CrestLineEstimation() { feature_name_ = "CrestLineEstimation"; }

  /** \brief Choose between the method that finds its scale and the significance of
   * lines by itself and the paper's (see crest::Parameters::preset). The setters below
   * that name one of them are mistakes with the other.
   */
  void
  setPreset (crest::Preset preset)
  {
    parameters_.preset = preset;
  }

  /** \brief Set how far the surface has to turn across a line, in degrees (AUTO):
   * higher keeps only what bends more. */
  void
  setTurningAngle (double degrees)
  {
    parameters_.angle = degrees;
  }

  /** \brief Set the least length of a line, in spacings of its samples (AUTO). */
  void
  setMinLength (double spacings)
  {
    parameters_.min_length = spacings;
  }

  /** \brief Set how many standard errors crest points have to stand out by (AUTO). */
  void
  setConfidence (double standard_errors)
  {
    parameters_.confidence = standard_errors;
  }

  /** \brief Choose whether lines run between or along the samples (AUTO). */
  void
  setPositions (crest::Positions positions)
  {
    parameters_.positions = positions;
  }

  /** \brief Set M, the threshold on the maximality of curvature, for ridges and valleys
   * (PAPER; see crest::Parameters::maximality for its unit).
   */
  void
  setMaximality (double maximality)
  {
    parameters_.maximality = {maximality, maximality};
  }
  /** \brief Set M for ridges alone (PAPER). */
  void
  setRidgeMaximality (double maximality)
  {
    parameters_.maximality.ridge = maximality;
  }
  /** \brief Set M for valleys alone (PAPER). */
  void
  setValleyMaximality (double maximality)
  {
    parameters_.maximality.valley = maximality;
  }

  /** \brief Take M in 1 / (the cloud's unit)^2 instead of relative to its extent
   * (PAPER). */
  void
  setAbsoluteMaximality (bool absolute)
  {
    parameters_.absolute_maximality = absolute;
  }

  /** \brief Set S: lines of fewer points are removed. If it is not set, PAPER removes
   * those of fewer than 10 and AUTO none for that reason. */
  void
  setMinSize (int points)
  {
    parameters_.min_size = {points, points};
  }
  /** \brief Set S for ridges alone. */
  void
  setRidgeMinSize (int points)
  {
    parameters_.min_size.ridge = points;
  }
  /** \brief Set S for valleys alone. */
  void
  setValleyMinSize (int points)
  {
    parameters_.min_size.valley = points;
  }

  /** \brief Set the least strength of lines (see crest::Parameters::min_strength). */
  void
  setMinStrength (double strength)
  {
    parameters_.min_strength = strength;
  }

  /** \brief Set the size in points up to which branches are pruned (PAPER). */
  void
  setPruneSize (int points)
  {
    parameters_.prune = points;
  }

  /** \brief Set the number of neighbours kept in each quadrant. */
  void
  setPointsPerQuadrant (int points)
  {
    parameters_.points_per_quadrant = points;
  }

  /** \brief Set the largest angle between neighbouring normals, in degrees. */
  void
  setMaxNormalAngle (double degrees)
  {
    parameters_.max_normal_angle = degrees;
  }

  /** \brief Choose the types to label and to draw lines of. */
  void
  setWantedTypes (bool ridges, bool valleys)
  {
    parameters_.wanted = {ridges, valleys};
  }

  /** \brief Choose whether points where the surface ends get the label
   * crest::LABEL_BOUNDARY, if no other applies to them. They do not else.
   */
  void
  setLabelBoundaries (bool boundaries)
  {
    parameters_.boundaries = boundaries;
  }

  /** \brief Choose whether the k neighbours are found by the library's own batched
   * search in the place of PCL's KdTree: several times as fast, with the same result. A
   * radius is searched with the KdTree even so. With setSearchMethod it is a mistake.
   */
  void
  setUseBatchedSearch (bool batched)
  {
    parameters_.batched_search = batched;
  }

  /** \brief Set the number of threads; 0 takes all processors. */
  void
  setNumberOfThreads (unsigned nr_threads = 0)
  {
    parameters_.threads = nr_threads;
  }

  /** \brief Set all parameters at once. k and radius take the place of setKSearch and
   * setRadiusSearch; a radius that is set afterwards takes that of k.
   */
  void
  setParameters (const crest::Parameters& parameters)
  {
    parameters_ = parameters;
    // With k_ a radius that is set later would be refused.
    k_ = 0;
    search_radius_ = parameters.radius;
  }

  /** \brief The parameters as the next compute will use them. */
  crest::Parameters
  getParameters () const
  {
    crest::Parameters parameters = parameters_;
    if (k_ != 0)
      parameters.k = k_;
    parameters.radius = search_radius_;
    return parameters;
  }

  /** \brief Set what is called while compute works (see crest::ProgressCallback). Where
   * it returns false compute stops: its outputs are then empty, and PCL_WARN says so.
   */
  void
  setProgressCallback (crest::ProgressCallback callback)
  {
    progress_callback_ = std::move (callback);
  }

  /** \brief Choose whether compute keeps what it finds out for getAnalysis, some 120
   * bytes a point with PAPER and 200 with AUTO. It does not else.
   */
  void
  setKeepAnalysis (bool keep)
  {
    keep_analysis_ = keep;
  }

  /** \brief What the last compute found out about the surface, if setKeepAnalysis; else
   * null. */
  const std::shared_ptr<const crest::SurfaceAnalysis>&
  getAnalysis () const
  {
    return result_.analysis;
  }

  /** \brief Set what a compute on the same cloud found out: the next ones take it over,
   * and repeat only what their thresholds change. Null makes compute start anew. It is
   * a mistake where the cloud, or a parameter that the surface graph and the curvatures
   * depend on, has changed; search methods are not compared.
   */
  void
  setAnalysis (std::shared_ptr<const crest::SurfaceAnalysis> analysis)
  {
    analysis_ = std::move (analysis);
  }

  /** \brief Set the normals of the surface, the input cloud unless setSearchSurface is
   * used, one for each of its points. They take the place of those in its points; null
   * takes these again. Where neither has any, compute estimates them, as
   * OrientedNormalEstimation does from 24 neighbours.
   */
  void
  setInputNormals (const pcl::PointCloud<pcl::Normal>::ConstPtr& normals)
  {
    normals_ = normals;
  }

  /** \brief Set how sure the signs of the surface's normals are, one for each of its
   * points, as OrientedNormalEstimation::getTrust tells (see CrestLine::sign_trust).
   * With it normals are used as they are. Null for those of another source: they are
   * checked, and repaired where it is certain how (see getNormalCheck).
   */
  void
  setSignTrust (std::shared_ptr<const std::vector<float>> trust)
  {
    sign_trust_ = std::move (trust);
  }

  /** \brief Set how the surface was sampled, as crest::estimateNormals found it for
   * this same cloud (NormalEstimate::nodes), which AUTO then does not measure again.
   * Null to have it measured.
   */
  void
  setSampleNodes (std::shared_ptr<const crest::SampleNodes> nodes)
  {
    nodes_ = std::move (nodes);
  }

  /** \brief Set where the cloud was seen from, in its unit, for the side of normals
   * that compute estimates, and of given ones that are divided about it: sensor_origin_
   * of the surface by default, as OrientedNormalEstimation has it.
   */
  void
  setViewPoint (float x, float y, float z)
  {
    viewpoint_ = Eigen::Vector3f (x, y, z);
  }

  /** \brief Undo setViewPoint: the viewpoint is sensor_origin_ of the surface. */
  void
  useSensorOriginAsViewPoint ()
  {
    viewpoint_.reset();
  }

  /** \brief Set the side of open parts that no viewpoint decides, for normals that
   * compute estimates, and of given ones that are divided about it; +z by default,
   * which is a guess.
   */
  void
  setUpDirection (float x, float y, float z)
  {
    up_ = Eigen::Vector3f (x, y, z);
  }

  using Feature<PointInT, PointOutT>::compute;

  /** \brief Compute labels and lines.
   * \param[out] labels one of crest::Label for each of the indices, in their order
   * \param[out] lines one pcl::Vertices for each polyline of getLines (), in its order;
   * its cloud is the surface, the points on lines where these run
   */
  void
  compute (PointCloudOut& labels, pcl::PolygonMesh& lines);

  /** \brief The lines of the last compute, as indices into the surface (the input cloud
   * unless setSearchSurface was used): ridges first, of each type the largest first.
   */
  const std::vector<crest::CrestLine>&
  getLines () const
  {
    return result_.lines;
  }

  /** \brief The surface of the last compute with the points on lines moved to where
   * these run: between the samples with crest::Positions::CREST of the preset AUTO.
   * Else no point moves, and this is the surface itself: what is changed in that is
   * changed here, too.
   */
  const typename PointCloudIn::ConstPtr&
  getLineCloud () const
  {
    return result_.line_cloud;
  }

  /** \brief The principal curvatures of the last compute, one for each of its indices:
   * pc1 is the larger in absolute value, signed, positive where convex seen from the
   * side of the normal, in 1 / (the cloud's unit); principal_curvature is its
   * direction. All are NaN where the label is LABEL_INVALID.
   */
  const pcl::PointCloud<pcl::PrincipalCurvatures>&
  getPrincipalCurvatures () const
  {
    return *result_.curvatures;
  }

  /** \brief The normals that the last compute estimated for the surface; null where it
   * had some.
   */
  const std::shared_ptr<const crest::NormalEstimate>&
  getNormalEstimate () const
  {
    return result_.normals;
  }

  /** \brief What the last compute found of the normals that it was given, and how it
   * used them; null where it had none, or setSignTrust.
   */
  const std::shared_ptr<const crest::NormalCheck>&
  getNormalCheck () const
  {
    return result_.normal_check;
  }

  /** \brief What the last compute found out beside its outputs. */
  using Statistics = crest::ExtractionStatistics;
  const Statistics&
  getStatistics () const
  {
    return result_.statistics;
  }

protected:
  using Feature<PointInT, PointOutT>::feature_name_;
  using Feature<PointInT, PointOutT>::getClassName;
  using Feature<PointInT, PointOutT>::input_;
  using Feature<PointInT, PointOutT>::indices_;
  using Feature<PointInT, PointOutT>::fake_indices_;
  using Feature<PointInT, PointOutT>::surface_;
  using Feature<PointInT, PointOutT>::fake_surface_;
  using Feature<PointInT, PointOutT>::tree_;
  using Feature<PointInT, PointOutT>::k_;
  using Feature<PointInT, PointOutT>::search_radius_;

  /** \brief Checks the input. Takes the place of Feature::initCompute, which builds a
   * search over all points of the surface, and aborts in FLANN where one is not finite
   * though the cloud says that it is dense.
   */
  bool
  initCompute () override;

private:
  struct Result {
    bool complete = false;
    std::vector<crest::CrestLine> lines;
    typename PointCloudIn::ConstPtr line_cloud;
    pcl::PointCloud<pcl::PrincipalCurvatures>::ConstPtr curvatures =
        pcl::make_shared<pcl::PointCloud<pcl::PrincipalCurvatures>>();
    Statistics statistics;
    std::shared_ptr<const crest::SurfaceAnalysis> analysis;
    std::shared_ptr<const crest::NormalEstimate> normals;
    std::shared_ptr<const crest::NormalCheck> normal_check;
  };

  void
  computeFeature (PointCloudOut& output) override;

  /** \brief Whether the indices are all points of the surface, in its order. */
  bool
  isInputSurface () const
  {
    return surface_ == input_ && fake_indices_;
  }

  /** \brief The surface as plain arrays, with the normals that are to be used. */
  crest::PointView
  surfaceView () const;

  /** \brief The points of the surface that the indices name; false, with an error, if
   * one is none. */
  bool
  locateInput (pcl::Indices& located) const;

  /** \brief The user's search method as the stages call it; empty if there is none. */
  crest::NeighborSearch
  givenSearch () const;

  /** \brief All of the method; false, with an error, where it cannot be done. */
  bool
  extract (PointCloudOut& output);

  /** \brief The curvatures of the indices, laid out as the labels are.
   * \param[in] located from locateInput, where the indices are not the surface
   */
  pcl::PointCloud<pcl::PrincipalCurvatures>::ConstPtr
  curvaturesOf (const crest::Extraction& found,
                const pcl::Indices& located,
                const PointCloudOut& layout);

  /** \brief Says what of the normals is not as a user may think. */
  void
  warnOfNormals (const crest::Extraction& found) const;

  /** \brief Whether the user's search method can take the surface; gives it over. */
  bool
  prepareSearchMethod ();

  crest::Parameters parameters_;
  crest::ProgressCallback progress_callback_;
  bool keep_analysis_ = false;
  std::shared_ptr<const crest::SurfaceAnalysis> analysis_;
  pcl::PointCloud<pcl::Normal>::ConstPtr normals_;
  std::shared_ptr<const std::vector<float>> sign_trust_;
  std::shared_ptr<const crest::SampleNodes> nodes_;
  std::optional<Eigen::Vector3f> viewpoint_;
  std::optional<Eigen::Vector3f> up_;
  Result result_;
  /** \brief Those of all points of a surface, for as long as what they were made of is
   * kept. */
  struct KnownCurvatures {
    std::weak_ptr<const std::vector<crest::PrincipalCurvature>> source;
    pcl::PointCloud<pcl::PrincipalCurvatures>::ConstPtr cloud;
  };
  KnownCurvatures known_curvatures_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl_crest/impl/crest_line_estimation.hpp>
#endif
