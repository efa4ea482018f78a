// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/sender.hpp"

#include <algorithm>

#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/quantile.hpp"

namespace pitwall::load {
namespace {

// Three buses have no room to catch up in: a sender that was kept waiting must not flood the
// receivers' kernel.
constexpr Duration kBetween = microseconds(100);

}  // namespace

Lateness lateness_of(std::vector<double>& late_us) {
  if (late_us.empty()) return {};
  std::sort(late_us.begin(), late_us.end());
  const auto quantile = [&late_us](double q) { return late_us[nearest_rank(q, late_us.size())]; };
  return {.p50_us = quantile(0.5), .p99_us = quantile(0.99), .max_us = quantile(1.0)};
}

SenderFigures send(transport::CanSocket& bus, Traffic& traffic, Instant start) {
  SenderFigures figures;
  std::vector<double> late_us;
  late_us.reserve(static_cast<std::size_t>(traffic.length() / kBatch));
  std::vector<can::Frame> frames;
  Instant sent_at = start - kBetween;
  figures.omitted_at.resize(traffic.omissions().size());
  for (Duration at{}; at < traffic.length(); at = at + kBatch) {
    frames.clear();
    traffic.frames_due(at, frames);
    transport::sleep_until(std::max(start + at, sent_at + kBetween));
    sent_at = transport::monotonic_now();
    late_us.push_back(static_cast<double>((sent_at - (start + at)).ns) * 1e-3);
    for (std::size_t i = 0; i < traffic.omissions().size(); ++i)
      if (traffic.omissions()[i].due == at) figures.omitted_at[i] = sent_at;
    std::span<const can::Frame> rest = frames;
    while (true) {
      const std::size_t taken = bus.send(rest);
      rest = rest.subspan(taken);
      if (rest.empty()) break;
      ++figures.offered_again;
      transport::sleep_until(transport::monotonic_now() + microseconds(100));
    }
  }
  figures.sent = bus.counters().sent;
  figures.late = lateness_of(late_us);
  return figures;
}

}  // namespace pitwall::load
