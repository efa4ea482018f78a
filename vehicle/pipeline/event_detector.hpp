// Mapper of changes in a tick to events for the pit wall: mode, arming, flags, laps, and the begin
// and end of every fault. Values may be overwritten on the radio; events are delivered.
//   in     Outputs of this tick, the car's fault log; one call per tick
//   out    events in the order: faults, mode, arming, flags, lap (laps as race control counts them)
//   invariants
//          each change once, and the end only of a fault whose begin was reported; the first tick
//          reports the differences from a car that was just switched on
//   errors faults that the log has dropped, and events without room, are counted in `missed`
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/delivery/events.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/car.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::pipeline {

using TickEvents = FixedVector<telemetry::Event, 32>;

class EventDetector {
 public:
  const TickEvents& detect(const Car& car, const Outputs& out, Instant now);
  std::uint64_t missed() const { return missed_; }

 private:
  void add(const telemetry::Event& event);
  void detect_faults(const safety::FaultLog& log, safety::CauseSet causes, Instant now);
  void detect_flags(const world::RaceControl& race, Instant now);

  TickEvents events_;
  std::uint64_t faults_ = 0;   // entries of the log that were reported
  safety::CauseSet reported_;  // reported faults that have not ended
  world::Mode mode_ = world::Mode::kDisarmed;
  safety::Arming arming_ = safety::Arming::kNotRequested;
  world::TrackFlag track_ = world::TrackFlag::kNone;
  world::VehicleFlag vehicle_ = world::VehicleFlag::kNone;
  std::uint8_t laps_ = 0;
  std::optional<Instant> lap_at_;  // time of the last lap event
  std::uint64_t missed_ = 0;
};

}  // namespace pitwall::pipeline
