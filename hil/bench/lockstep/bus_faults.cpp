// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/bus_faults.hpp"

#include <algorithm>

#include "hil/bench/rig.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;

constexpr auto kCar = static_cast<std::uint8_t>(Node::kCar);
constexpr auto kStranger = static_cast<std::uint8_t>(Node::kStranger);
// Within a frame or two it is sent in any case: no stall.
constexpr Duration kTakenSoon = milliseconds(5);

can::Frame babble() {
  can::Frame frame;
  frame.id = 0;
  frame.length = 8;
  return frame;
}

world::ControllerState controller_of(can_bus::ErrorState state) {
  switch (state) {
    case can_bus::ErrorState::kActive:
      return world::ControllerState::kActive;
    case can_bus::ErrorState::kWarning:
      return world::ControllerState::kWarning;
    case can_bus::ErrorState::kPassive:
      return world::ControllerState::kPassive;
    case can_bus::ErrorState::kBusOff:
      return world::ControllerState::kBusOff;
  }
  CHECK(false);
}

}  // namespace

double BusFaults::value_of(BenchFaultKind kind, Instant now) const {
  double value = 0.0;
  for (const faults::BenchFault& fault : plan_)
    if (fault.kind == kind && faults::active(fault, now)) value = std::max(value, fault.value);
  return value;
}

void BusFaults::act_on(can_bus::MemoryBus& bus, Instant now) const {
  if (plan_.empty()) return;
  const bool stalled = std::ranges::any_of(plan_, [this, now](const faults::BenchFault& fault) {
    const bool cured = restarted_at_ && *restarted_at_ > fault.start;
    return fault.kind == BenchFaultKind::kTransmitStall && faults::active(fault, now) && !cured;
  });
  bus.disturb(value_of(BenchFaultKind::kBusErrors, now));
  bus.damage_transmitter(kCar, value_of(BenchFaultKind::kBusTransmitter, now));
  bus.stall(kCar, stalled);
  bus.babble(kStranger, babble(), value_of(BenchFaultKind::kBusBabble, now), now);
}

world::LinkObservation link_of_car(const can_bus::MemoryBus& bus) {
  const can_bus::PortStatus status = bus.status(kCar);
  return {.controller = controller_of(status.state),
          .error_frames = bus.counters().error_frames,
          .tx_drops = status.dropped,
          .restarts = status.restarts,
          .tx_stalled = status.blocked >= kTakenSoon ? status.blocked : Duration{}};
}

}  // namespace pitwall::bench
