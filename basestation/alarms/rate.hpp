// Alarm rate of the last minutes against the rate that an operator can handle.
//   in     the time of each activation
//   out    activations in the last 10 min; whether the list is flooded
//   invariants
//          a flood begins above kFloodAbove in 10 min, and ends at kFloodOver or fewer
//   bound  the newest kKept activations are stored; more in 10 min count as kKept
//   source EEMUA 191, ISA-18.2: about one alarm in 10 min is acceptable, more than 10 is a flood
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::alarms {

inline constexpr Duration kRateWindow = seconds(600);
inline constexpr std::size_t kFloodAbove = 10, kFloodOver = 5;

class AlarmRate {
 public:
  static constexpr std::size_t kKept = 256;

  void add(Instant at);
  // Returns true if a flood began or ended.
  bool advance(Instant now);
  std::size_t per_10_min() const { return count_; }
  bool flood() const { return flood_; }
  std::uint64_t ever() const { return ever_; }

 private:
  std::array<Instant, kKept> times_{};
  std::uint64_t ever_ = 0;
  std::size_t count_ = 0;
  bool flood_ = false;
};

}  // namespace pitwall::alarms
