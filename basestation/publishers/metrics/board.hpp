// Shared store of figures of all cars, for the answers to requests for /metrics.
//   invariants
//          the lock is held only for a copy, so that a scrape does not delay the service of a car
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "basestation/publishers/metrics/metrics_text.hpp"

namespace pitwall::publishers::metrics {

class Board {
 public:
  void put(std::size_t place, CarStatus status);
  void put(const web::WebCounters& web);
  // `pause`: the present pause of bench time, if this base runs on bench time.
  std::string text(const std::optional<transport::BenchPause>& pause = {}) const;

 private:
  mutable std::mutex lock_;
  std::vector<CarStatus> cars_;  // from here on under the lock
  std::optional<web::WebCounters> web_;
};

}  // namespace pitwall::publishers::metrics
