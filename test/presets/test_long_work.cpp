// SPDX-License-Identifier: BSD-3-Clause
// The Feature on work that takes long: progress, cancelling, and using again what is
// known.
#include <pcl_crest/crest_line_estimation.h>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/analytic_surface.h"
#include "support/extraction.h"

#include <thread>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Labels = pcl::PointCloud<pcl::Label>;
using Estimation = pcl::CrestLineEstimation<pcl::PointNormal>;

namespace {

const Cloud::Ptr&
cloud ()
{
  static const Cloud::Ptr sampled = oracle::sample (oracle::ridgeAndValley(), 6000);
  return sampled;
}

Parameters
parametersOf (Preset preset)
{
  Parameters parameters;
  parameters.preset = preset;
  parameters.batched_search = true;
  return parameters;
}

/** \brief Expects labels, lines and curvatures that are equal bit for bit. */
void
expectSame (const Parameters& parameters,
            const std::shared_ptr<const SurfaceAnalysis>& analysis)
{
  Estimation anew;
  Estimation again;
  Labels labels_anew;
  Labels labels_again;
  for (Estimation* estimation : {&anew, &again}) {
    estimation->setInputCloud (cloud());
    estimation->setParameters (parameters);
  }
  again.setAnalysis (analysis);
  anew.compute (labels_anew);
  again.compute (labels_again);
  ASSERT_EQ (labels_again.size(), cloud()->size());
  EXPECT_EQ (oracle::countDifferent (labels_anew, labels_again), 0U);
  ASSERT_EQ (again.getLines().size(), anew.getLines().size());
  for (std::size_t i = 0; i < anew.getLines().size(); ++i) {
    EXPECT_EQ (again.getLines()[i].polylines, anew.getLines()[i].polylines);
    EXPECT_EQ (again.getLines()[i].strength, anew.getLines()[i].strength);
  }
  for (std::size_t i = 0; i < cloud()->size(); ++i) {
    EXPECT_EQ ((*again.getLineCloud())[i].getVector3fMap(),
               (*anew.getLineCloud())[i].getVector3fMap());
    EXPECT_EQ (again.getPrincipalCurvatures()[i].pc1,
               anew.getPrincipalCurvatures()[i].pc1);
  }
}

std::shared_ptr<const SurfaceAnalysis>
analyze (const Parameters& parameters)
{
  Estimation estimation;
  estimation.setInputCloud (cloud());
  estimation.setParameters (parameters);
  estimation.setKeepAnalysis (true);
  Labels labels;
  estimation.compute (labels);
  return estimation.getAnalysis();
}

std::string
errorOf (Estimation& estimation)
{
  Labels labels;
  testing::internal::CaptureStderr();
  estimation.compute (labels);
  EXPECT_TRUE (labels.empty());
  return testing::internal::GetCapturedStderr();
}

} // namespace

TEST (LongWork, ProgressGoesFromStageToStageToTheEnd)
{
  for (const Preset preset : {Preset::AUTO, Preset::PAPER}) {
    Estimation estimation;
    estimation.setInputCloud (cloud());
    estimation.setParameters (parametersOf (preset));
    std::vector<std::string> stages;
    double last = 0.0;
    estimation.setProgressCallback ([&] (const std::string& stage, double done) {
      EXPECT_GE (done, last);
      EXPECT_LE (done, 1.0);
      last = done;
      if (stages.empty() || stages.back() != stage)
        stages.push_back (stage);
      return true;
    });
    Labels labels;
    estimation.compute (labels);
    EXPECT_EQ (labels.size(), cloud()->size());
    std::vector<std::string> expected{"normal check",
                                      "search tree",
                                      "surface graph",
                                      "curvature",
                                      "crest points",
                                      "lines"};
    if (preset == Preset::AUTO) {
      expected.insert (expected.begin() + 3, "creases");
      expected.insert (expected.begin(), "sampling");
    }
    EXPECT_EQ (stages, expected);
    EXPECT_EQ (last, 1.0);
  }
}

