// Record that the car process and the guardian share through memory: values only.
//   CarRecord  by the car process, every tick: whether it is armed, where the car is, and the last
//              stop trajectory that passed stop_check
//   Status     by the guardian, every tick: whether it drives, and what it last said on the bus
//   frames     as world/ego_state.hpp; instants on the monotonic clock of the machine
//
// Who may speak. The car process speaks unless a fresh Status says that the guardian drives its
// run; the guardian speaks only while its Status says so, and says so before its first frame.
//
//   car      speaks  ......silent, stopped......  back: 3 records, quiet   speaks
//   guardian watches |30 ms| drives .........................| handed back | watches
//
// A car process that comes back within kHandBackLimit, armed and in the same run, gets the car back
// after kRecordsToBelieve records; later the guardian keeps it and the car stands at the end. The
// hold at standstill ends when the car process is reset or started anew without being armed.
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

inline constexpr Duration kHandBackLimit = milliseconds(500);  // of driving
inline constexpr int kRecordsToBelieve = 3;                    // in a row, each fresh
// A Status that is older belongs to a guardian that is dead or stopped.
inline constexpr Duration kStatusAgeMax = milliseconds(50);

struct CarRecord {
  std::uint64_t run = 0;       // of the car process; 0: there is none
  std::uint64_t sequence = 0;  // counts its ticks
  Instant at{};                // of the tick
  world::Mode mode = world::Mode::kDisarmed;
  bool armed = false;     // actuator frames are sent, or would be if the guardian did not drive
  bool speaks = false;    // sends frames in this tick
  bool reset = false;     // the operator's, or a start without being armed: the hold may end
  bool finished = false;  // the process ended in order and the car stood
  bool barred = false;    // a run before ended armed: not armed until one start without --arm
  world::EgoState ego;
  steering::Learned learned;  // of the car's steering
  double tyre_c = kUnset;     // the coldest
  Geodetic datum;
  world::Trajectory stop;  // empty: none ever passed stop_check
};
static_assert(std::is_trivially_copyable_v<CarRecord>);

enum class Mode : std::uint8_t {
  kIdle,            // the car is not armed, or stands
  kWatching,        // it drives, and is heard
  kDriving,         // the guardian stops the car
  kHalted,          // it stands; the guardian holds the brake
  kHandedBack,      // the car process has the car again, and is not heard yet
  kNothingToDrive,  // the car is silent, and the guardian must not or cannot act; cause says why
};
inline constexpr std::size_t kModes = 6;

// Why the guardian is in its mode.
enum class Cause : std::uint8_t {
  kNone,
  kCarSilent,  // no command for 30 ms
  kStale,      // the last record is too much older than the last command
  kNoPath,     // no stop trajectory was ever checked
  kOffPath,    // the car is not where the trajectory is
  kBusSilent,  // nobody speaks: the fault is the bus, or our own socket
  kCarBack,    // the car process publishes again, in time
  kCarSpeaks,  // the car process sends: it took the guardian for dead
  kStands,     // stopped
  kReset       // by the operator, or by a start without being armed
};
inline constexpr std::size_t kCauses = 10;

// What the stop is steered by.
enum class Guidance : std::uint8_t {
  kNone,
  kPosition,  // gyroscope or steering, wheels, GNSS positions
  kInertial,  // gyroscope and wheels since the car's last word
  kOpenLoop   // nothing turns with the car: steering angle along the travelled distance
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
                                                    "car process speaks",
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

// Counters of the last frames, to go on from.
struct CommandCounters {
  std::uint8_t brake = 0, throttle = 0, steering = 0, report = 0;
};

struct Status {
  std::uint64_t run = 0;  // the run of the car process that it speaks of
  Instant at{};           // of the guardian's tick
  Mode mode = Mode::kIdle;
  Cause cause = Cause::kNone;
  Guidance guidance = Guidance::kNone;
  bool latched = false;  // the car must not go on: stopped by the guardian until a reset
  Instant since{};       // of the mode
  Instant drove_from{}, drove_until{};  // the last time that it drove this run; both unset: never
  CommandCounters counters;
  world::ActuatorCommand command;  // the last that it sent
  std::uint32_t takeovers = 0, hand_backs = 0;
};
static_assert(std::is_trivially_copyable_v<Status>);

}  // namespace pitwall::guardian
