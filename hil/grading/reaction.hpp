// Reaction time to a flag or a stop, and distance until standstill.
//   in     once per tick, in the order of time: the flag's restriction and name, the stop that the
//          car is in, speed, throttle, brake
//   out    one Reaction for each flag that restricts more than the one before, and for each stop
//          that the car itself begins, while it drives
//   invariants
//          it has answered at the first tick at which the throttle is at most kThrottleShare of
//          what it was, or the brake kBrakeRise above it, or the car has begun a stop
//          it stands below kStands_mps; the distance is the integral of the speed until then. A
//          later call for less caution ends the count: the car was not to stand any more
//   bound  the first kKept, the rest is counted
//   units  m, m/s, kPa; throttle 0 .. 1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::grading {

struct ReactionTick {
  Instant at{};
  int restriction = 0;  // of the flag; more binds more
  std::string_view flag;
  std::string_view stop;  // that the car is in; empty: none
  double speed_mps = kUnset, throttle = kUnset, brake_kpa = kUnset;
};

struct Reaction {
  std::string to;  // the flag's or the stop's name
  Instant at{};
  double speed_mps = kUnset;           // when it came
  std::optional<Duration> reaction{};  // until the car did something
  std::optional<double> stop_m{};      // until it stood
};

class ReactionBook {
 public:
  static constexpr double kThrottleShare = 0.5, kBrakeRise_kpa = 100.0, kStands_mps = 0.3;
  static constexpr double kCoasts = 0.02;  // a throttle that cannot be lifted any further
  static constexpr std::size_t kKept = 32;

  void observe(const ReactionTick& tick);
  const std::vector<Reaction>& reactions() const { return reactions_; }
  std::uint64_t left_out() const { return left_out_; }

 private:
  void begin(std::string_view to, const ReactionTick& tick, bool answered);
  void follow(const ReactionTick& tick, double driven_m);

  std::vector<Reaction> reactions_;
  std::uint64_t left_out_ = 0;
  std::optional<ReactionTick> before_;
  std::string stop_;
  bool open_ = false;  // the newest one is followed
  double driven_m_ = 0.0, throttle_then_ = kUnset, brake_then_kpa_ = kUnset;
};

}  // namespace pitwall::grading
