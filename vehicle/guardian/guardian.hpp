// Guardian of the car process: monitors its commands on the bus and, if they stop at speed, drives
// the last checked stop trajectory until the car stands. It is a second process with its own bus
// socket, its own ports of the receivers and its own frame gate; it has only the record and the
// frames of the car process.
//   in     the newest CarRecord (or null), frames from the bus, samples of the receivers, the time
//   out    frames that passed the guardian's own gate, Status
//   rate   every 5 ms (any rate from 1 to 10 ms); frames are sent every kSendPeriod while it drives
//   invariants
//          it takes over only if all of this holds:
//            no command (1400..1402) of the car was received for kSilence, but other frames were;
//            time in which the guardian itself did not run is not counted;
//            the last record says armed and driving, coasting or stopping, and is at most
//            kRecordLag older than the last command; it holds a checked stop trajectory, and the
//            car is on it
//          it hands the car back, or keeps it, as record.hpp says
//   errors none: the reason not to act is the cause of kNothingToDrive
//   cost   no allocation; below 20 us
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/guardian/command_frames.hpp"
#include "vehicle/guardian/reckoning.hpp"
#include "vehicle/guardian/record.hpp"
#include "vehicle/safety/frame_gate.hpp"
#include "vehicle/safety/oversteer.hpp"
#include "vehicle/safety/safe_stop.hpp"
#include "vehicle/safety/stop_following.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::guardian {

inline constexpr Duration kSilence = milliseconds(30);
inline constexpr Duration kRecordLag = milliseconds(100);
inline constexpr Duration kSendPeriod = milliseconds(10);
inline constexpr Duration kTick = milliseconds(5);

struct Params {
  ReckoningParams reckoning;
  safety::FollowingParams following;
  safety::GateParams gate;
  double off_path_max_m = 5.0;  // lateral distance to the trajectory at the takeover
  Duration standstill_dwell = milliseconds(500);
  Duration bus_silence_max = milliseconds(50);  // of all other nodes
  Duration position_age_max = milliseconds(500);
  Duration hand_back_again = seconds(5);  // a takeover within this time after a hand-back is final
};

struct State {
  Status status;
  CarRecord record;  // the newest
  ReceivedCommands received;
  Instant stepped_at{};           // last tick
  Instant silent_from{};          // last command, plus the time in which no tick ran
  Instant others_at{};            // newest frame of another node
  world::VehicleSignals signals;  // wheel speeds, steering, brake pressures only
  safety::FrontWheelState front_wheels;
  double front_slip = kUnset;  // safety/oversteer.hpp
  ReckoningState reckoning;
  safety::FollowingState following;
  safety::SafeStopState open_loop;
  safety::GateState gate;
  Instant next_send{}, standing_since{}, handed_back_at{};
  bool standing = false, handed_back = false;
  int fresh_records = 0;
  double ax_mps2 = kUnset, ay_mps2 = kUnset;  // specific force, for the accelerations frame
};
static_assert(std::is_trivially_copyable_v<State>);

struct Inputs {
  const CarRecord* record = nullptr;  // the newest valid one; null if none yet
  std::span<const can::ReceivedFrame> can;
  const world::SensorInput& sensors;
  Instant now{};
};

struct Output {
  FixedVector<can::Frame, safety::kMaxFrames> frames;
  bool mode_changed = false;
  std::uint64_t gate_refusals = 0;  // since the last takeover
};

Output step(const Params& params, State& state, const Inputs& inputs);

}  // namespace pitwall::guardian
