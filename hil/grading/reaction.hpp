// Measurement of the reaction time to a flag or a stop, and of the stopping distance.
//   in     once per tick, in order of time: restriction and name of the flag, the present stop of
//          the car, speed, throttle, brake
//   out    one Reaction for each flag that is more restrictive than the one before, and for each
//          stop that the car begins itself, while the car moves
//   invariants
//          the car has reacted at the first tick at which the throttle is at most kThrottleShare of
//          its earlier value, the brake pressure is kBrakeRise above its earlier value, or the car
//          has begun a stop
//          the car stands below kStands_mps; the stopping distance is the integral of the speed
//          until then. A later, less restrictive flag ends the measurement, because the car need
//          not stop any more
//   bound  the first kKept reactions are kept, the rest is counted
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
  int restriction = 0;  // of the flag; a larger number is more restrictive
  std::string_view flag;
  std::string_view stop;  // present stop of the car; empty: none
  double speed_mps = kUnset, throttle = kUnset, brake_kpa = kUnset;
};

struct Reaction {
  std::string to;  // name of the flag or the stop
  Instant at{};
  double speed_mps = kUnset;           // when the flag or stop came
  std::optional<Duration> reaction{};  // until the car reacted
  std::optional<double> stop_m{};      // distance until standstill
};

class ReactionMonitor {
 public:
  static constexpr double kThrottleShare = 0.5, kBrakeRise_kpa = 100.0, kStands_mps = 0.3;
  static constexpr double kCoasts = 0.02;  // a throttle below this cannot be lifted further
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
  bool open_ = false;  // the newest reaction is still measured
  double driven_m_ = 0.0, throttle_then_ = kUnset, brake_then_kpa_ = kUnset;
};

}  // namespace pitwall::grading
