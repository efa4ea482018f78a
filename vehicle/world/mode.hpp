// Mode of the car, set by safety/supervisor. gateway/handshake derives the CT state for the
// drive-by-wire from it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall::world {

enum class Mode : std::uint8_t {
  kDisarmed,        // no actuator frame is sent
  kStandby,         // armed: holds the brake at standstill, engine may start
  kDriving,         // follows the drive trajectory
  kControlledStop,  // follows the stop trajectory
  kEmergencyStop,   // brakes as hard as grip allows, holds the line
  kHalted,          // latched at standstill after a stop; left by a reset or a dead bus only
  kCoast            // follows the drive trajectory without throttle, until a fault clears
};
inline constexpr std::size_t kModes = 7;

// Computer (CT) state, CAN ct_report.ct_state.
enum class CtState : std::uint8_t {
  kPowerOn = 1,
  kInitialized = 2,
  kActuatorTest = 3,
  kCrankReady = 4,
  kCranking = 5,
  kRaceReady = 6,
  kInitDriving = 7,
  kCaution = 8,
  kNominalRace = 9,
  kCoordinatedStop = 10,
  kControlledShutdown = 11,
  kEmergencyShutdown = 12,
  kDefault = 255
};

}  // namespace pitwall::world
