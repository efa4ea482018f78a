// Shared store of figures of all cars, from which a request for /metrics is answered.
//   invariants
//          under the lock is a copy only: a scrape does not keep a stand waiting
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
  // With how bench time stands now, where this base goes by it.
  std::string text(const std::optional<transport::BenchPause>& pause = {}) const;

 private:
  mutable std::mutex lock_;
  std::vector<CarStatus> cars_;  // these under the lock
  std::optional<web::WebCounters> web_;
};

}  // namespace pitwall::publishers::metrics
