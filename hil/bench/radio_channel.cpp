// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/radio_channel.hpp"

#include <algorithm>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {

using faults::BenchFault;
using faults::BenchFaultKind;
using telemetry::PathId;

RadioChannel::RadioChannel(const std::vector<scenario::RadioPath>& paths,
                           std::vector<BenchFault> faults, std::uint64_t seed)
    : faults_(std::move(faults)) {
  static const std::vector<scenario::RadioPath> kPlain(1);
  for (const scenario::RadioPath& path : paths.empty() ? kPlain : paths) {
    const std::uint64_t own = path.seed.value_or(seed + lanes_.size());
    const auto make = [&](std::uint64_t way) {
      return Lane{link::LinkEmulator{path.link, own}, Random{own * kWays + way}, {}, {}};
    };
    lanes_.push_back({make(0), make(1)});
  }
  CHECK(lanes_.size() <= telemetry::kPaths);
}

std::optional<double> RadioChannel::active(BenchFaultKind kind, Instant at) const {
  std::optional<double> value;
  for (const BenchFault& fault : faults_)
    if (fault.kind == kind && faults::active(fault, at))
      value = std::max(value.value_or(fault.value), fault.value);
  return value;
}

bool RadioChannel::is_off(Way way, Instant at) const {
  return active(BenchFaultKind::kRadioDown, at).has_value() ||
         (way == Way::kUp && active(BenchFaultKind::kBaseStationSilent, at).has_value());
}

void RadioChannel::offer(Way way, PathId path, const Payload& payload, Instant now) {
  if (path >= lanes_.size()) return;
  const auto w = static_cast<std::size_t>(way);
  Lane& here = lane(way, path);
  ++counters_.offered[w];
  const double dice = here.random.uniform();  // drawn always: a fault moves no later draw
  if (is_off(way, now)) {
    ++counters_.switched_off[w];
  } else if (dice < active(BenchFaultKind::kRadioLoss, now).value_or(0.0)) {
    ++counters_.lost[w];
  } else {
    here.emulator.offer(payload.bytes, now, payload.tag);
  }
}

void RadioChannel::hold_back(Lane& here, Instant now) {
  while (auto datagram = here.emulator.take(now)) {
    const double delay_s = active(BenchFaultKind::kRadioDelay, datagram->offered).value_or(0.0);
    datagram->arrives = std::max(datagram->arrives + from_seconds(delay_s), here.last);
    here.last = datagram->arrives;
    here.held.push_back(*std::move(datagram));
  }
}

std::optional<link::Datagram> RadioChannel::take(Way way, PathId path, Instant now) {
  if (path >= lanes_.size()) return std::nullopt;
  Lane& here = lane(way, path);
  hold_back(here, now);
  while (!here.held.empty() && here.held.front().arrives <= now) {
    link::Datagram datagram = std::move(here.held.front());
    here.held.pop_front();
    if (is_off(way, datagram.arrives)) {  // it was on its way when the radio went off
      ++counters_.switched_off[static_cast<std::size_t>(way)];
      continue;
    }
    ++counters_.delivered[static_cast<std::size_t>(way)];
    if (way == Way::kUp) note_received(datagram.offered, now);
    return datagram;
  }
  return std::nullopt;
}

void RadioChannel::note_received(Instant sent, Instant now) {
  longest_ = longest_silence(now);
  newest_up_ = newest_up_ ? std::max(*newest_up_, sent) : sent;
}

void RadioChannel::place(double station_m) {
  for (auto& both : lanes_)
    for (Lane& one : both) one.emulator.place(station_m);
}

std::optional<Duration> RadioChannel::silence(Instant now) const {
  if (!newest_up_) return std::nullopt;
  return now - *newest_up_;
}

Duration RadioChannel::longest_silence(Instant now) const {
  return newest_up_ ? std::max(longest_, now - *newest_up_) : Duration{};
}

const link::LinkCounters& RadioChannel::counters(Way way, PathId path) const {
  CHECK(path < lanes_.size());
  return lanes_[path][static_cast<std::size_t>(way)].emulator.counters();
}

}  // namespace pitwall::bench
