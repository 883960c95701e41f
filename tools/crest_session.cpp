// SPDX-License-Identifier: BSD-3-Clause
#include "crest_session.h"

#include "estimation.h"

namespace pcl {
namespace crest {

CrestSession::CrestSession (InputCloud cloud,
                            const Parameters& parameters,
                            const ProgressCallback& progress)
: cloud_ (std::move (cloud))
{
  setInput (cloud_, estimation_);
  estimation_.setKeepAnalysis (true);
  estimation_.setProgressCallback (progress);
  setThresholds (parameters);
  estimation_.setProgressCallback (nullptr);
}

void
CrestSession::setThresholds (const Parameters& thresholds)
{
  estimation_.setParameters (thresholds);
  estimation_.compute (labels_);
  estimation_.setAnalysis (estimation_.getAnalysis());
}

} // namespace crest
} // namespace pcl
