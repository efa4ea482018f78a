// State machine of the drive-by-wire computer (misc_report.sys_state) as a table of transitions.
//   in     the state and its duration, requests of the computer and of race control, the engine
//   out    the next state: the first row of kTransitions whose state and event match, after its
//          dwell time
//   source RaptorSM of the public AV-21 simulator (1-2-3-4-5-6-19, 19-7-8-9, 9-16 on CT 12), with
//          the shut-down state 10 of the signal's own value table between 9 and 19
//
//   power on -> subsystems -> actuator test -> test done -> crank ready -> pre-crank check
//     -> STANDBY --CT 5 and orange--> CRANKING -> ENGINE RUNNING --not orange, CT 6..10--> DRIVING
//   CT 11 or engine kill: -> SHUT ENGINE -> STANDBY       CT 12: -> EMERGENCY SHUTDOWN
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/mode.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::drive_by_wire {

struct SystemInputs {
  world::CtState ct = world::CtState::kDefault;
  bool orange = false;       // race control: start the engine
  bool engine_kill = false;  // race control: stop it
  bool engine_running = false;
  bool standstill = false;
};

enum class SystemEvent : std::uint8_t {
  kAlways,          // after the dwell time alone
  kCrankRequested,  // CT cranking while race control shows orange
  kCrankWithdrawn,  // CT no longer cranking
  kEngineRuns,
  kEngineStopped,
  kReleased,      // race control no longer shows orange and the computer is ready to drive
  kShutdown,      // CT controlled shutdown, or engine kill by race control
  kEmergency,     // CT emergency shutdown
  kEmergencyOver  // CT left emergency, the car stands and the engine is off
};

struct Transition {
  world::SysState from;
  SystemEvent event;
  Duration dwell;  // the state lasts at least this long before this row applies
  world::SysState to;
};

// Durations of start-up and of the starter: chosen for the bench, there are no public figures.
inline constexpr Duration kStartUpStep = milliseconds(500);
inline constexpr Duration kActuatorTest = seconds(2);
inline constexpr Duration kStarterTimeout = seconds(8);

inline constexpr std::array kTransitions{
    Transition{world::SysState::kPowerOn, SystemEvent::kAlways, kStartUpStep,
               world::SysState::kSubsystemsConnected},
    Transition{world::SysState::kSubsystemsConnected, SystemEvent::kAlways, kStartUpStep,
               world::SysState::kActuatorTesting},
    Transition{world::SysState::kActuatorTesting, SystemEvent::kAlways, kActuatorTest,
               world::SysState::kActuatorTestDone},
    Transition{world::SysState::kActuatorTestDone, SystemEvent::kAlways, kStartUpStep,
               world::SysState::kCrankReady},
    Transition{world::SysState::kCrankReady, SystemEvent::kAlways, kStartUpStep,
               world::SysState::kPreCrankCheck},
    Transition{world::SysState::kPreCrankCheck, SystemEvent::kAlways, kStartUpStep,
               world::SysState::kStandby},
    Transition{world::SysState::kStandby, SystemEvent::kCrankRequested, kStartUpStep,
               world::SysState::kCranking},
    Transition{world::SysState::kCranking,
               SystemEvent::kEmergency,
               {},
               world::SysState::kEmergencyShutdown},
    Transition{
        world::SysState::kCranking, SystemEvent::kShutdown, {}, world::SysState::kShutEngine},
    Transition{world::SysState::kCranking, SystemEvent::kEngineRuns, kStartUpStep,
               world::SysState::kEngineRunning},
    Transition{world::SysState::kCranking, SystemEvent::kAlways, kStarterTimeout,
               world::SysState::kEngineFailedToStart},
    Transition{world::SysState::kEngineFailedToStart,
               SystemEvent::kCrankWithdrawn,
               {},
               world::SysState::kStandby},
    Transition{world::SysState::kEngineRunning,
               SystemEvent::kEmergency,
               {},
               world::SysState::kEmergencyShutdown},
    Transition{
        world::SysState::kEngineRunning, SystemEvent::kShutdown, {}, world::SysState::kShutEngine},
    Transition{world::SysState::kEngineRunning, SystemEvent::kEngineStopped, seconds(1),
               world::SysState::kShutEngine},
    Transition{world::SysState::kEngineRunning, SystemEvent::kReleased, kStartUpStep,
               world::SysState::kDriving},
    Transition{world::SysState::kDriving,
               SystemEvent::kEmergency,
               {},
               world::SysState::kEmergencyShutdown},
    Transition{world::SysState::kDriving, SystemEvent::kShutdown, {}, world::SysState::kShutEngine},
    Transition{world::SysState::kShutEngine,
               SystemEvent::kEmergency,
               {},
               world::SysState::kEmergencyShutdown},
    Transition{world::SysState::kShutEngine, SystemEvent::kEngineStopped, kStartUpStep,
               world::SysState::kStandby},
    Transition{world::SysState::kEmergencyShutdown, SystemEvent::kEmergencyOver, kStartUpStep,
               world::SysState::kStandby},
};

bool happens(SystemEvent event, const SystemInputs& in);

world::SysState next_state(world::SysState state, Duration lasted, const SystemInputs& in);

}  // namespace pitwall::drive_by_wire