TEST (LongWork, StopsWhereTheCallbackSaysSo)
{
  for (const unsigned threads : {1U, 2U})
    for (const std::string stop_at : {"sampling",
                                      "search tree",
                                      "surface graph",
                                      "creases",
                                      "curvature",
                                      "lines"}) {
      Estimation estimation;
      estimation.setInputCloud (cloud());
      estimation.setNumberOfThreads (threads);
      estimation.setProgressCallback (
          [&] (const std::string& stage, double) { return stage != stop_at; });
      const std::string said = errorOf (estimation);
      EXPECT_NE (said.find ("Cancelled"), std::string::npos) << said;
      EXPECT_TRUE (estimation.getLines().empty());
      EXPECT_EQ (estimation.getPrincipalCurvatures().size(), 0U);
      // It is not cancelled for good.
      estimation.setProgressCallback (nullptr);
      Labels labels;
      estimation.compute (labels);
      EXPECT_EQ (labels.size(), cloud()->size());
    }
}

TEST (LongWork, StopsWithinALoop)
{
  constexpr std::size_t BLOCKS = 60;
  for (const unsigned threads : {1U, 2U}) {
    std::size_t calls = 0;
    Progress progress ([&, caller = std::this_thread::get_id()] (
                           const std::string& stage, double done) {
      EXPECT_EQ (stage, "a loop");
      EXPECT_EQ (std::this_thread::get_id(), caller);
      EXPECT_LT (done, 0.5);
      // The first call is that of the stage's begin.
      return ++calls < 3;
    });
    progress.beginStage ("a loop", 0.5);
    std::atomic<std::size_t> done{0};
    const auto work = [&] (std::size_t, std::size_t, std::size_t) {
      std::this_thread::sleep_for (std::chrono::milliseconds (20));
      ++done;
    };
    EXPECT_THROW (forEachBlock (BLOCKS * BLOCK_SIZE, {threads, &progress}, work),
                  Cancelled);
    EXPECT_EQ (calls, 3U);
    EXPECT_GT (done, 0U);
    EXPECT_LT (done, BLOCKS);
  }
}

TEST (LongWork, WhatIsThrownInALoopIsCaughtOutsideIt)
{
  const auto work = [] (std::size_t block, std::size_t, std::size_t) {
    if (block == 3)
      throw std::bad_alloc();
  };
  for (const unsigned threads : {1U, 2U})
    EXPECT_THROW (forEachBlock (8 * BLOCK_SIZE, Workers (threads, nullptr), work),
                  std::bad_alloc);
}

TEST (LongWork, AnalysisGivesWhatStartingAnewGives)
{
  Parameters parameters = parametersOf (Preset::PAPER);
  const auto paper = analyze (parameters);
  ASSERT_TRUE (paper);
  expectSame (parameters, paper);
  parameters.min_size = {30, 20};
  expectSame (parameters, paper);
  parameters.maximality = {1.0, 0.1};
  expectSame (parameters, paper);
  parameters.wanted.ridge = false;
  expectSame (parameters, paper);
  parameters.prune = 3;
  parameters.boundaries = true;
  expectSame (parameters, paper);

  parameters = parametersOf (Preset::AUTO);
  const auto automatic = analyze (parameters);
  parameters.min_strength = 3.0;
  expectSame (parameters, automatic);
  parameters.angle = 50.0;
  parameters.positions = Positions::SAMPLES;
  expectSame (parameters, automatic);
}

TEST (LongWork, AnalysisOfSomethingElseIsRefused)
{
  const Parameters parameters = parametersOf (Preset::PAPER);
  Estimation estimation;
  estimation.setInputCloud (cloud());
  estimation.setParameters (parameters);
  estimation.setAnalysis (analyze (parameters));
  estimation.setKSearch (16);
  EXPECT_NE (errorOf (estimation).find ("k = 24, not 16"), std::string::npos);
  estimation.setKSearch (24);

  const auto changed = pcl::make_shared<Cloud> (*cloud());
  (*changed)[7].normal_x += 0.01F;
  estimation.setInputCloud (changed);
  EXPECT_NE (errorOf (estimation).find ("another cloud"), std::string::npos);
  estimation.setAnalysis (nullptr);
  Labels labels;
  estimation.compute (labels);
  EXPECT_EQ (labels.size(), changed->size());
}

TEST (LongWork, AnalysisIsKeptOnRequestOnly)
{
  Estimation estimation;
  estimation.setInputCloud (cloud());
  Labels labels;
  estimation.compute (labels);
  EXPECT_FALSE (estimation.getAnalysis());
}
