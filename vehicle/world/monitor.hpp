// List of all monitors of the car, by module and fault. Each module reports in a MonitorSet which
// of its monitors have a finding in this tick. The bench measures their detection times, and can
// disable a monitor to show that it is needed; a car file cannot.
//   invariants
//          a disabled monitor has no findings, and the input that it would refuse or stop for
//          passes
//   source fault catalogue of the bench, F01 to F36
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pitwall::world {

enum class Monitor : std::uint8_t {
  // gateway, gateway/bus_identity
  kMessageAge,    // a CAN message is late or lost (F01 to F05)
  kCounter,       // repeated, stuck or jumped counter (F06, F08, F09)
  kChecksum,      // F10
  kFrameShape,    // length, identifier, format (F11)
  kOwnId,         // another node sends our identifiers (F12)
  kDecodedRange,  // not finite, out of range, impossible slew (F07, F17, F18)
  kFrozenSignal,  // constant value with a live counter (F16)
  // safety/bus_guard
  kBusLoad,          // babbling node (F13)
  kControllerState,  // warning, passive, bus-off (F14)
  kTransmitStall,    // F15
  // localization
  kStreamAge,       // a receiver, an IMU or the wheels are late (F19, F24, F25)
  kSolution,        // status, variance, differential age (F19, F20)
  kInnovation,      // a step that contradicts the car's motion (F21, F23)
  kStamp,           // time stamp frozen, decreasing or in the future (F22)
  kUnitAgreement,   // the two units contradict each other (F21, F23, F24)
  kWheelAgreement,  // one wheel contradicts the others and the motion (F25)
  // safety
  kRadioLink,        // F29, F30
  kFlagAgreement,    // unknown or contradictory flag codes (F30)
  kRaceControl,      // heartbeat (F31)
  kSteeringFollows,  // command against feedback (F32)
  kBrakeFollows,     // F33
  kThrottleFollows,  // F34
  kClock,            // F35
  kTiming,           // ticks and load of the computer (F36)
  kOversteer,        // rear wheels, front wheels and receivers disagree
  kModule            // planning or control failed or late
};
inline constexpr std::size_t kMonitors = 26;

inline constexpr std::array<std::string_view, kMonitors> kMonitorNames{"message_age",
                                                                       "counter",
                                                                       "checksum",
                                                                       "frame_shape",
                                                                       "own_id",
                                                                       "decoded_range",
                                                                       "frozen_signal",
                                                                       "bus_load",
                                                                       "controller_state",
                                                                       "transmit_stall",
                                                                       "stream_age",
                                                                       "solution",
                                                                       "innovation",
                                                                       "stamp",
                                                                       "unit_agreement",
                                                                       "wheel_agreement",
                                                                       "radio_link",
                                                                       "flag_agreement",
                                                                       "race_control",
                                                                       "steering_follows",
                                                                       "brake_follows",
                                                                       "throttle_follows",
                                                                       "clock",
                                                                       "timing",
                                                                       "oversteer",
                                                                       "module"};

struct MonitorSet {
  std::uint32_t bits = 0;

  constexpr bool has(Monitor m) const { return (bits >> static_cast<unsigned>(m) & 1U) != 0; }
  constexpr void add(Monitor m) { bits |= 1U << static_cast<unsigned>(m); }
  constexpr void add(MonitorSet other) { bits |= other.bits; }
  constexpr bool empty() const { return bits == 0; }
  constexpr bool operator==(const MonitorSet&) const = default;
};
static_assert(kMonitors <= 32);

}  // namespace pitwall::world
