// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/step_log.hpp"

#include <algorithm>

#include "tests/benchmarks/tracking/tracking_run.hpp"

namespace pitwall::tracking_bench {

StepLog log_of(const Scene& scene) {
  StepLog log;
  run_tracking(scene, tracking::Params{},
               [&log](const tracking::State&, const tracking::Inputs& in) {
                 log.ego.push_back(in.ego);
                 log.frames.insert(log.frames.end(), in.frames.begin(), in.frames.end());
               });
  std::ranges::stable_sort(log.frames, {}, &world::DetectionFrame::at);
  return log;
}

}  // namespace pitwall::tracking_bench
