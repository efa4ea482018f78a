// Vehicle state for the comparison of radio protocols: the hundred signals of the chassis and its
// motion (84 real numbers, 10 integers, 6 booleans). The decisions and the monitors of the car are
// in other groups.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "protocol/telemetry/packet/body.hpp"

namespace pitwall::telemetry {

inline constexpr std::array kVehicleStateGroups{
    Group::kEgo,        Group::kTrack,      Group::kCommand,  Group::kFeedback,     Group::kWheels,
    Group::kDynamics,   Group::kSuspension, Group::kTyres,    Group::kTread,        Group::kEngine,
    Group::kPowertrain, Group::kFuel,       Group::kElectric, Group::kSteeringUnit, Group::kBrakes};

inline constexpr GroupSet kVehicleStateSet = [] {
  GroupSet set;
  for (const Group group : kVehicleStateGroups) set.add(group);
  return set;
}();

inline constexpr std::size_t kVehicleStateSize = 100;
inline constexpr auto kVehicleState = [] {
  std::array<FieldIndex, kVehicleStateSize> fields{};
  std::size_t at = 0;
  for (FieldIndex i = 0; i < kFieldCount; ++i)
    if (kVehicleStateSet.has(kFields[i].group)) fields[at++] = i;  // an excess does not compile
  return fields;
}();

constexpr std::size_t vehicle_state_count(FieldKind kind) {
  std::size_t count = 0;
  for (const FieldIndex i : kVehicleState) count += kFields[i].kind() == kind ? 1U : 0U;
  return count;
}
static_assert(kVehicleState.back() != 0, "the vehicle state has fewer than a hundred fields");
static_assert(vehicle_state_count(FieldKind::kReal) == 84);
static_assert(vehicle_state_count(FieldKind::kInteger) == 10);
static_assert(vehicle_state_count(FieldKind::kYesNo) == 6);

static_assert(bytes_of(kVehicleStateSet) <= 121, "the values of the vehicle state have grown");
inline constexpr std::size_t kVehicleStateDatagram =
    kHeaderSize + kTagSize + kBodyFixed + state_bytes(kVehicleStateSet, Direction::kDown);
// With IP and UDP at most 179 bytes: 0.67 of a signed MAVLink 2 message that is scaled by hand.
static_assert(kVehicleStateDatagram <= 151, "the vehicle state as one datagram has grown");

}  // namespace pitwall::telemetry
