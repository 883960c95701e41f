// SPDX-License-Identifier: BSD-3-Clause
#include "crest_session.h"

namespace pcl {
namespace crest {

CrestSession::CrestSession (InputCloud cloud,
                            const Parameters& parameters,
                            const ProgressCallback& progress)
: cloud_ (std::move (cloud)), parameters_ (parameters)
{
  estimation_.setInputCloud (cloud_.points);
  estimation_.setKeepAnalysis (true);
  estimation_.setProgressCallback (progress);
  compute();
  estimation_.setProgressCallback (nullptr);
}

void
CrestSession::setThresholds (const Parameters& thresholds)
{
  parameters_ = thresholds;
  compute();
}

void
CrestSession::compute()
{
  estimation_.setParameters (parameters_);
  estimation_.compute (labels_);
  estimation_.setAnalysis (estimation_.getAnalysis());
}

} // namespace crest
} // namespace pcl
