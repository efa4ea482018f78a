// Records that the car process and the guardian exchange through shared memory: values only.
//   CarRecord  by the car process, every tick: whether it is armed, the ego state, and the last
//              stop trajectory that passed stop_check
//   Status     by the guardian, every tick: whether it drives, and its last command on the bus
//   frames     as world/ego_state.hpp; instants on the monotonic clock of the machine
//
// Right to send. The car process sends unless a fresh Status says that the guardian drives its run.
// The guardian sends only while its Status says so, which it writes before its first frame.
//
//   car      sends    ......silent, stopped......  back: 3 records, quiet   sends
//   guardian watches |30 ms| drives .........................| handed back | watches
//
// A car process that returns within kHandBackLimit, armed and in the same run, gets the car back
// after kRecordsToBelieve records. Later the guardian keeps the car and stops it. The hold at
// standstill ends when the car process is reset, or started anew without being armed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/guardian/tangent_plane.hpp"
#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/mode.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::guardian {

inline constexpr Duration kHandBackLimit = milliseconds(500);  // after the takeover
inline constexpr int kRecordsToBelieve = 3;                    // consecutive fresh records
// An older Status is from a guardian that is dead or stopped.
inline constexpr Duration kStatusAgeMax = milliseconds(50);

struct CarRecord {
  std::uint64_t run = 0;       // of the car process; 0: no record
  std::uint64_t sequence = 0;  // tick number
  Instant at{};                // time of the tick
  world::Mode mode = world::Mode::kDisarmed;
  bool armed = false;     // actuator frames are sent, unless the guardian drives
  bool sends = false;     // sends frames in this tick
  bool reset = false;     // by the operator or by a start without --arm: ends the hold
  bool finished = false;  // the process ended normally and the car stood
  bool barred = false;    // an earlier run ended armed: --arm is refused until one start without it
  world::EgoState ego;
  steering::Learned learned;  // learned steering correction
  double tyre_c = kUnset;     // coldest tyre
  Geodetic datum;
  world::Trajectory stop;  // empty if none has passed stop_check
};
static_assert(std::is_trivially_copyable_v<CarRecord>);

enum class Mode : std::uint8_t {
  kIdle,            // the car is not armed, or stands
  kWatching,        // the car drives, and its commands are received
  kDriving,         // the guardian stops the car
  kHalted,          // the car stands; the guardian holds the brake
  kHandedBack,      // handed back; no command received yet
  kNothingToDrive,  // the car is silent, but the guardian must not or cannot act
};
inline constexpr std::size_t kModes = 6;

// Why the guardian is in its mode.
enum class Cause : std::uint8_t {
  kNone,
  kCarSilent,  // no command for 30 ms
  kStale,      // the last record is much older than the last command
  kNoPath,     // no checked stop trajectory
  kOffPath,    // the car is not on the trajectory
  kBusSilent,  // no node sends: the bus or the guardian's socket failed
  kCarBack,    // the car process publishes records again, in time
  kCarSends,   // the car process sends, as if the guardian were dead
  kStands,     // the car has stopped
  kReset       // by the operator, or by a start without being armed
};
inline constexpr std::size_t kCauses = 10;

// Input of the steering during the stop.
enum class Guidance : std::uint8_t {
  kNone,
  kPosition,  // gyroscope or steering, wheels, GNSS positions
  kInertial,  // gyroscope and wheels since the car's last estimate
  kOpenLoop   // no yaw rate: steering angle over the distance travelled
};
inline constexpr std::size_t kGuidances = 4;

constexpr const char* text_of(Mode mode) {
  constexpr std::array<const char*, kModes> kTexts{"idle",   "watching",    "driving",
                                                   "halted", "handed back", "nothing to drive"};
  return kTexts[static_cast<std::size_t>(mode)];
}
constexpr const char* text_of(Cause cause) {
  constexpr std::array<const char*, kCauses> kTexts{"none",
                                                    "car process silent",
                                                    "record too old",
                                                    "no checked stop trajectory",
                                                    "car not on the stop trajectory",
                                                    "bus silent",
                                                    "car process is back",
                                                    "car process sends",
                                                    "car stands",
                                                    "reset"};
  return kTexts[static_cast<std::size_t>(cause)];
}
constexpr const char* text_of(Guidance guidance) {
  constexpr std::array<const char*, kGuidances> kTexts{"", "by positions", "by gyroscope",
                                                       "open loop"};
  return kTexts[static_cast<std::size_t>(guidance)];
}

constexpr bool drives(Mode mode) { return mode == Mode::kDriving || mode == Mode::kHalted; }

// Counters of the last frames, to be continued.
struct CommandCounters {
  std::uint8_t brake = 0, throttle = 0, steering = 0, report = 0;
};

struct Status {
  std::uint64_t run = 0;  // run of the car process that the status refers to
  Instant at{};           // tick of the guardian
  Mode mode = Mode::kIdle;
  Cause cause = Cause::kNone;
  Guidance guidance = Guidance::kNone;
  bool latched = false;                 // the guardian keeps the car until a reset
  Instant since{};                      // since when in this mode
  Instant drove_from{}, drove_until{};  // last takeover of this run; both unset: never
  CommandCounters counters;
  world::ActuatorCommand command;  // last command sent
  std::uint32_t takeovers = 0, hand_backs = 0;
};
static_assert(std::is_trivially_copyable_v<Status>);

}  // namespace pitwall::guardian
