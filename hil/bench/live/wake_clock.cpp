// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/wake_clock.hpp"

#include <algorithm>

#include "hil/bench/live/virtual_machine.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/quantile.hpp"

namespace pitwall::bench {
namespace {

// How often somebody who is held up is looked at again.
constexpr Duration kLookAgain = microseconds(200);

}  // namespace

WakeClock::WakeClock(Duration period, Duration longest, std::optional<BenchTime> time)
    : period_(period), time_(std::move(time)) {
  late_us_.reserve(static_cast<std::size_t>(longest / period) + 1);
  report_.wake_late.assign(RealTime::kWakeBins, 0);
}

void WakeClock::begin() {
  if (time_) time_->begin();
}

void WakeClock::sleep_for(Duration span) {
  const Instant at = transport::monotonic_now();
  wait_until(at + span, at);
}

void WakeClock::start() {
  stolen_at_start_ = stolen_time();
  start_ = transport::monotonic_now();
  wall_start_ = transport::wall_now();
  if (time_) time_->restart_waits();
}

void WakeClock::end() {
  if (time_) time_->end();
}

// In a guest each reading of the clock is a system call: none is read twice here.
Instant WakeClock::wait_until(Instant deadline, Instant at) {
  if (!time_) {
    transport::sleep_until(deadline);
    return transport::monotonic_now();
  }
  for (; at < deadline; at = transport::monotonic_now()) {
    const bool goes = time_->advance(deadline + transport::ClockKeeper::kLead, at);
    transport::nap(goes ? deadline - at : std::max(deadline - at, kLookAgain));
  }
  return at;
}

void WakeClock::sleep_until(Instant now) {
  const Instant deadline = start_ + (now - Instant{});
  Instant at = transport::monotonic_now();
  note(at - deadline, now);
  if (at >= deadline) {
    if (at - deadline >= period_) ++report_.caught_up_wakes;
    return;
  }
  at = wait_until(deadline, at);
  note(at - deadline, now);
  const auto late_us = static_cast<float>((at - deadline).ns) * 1e-3F;
  late_us_.push_back(late_us);
  const auto bin = static_cast<std::size_t>(late_us / static_cast<float>(RealTime::kWakeBin_us));
  ++report_.wake_late[std::min(bin, RealTime::kWakeBins - 1)];
}

void WakeClock::note(Duration behind, Instant now) {
  if (behind <= report_.behind_max) return;
  report_.behind_max = behind;
  report_.behind_at = now;
}

void WakeClock::stop() {
  const auto stolen = stolen_time();
  if (stolen && stolen_at_start_) report_.stolen_ms = (*stolen - *stolen_at_start_).milliseconds();
  if (time_) {
    report_.waits = time_->waits();
    report_.waits->longest_at = Instant{} + (report_.waits->longest_at - start_);
  } else if (transport::has_bench_time()) {  // another process runs the clock and reports the waits
    const Duration passed = transport::wall_now() - wall_start_;
    report_.waits.emplace().total = passed - (transport::monotonic_now() - start_);
  }
}

RealTime WakeClock::report() {
  if (late_us_.empty()) return report_;
  std::sort(late_us_.begin(), late_us_.end());
  const auto quantile = [this](double q) {
    return static_cast<double>(late_us_[nearest_rank(q, late_us_.size())]);
  };
  report_.wake_late_p50_us = quantile(0.5);
  report_.wake_late_p99_us = quantile(0.99);
  report_.wake_late_max_us = quantile(1.0);
  return report_;
}

}  // namespace pitwall::bench
