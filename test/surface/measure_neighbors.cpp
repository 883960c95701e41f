// SPDX-License-Identifier: BSD-3-Clause
// What the number of neighbours k costs and brings: the measurement behind its default.
// Prints a table in Markdown: mean precision and recall over the surfaces of the tests,
// sampled evenly, with a density that falls to a tenth, and in scan lines, and the time
// that the graph takes.
#include <pcl_crest/crest_line_estimation.h>

#include "support/crest_truth.h"
#include "support/surface_cases.h"

#include <cmath>
#include <cstdio>
#include <random>

namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

/** \brief Keeps a tenth of the points at one end of the x axis, all at the other. */
Cloud::Ptr
thinOut (const Cloud& cloud)
{
  float low = cloud[0].x;
  float high = cloud[0].x;
  for (const pcl::PointNormal& p : cloud) {
    low = std::min (low, p.x);
    high = std::max (high, p.x);
  }
  std::mt19937 random (9);
  std::uniform_real_distribution<double> chance (0.0, 1.0);
  auto thin = pcl::make_shared<Cloud>();
  for (const pcl::PointNormal& p : cloud)
    if (chance (random) < std::pow (10.0, -(p.x - low) / (high - low)))
      thin->push_back (p);
  return thin;
}

/** \brief Keeps stripes across the x axis, four spacings apart and less than one wide,
 * as a scanner leaves that samples more densely along its lines than across.
 */
Cloud::Ptr
cutToScanLines (const Cloud& cloud)
{
  const double spacing = oracle::meanSpacing (cloud);
  auto lines = pcl::make_shared<Cloud>();
  for (const pcl::PointNormal& p : cloud) {
    const double place = p.x / (4.0 * spacing);
    if (place - std::floor (place) < 0.2)
      lines->push_back (p);
  }
  return lines;
}

struct Means {
  double precision = 0.0;
  double recall = 0.0;
  double graph_milliseconds = 0.0;
};

} // namespace

int
main ()
{
  struct Sampled {
    oracle::SurfaceCase surface;
    std::vector<oracle::TruthSegment> truth;
    Cloud::Ptr even, thin, lines;
  };
  std::vector<Sampled> inputs;
  for (const oracle::SurfaceCase& c : oracle::surfaceCases())
    inputs.push_back ({c,
                       oracle::trueCrestLines (c.surface),
                       oracle::sample (c.surface, 20000),
                       thinOut (*oracle::sample (c.surface, 50000)),
                       cutToScanLines (*oracle::sample (c.surface, 80000))});

  std::printf (
      "| k | even: P | R | density 1:10: P | R | scan lines 1:4: P | R | graph, ms |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const int k : {8, 10, 12, 16, 20, 24, 32, 48, 64}) {
    const auto measure = [&] (const Cloud::Ptr Sampled::*cloud) {
      Means sum;
      double count = 0.0;
      for (const Sampled& input : inputs) {
        pcl::crest::Parameters parameters = input.surface.parameters();
        parameters.k = k;
        parameters.threads = 1;
        pcl::CrestLineEstimation<pcl::PointNormal> estimation;
        estimation.setInputCloud (input.*cloud);
        estimation.setParameters (parameters);
        pcl::PointCloud<pcl::Label> labels;
        estimation.compute (labels);
        for (const auto& time : estimation.getStatistics().times)
          if (time.stage == "surface graph")
            sum.graph_milliseconds += time.milliseconds;
        // Where the density falls, what is near enough is measured by its mean.
        const double tolerance = 1.5 * oracle::meanSpacing (*(input.*cloud));
        for (const pcl::crest::CrestType type : input.surface.types) {
          const oracle::Score score = oracle::score (
              estimation.getLines(), *(input.*cloud), input.truth, type, tolerance);
          sum.precision += score.precision;
          sum.recall += score.recall;
          ++count;
        }
      }
      return Means{sum.precision / count,
                   sum.recall / count,
                   sum.graph_milliseconds / static_cast<double> (inputs.size())};
    };
    const Means even = measure (&Sampled::even);
    const Means thin = measure (&Sampled::thin);
    const Means lines = measure (&Sampled::lines);
    std::printf ("| %d | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.0f |\n",
                 k,
                 even.precision,
                 even.recall,
                 thin.precision,
                 thin.recall,
                 lines.precision,
                 lines.recall,
                 even.graph_milliseconds);
  }
  return 0;
}
