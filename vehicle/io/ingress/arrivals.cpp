// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/arrivals.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::io {

void add_figure(json::Object& out, const char* name, double value) {
  if (!std::isnan(value)) out.number(name, std::round(value * 1e3) * 1e-3);
}

void add_figures(json::Object& out, const ArrivalFigures& figures) {
  add_figure(out, "rate_hz", figures.rate_hz);
  add_figure(out, "gap_ms", figures.gap_ms);
  add_figure(out, "latency_ms", figures.latency_ms);
}

void Arrivals::note(Instant at, std::optional<Duration> latency) {
  const Duration gap = noted_ == 0 ? Duration{} : at - ring_[(noted_ - 1) % kKept].at;
  ring_[noted_++ % kKept] = {at, gap, latency ? latency->milliseconds() : kUnset};
  Duration largest_gap{};
  double largest_latency_ms = kUnset;
  std::uint64_t within = 0;
  for (; within < std::min<std::uint64_t>(noted_, kKept); ++within) {
    const Arrival& arrival = ring_[(noted_ - 1 - within) % kKept];
    if (at - arrival.at >= kWindow) break;
    largest_gap = std::max(largest_gap, arrival.gap);
    largest_latency_ms = std::fmax(largest_latency_ms, arrival.latency_ms);
  }
  rate_hz_.store(static_cast<double>(within) / kWindow.seconds(), std::memory_order_relaxed);
  gap_ms_.store(largest_gap.milliseconds(), std::memory_order_relaxed);
  latency_ms_.store(largest_latency_ms, std::memory_order_relaxed);
  last_ns_.store(at.ns, std::memory_order_relaxed);
  count_.store(noted_, std::memory_order_release);
}

ArrivalFigures Arrivals::newest(Instant now) const {
  if (count_.load(std::memory_order_acquire) == 0) return {};
  const Duration silent = now - Instant{last_ns_.load(std::memory_order_relaxed)};
  const bool gone = silent >= kWindow;
  return {.rate_hz = gone ? 0.0 : rate_hz_.load(std::memory_order_relaxed),
          .gap_ms = std::max(gap_ms_.load(std::memory_order_relaxed), silent.milliseconds()),
          .latency_ms = gone ? kUnset : latency_ms_.load(std::memory_order_relaxed)};
}

SensorFigures::SensorFigures(const Arrivals& of, std::uint64_t dropped, Instant started,
                             Instant now)
    : arrivals(of.newest(now)), drops(dropped) {
  if (std::isnan(arrivals.rate_hz) && now - started >= kAwaited) arrivals.rate_hz = 0.0;
}

}  // namespace pitwall::io
