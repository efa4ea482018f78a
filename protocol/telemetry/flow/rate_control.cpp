// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/rate_control.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr double kSpan_s = 0.5;          // of the line
constexpr std::size_t kLeastPoints = 8;  // of a line that says something
constexpr double kSigmas = 4.0;          // what noise does not explain
constexpr double kBackoff = 0.85, kProbe_per_s = 0.05;
constexpr double kSettle_s = 0.5;          // after a backoff: the line is of the old rate
constexpr double kStandingQueue_s = 0.03;  // above it nothing is probed
constexpr double kInterval_s = 5.0;        // of the least delay
constexpr double kSmoothing = 0.2;         // of the newest delay in the smoothed one
constexpr double kLeastFactor = 1e-3;
// A gap longer than this, and longer than its bytes take at a twentieth of the budget, is a fade.
constexpr double kFade_s = 0.06, kFadeShare = 20.0;
constexpr Duration kSilence = milliseconds(500);

}  // namespace

RateControl::RateControl(double budget_bytes_per_s, double floor_bytes_per_s)
    : budget_(budget_bytes_per_s), floor_(floor_bytes_per_s) {
  CHECK(budget_ > 0.0 && floor_ >= 0.0 && floor_ <= budget_);
}

void RateControl::forget_old(double at_s) {
  while (count_ == kWindow || (count_ > kLeastPoints && points_[first_].at_s < at_s - kSpan_s)) {
    first_ = (first_ + 1) % kWindow;
    --count_;
  }
}

RateControl::Line RateControl::line() const {
  const auto n = static_cast<double>(count_);
  double mean_t = 0.0, mean_d = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Point& p = points_[(first_ + i) % kWindow];
    mean_t += p.at_s / n;
    mean_d += p.delay_s / n;
  }
  double tt = 0.0, td = 0.0, dd = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Point& p = points_[(first_ + i) % kWindow];
    tt += (p.at_s - mean_t) * (p.at_s - mean_t);
    td += (p.at_s - mean_t) * (p.delay_s - mean_d);
    dd += (p.delay_s - mean_d) * (p.delay_s - mean_d);
  }
  if (tt <= 0.0) return {};
  const double slope = td / tt;
  const double residual = std::max(0.0, dd - slope * td);
  return {slope, std::sqrt(residual / (n - 2.0) / tt)};
}

// While something arrives: a fade within the span says nothing of what the link carries.
double RateControl::arrived_rate() const {
  double bytes = 0.0, span_s = 0.0;
  for (std::size_t i = 1; i < count_; ++i) {
    const Point &before = points_[(first_ + i - 1) % kWindow], &p = points_[(first_ + i) % kWindow];
    const double gap_s = p.at_s - before.at_s;
    const bool faded = gap_s > kFade_s && gap_s > kFadeShare * (p.bytes / budget_);
    if (faded) continue;
    bytes += p.bytes;
    span_s += gap_s;
  }
  return span_s > 0.0 ? bytes / span_s : budget_;
}

void RateControl::note_least(double at_s, double delay_s) {
  if (at_s - interval_start_s_ >= kInterval_s) {
    least_s_ = {delay_s, least_s_[0]};
    interval_start_s_ = at_s;
  }
  least_s_[0] = std::min(least_s_[0], delay_s);
}

void RateControl::delivered(Instant sent, Instant received_by_peer, std::size_t bytes,
                            Instant now) {
  if (!started_) {
    started_ = true;
    origin_sent_ = sent;
    origin_received_ = received_by_peer;
    changed_ = now;
  }
  const double at_s = (received_by_peer - origin_received_).seconds();
  const double delay_s = at_s - (sent - origin_sent_).seconds();
  if (count_ > 0 && at_s <= points_[(first_ + count_ - 1) % kWindow].at_s) return;  // old news
  forget_old(at_s);
  points_[(first_ + count_++) % kWindow] = {at_s, delay_s, static_cast<double>(bytes)};
  note_least(at_s, delay_s);
  smoothed_s_ = count_ == 1 ? delay_s : smoothed_s_ + kSmoothing * (delay_s - smoothed_s_);

  const Duration since = std::min(now - changed_, kSilence);
  changed_ = now;
  const bool settled = at_s >= hold_until_s_;
  if (count_ >= kLeastPoints && settled && queue_delay() >= kLeastQueue) {
    const Line l = line();
    if (l.slope > kOveruse && l.slope > kSigmas * l.standard_error) {
      const double least = std::max(kLeastFactor, floor_ / budget_);
      factor_ = std::clamp(kBackoff * arrived_rate() / budget_, least, factor_);
      hold_until_s_ = at_s + kSettle_s;
      ++backoffs_;
      return;
    }
  }
  if (settled && queue_delay().seconds() < kStandingQueue_s) {
    factor_ = std::min(1.0, factor_ + kProbe_per_s * std::max(0.0, since.seconds()));
  }
}

Duration RateControl::queue_delay() const {
  if (count_ == 0) return {};
  return from_seconds(std::max(0.0, smoothed_s_ - std::min(least_s_[0], least_s_[1])));
}

}  // namespace pitwall::telemetry
