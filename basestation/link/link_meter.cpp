// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/link_meter.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::link {
namespace {

constexpr double kBitsPerKbit = 1'000.0;

double share(std::uint64_t part, std::uint64_t rest) {
  return part + rest == 0 ? kUnset : static_cast<double>(part) / static_cast<double>(part + rest);
}

bool ran_back(const LinkCount& now, const LinkCount& then) {
  return now.packets < then.packets || now.paths[0].received < then.paths[0].received;
}

// Missing numbers can be found after all: then fewer are missing than before.
std::uint64_t rise(std::uint64_t now, std::uint64_t then) { return now > then ? now - then : 0; }

}  // namespace

LinkCount count_of(const telemetry::LinkReport& report, std::uint64_t packets,
                   std::uint64_t missing) {
  LinkCount count{.packets = packets, .missing = missing};
  for (std::size_t i = 0; i < count.paths.size(); ++i) {
    const telemetry::PathReport& path = report.paths[i];
    count.paths[i] = {.received = path.received.received,
                      .lost = path.received.lost,
                      .duplicates = path.received.duplicates,
                      .late = path.received.late,
                      .up_bytes = path.spent.bytes};
  }
  return count;
}

void LinkMeter::note(const LinkCount& count, Instant now, double round_trip_ms) {
  if (!samples_.empty() && ran_back(count, samples_.back().count)) samples_.clear();
  samples_.push_back({now, count, round_trip_ms});
  while (samples_.size() > 2 && now - samples_[1].at >= kLongest) samples_.pop_front();
}

void LinkMeter::packet(telemetry::GroupSet groups, Instant now) {
  if (now - second_ >= seconds(1)) {
    counted_ = now - second_ < seconds(2) ? counting_ : decltype(counting_){};
    counting_ = {};
    second_ = now;
  }
  for (std::size_t g = 0; g < telemetry::kGroups; ++g) {
    counting_[g] += static_cast<std::uint32_t>(groups.bits >> g & 1U);
  }
}

// The newest sample that is at least that old, or the oldest there is.
const LinkMeter::Sample* LinkMeter::before(Duration window) const {
  if (samples_.size() < 2) return nullptr;
  const Instant from = samples_.back().at - window;
  const auto later = std::ranges::find_if(samples_, [&](const Sample& s) { return s.at > from; });
  return later == samples_.begin() ? &samples_.front() : &*std::prev(later);
}

void LinkMeter::note_use(std::size_t path, double received_kbit_s, double use) {
  constexpr double kLeastUse = 0.05, kFollow = 0.05;  // below it the share is too coarse
  if (!(use >= kLeastUse && received_kbit_s > 0.0)) return;
  double& cap = caps_kbit_s_[path];
  const double seen = received_kbit_s / use;
  cap = std::isnan(cap) ? seen : cap + kFollow * (seen - cap);
}

double LinkMeter::round_trip_ms(Duration window) const {
  double longest_ms = kUnset;
  if (samples_.empty()) return longest_ms;
  const Instant from = samples_.back().at - window;
  for (const Sample& sample : samples_) {
    if (sample.at > from) longest_ms = std::fmax(longest_ms, sample.round_trip_ms);
  }
  return longest_ms;
}

double LinkMeter::loss(Duration window) const {
  const Sample* const then = before(window);
  if (then == nullptr) return kUnset;
  const LinkCount& now = samples_.back().count;
  return share(rise(now.missing, then->count.missing), rise(now.packets, then->count.packets));
}

PathWindow LinkMeter::path(std::size_t path, Duration window) const {
  const Sample* const then = before(window);
  if (then == nullptr) return {};
  const PathCount& a = then->count.paths[path];
  const PathCount& b = samples_.back().count.paths[path];
  const std::uint64_t received = rise(b.received, a.received);
  const double length_s = (samples_.back().at - then->at).seconds();
  constexpr double kBits = 8.0;
  return {.loss = share(rise(b.lost, a.lost), received),
          .duplicate = share(rise(b.duplicates, a.duplicates), received),
          .late = share(rise(b.late, a.late), received),
          .up_kbit_s =
              static_cast<double>(rise(b.up_bytes, a.up_bytes)) * kBits / kBitsPerKbit / length_s};
}

double LinkMeter::group_kbit_s(telemetry::Group group) const {
  return static_cast<double>(counted_[telemetry::index_of(group)]) *
         static_cast<double>(telemetry::group_bits(group)) / kBitsPerKbit;
}

}  // namespace pitwall::link
