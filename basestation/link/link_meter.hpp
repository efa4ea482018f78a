// Radio figures over the last 1, 5 and 30 s, from counters that only rise.
//   in     the link's counters, ten times a second; packets with their groups
//   out    loss, rate, duplicates, late packets and round trip of a window; the rate of each group;
//          the limit of the car's sending rate, computed from the received rate and the use of that
//          limit that the car reports
//   invariants
//          loss of a window is the share of packets sent in it that are missing; NaN if none was
//          sent. A new session starts the windows again
//   units  shares 0 .. 1, kbit/s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "protocol/telemetry/endpoint/link_report.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::link {

struct PathCount {
  std::uint64_t received = 0, lost = 0, duplicates = 0, late = 0, up_bytes = 0;
};
struct LinkCount {
  std::uint64_t packets = 0, missing = 0;  // of all paths: numbers received, numbers missing
  std::array<PathCount, telemetry::kPaths> paths{};
};
LinkCount count_of(const telemetry::LinkReport& report, std::uint64_t packets,
                   std::uint64_t missing);

struct PathWindow {
  double loss = kUnset, duplicate = kUnset, late = kUnset, up_kbit_s = kUnset;
};

class LinkMeter {
 public:
  static constexpr Duration kEvery = milliseconds(100), kLongest = seconds(30);

  void note(const LinkCount& count, Instant now, double round_trip_ms = kUnset);
  void packet(telemetry::GroupSet groups, Instant now);

  // The rate received by the path, and the share of its limit that the car says it uses.
  void note_use(std::size_t path, double received_kbit_s, double use);

  double loss(Duration window) const;
  double round_trip_ms(Duration window) const;  // the longest in the window
  double down_cap_kbit_s(std::size_t path) const { return caps_kbit_s_[path]; }
  PathWindow path(std::size_t path, Duration window) const;
  double group_kbit_s(telemetry::Group group) const;  // of the last whole second

 private:
  struct Sample {
    Instant at;
    LinkCount count;
    double round_trip_ms = kUnset;
  };
  const Sample* before(Duration window) const;

  std::deque<Sample> samples_;  // oldest first
  std::array<std::uint32_t, telemetry::kGroups> counting_{}, counted_{};
  Instant second_{};
  std::array<double, telemetry::kPaths> caps_kbit_s_ = [] {
    std::array<double, telemetry::kPaths> none{};
    none.fill(kUnset);
    return none;
  }();
};

}  // namespace pitwall::link
