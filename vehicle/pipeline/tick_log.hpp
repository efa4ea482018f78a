// Values for telemetry over more than one tick: the last message of each receiver, and lap times.
//   in     Inputs and Outputs of every tick, length of the track
//   out    the newest sample of each kind and unit; the last lap
//   invariants
//          a lap is timed from one forward crossing of station zero to the next; a car that jumps
//          or goes back across it starts a new measurement
//   units  SI; instants of the car's clock
//   cost   O(samples), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::pipeline {

class LapClock {
 public:
  void advance(double station_m, double length_m, Instant now);
  double last_lap_s() const { return last_lap_s_; }  // unset before the first whole lap

 private:
  double station_m_ = kUnset, last_lap_s_ = kUnset;
  Instant at_{};
  std::optional<Instant> crossed_;
};

class TickLog {
 public:
  void note(const Inputs& in, const Outputs& out, double track_length_m);

  const std::optional<world::GnssPosition>& position(std::size_t unit) const {
    return positions_[unit];
  }
  const std::optional<world::GnssVelocity>& velocity(std::size_t unit) const {
    return velocities_[unit];
  }
  const std::optional<world::GnssHeading>& heading(std::size_t unit) const {
    return headings_[unit];
  }
  const std::optional<world::ImuSample>& imu() const { return imu_; }
  double last_lap_s() const { return lap_.last_lap_s(); }
  Instant at() const { return at_; }  // of the newest tick

 private:
  std::array<std::optional<world::GnssPosition>, world::kGnssUnits> positions_{};
  std::array<std::optional<world::GnssVelocity>, world::kGnssUnits> velocities_{};
  std::array<std::optional<world::GnssHeading>, world::kGnssUnits> headings_{};
  std::optional<world::ImuSample> imu_;
  LapClock lap_;
  Instant at_{};
};
static_assert(std::is_trivially_copyable_v<TickLog>);

}  // namespace pitwall::pipeline
