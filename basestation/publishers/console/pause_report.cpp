// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/pause_report.hpp"

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::console {

std::optional<std::string> PauseReport::news(const std::optional<transport::BenchPause>& pause,
                                             Instant now) {
  if (!pause) return std::nullopt;
  const transport::BenchPause seen{.now = pause->is_long() ? pause->now : Duration{},
                                   .total = pause->total};
  if (!is_news(seen, now)) return std::nullopt;
  reported_ = seen;
  reported_at_ = now;
  return json::Object{}
      .text("type", "bench_time")
      .number("time_ms", now.milliseconds())
      .number("stands_ms", seen.now.milliseconds())
      .number("stood_ms", seen.total.milliseconds())
      .str();
}

bool PauseReport::is_news(const transport::BenchPause& pause, Instant now) const {
  if (!reported_) return true;
  const bool stood = reported_->now.ns > 0;
  if (pause.now.ns == 0) {
    return stood ||
           (now - reported_at_ >= kTotalEvery && pause.total - reported_->total >= kTotalStep);
  }
  return !stood || pause.now < reported_->now || pause.now - reported_->now >= kAgain;
}

}  // namespace pitwall::publishers::console
