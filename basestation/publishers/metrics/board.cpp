// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/board.hpp"

#include <utility>

namespace pitwall::publishers::metrics {

void Board::put(std::size_t place, CarStatus status) {
  const std::lock_guard hold(lock_);
  if (cars_.size() <= place) cars_.resize(place + 1);
  cars_[place] = std::move(status);
}

void Board::put(const web::WebCounters& web) {
  const std::lock_guard hold(lock_);
  web_ = web;
}

std::string Board::text(const std::optional<transport::BenchPause>& pause) const {
  std::vector<CarStatus> cars;
  std::optional<web::WebCounters> web;
  {
    const std::lock_guard hold(lock_);
    cars = cars_;
    web = web_;
  }
  return metrics_text(cars, web, pause);
}

}  // namespace pitwall::publishers::metrics
