// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/path_lane.hpp"

#include <algorithm>

#include "protocol/telemetry/packet/header.hpp"

namespace pitwall::telemetry {
namespace {

constexpr Duration kTenth = milliseconds(100);
constexpr std::int64_t kTenths = 10;

}  // namespace

PathLane::PathLane(const BudgetParams& params)
    : budget(PathBudget::make(params).value()),
      rate(params.bytes_per_s, params.safety_bytes_per_s) {}

void PathLane::adapt(Instant now) {
  factor = std::min(rate.factor(), cap);
  budget.scale(factor, now);
}

bool PathLane::fits(std::size_t size, std::size_t safety, Instant now) const {
  return budget.room_beside(std::min(safety, size), now) >= size;
}

void PathLane::spend(std::size_t size, std::size_t safety, Instant now) {
  budget.spend(size, std::min(safety, size), now);
  const std::int64_t at = now.ns / kTenth.ns;
  for (std::int64_t t = std::max(tenth_ + 1, at - kTenths); t <= at; ++t) bytes_in(t) = 0;
  tenth_ = std::max(tenth_, at);
  bytes_in(tenth_) += size + kIpUdpOverhead;
}

// Of the last ten tenths that are over.
double PathLane::use(Instant now) const {
  const std::int64_t at = now.ns / kTenth.ns;
  std::uint64_t sum = 0;
  for (std::int64_t t = std::max(at, tenth_) - kTenths; t < at && t <= tenth_; ++t) {
    if (t >= tenth_ - kTenths) sum += tenths_[static_cast<std::size_t>(t) % tenths_.size()];
  }
  return static_cast<double>(sum) / budget.params().bytes_per_s;
}

}  // namespace pitwall::telemetry
