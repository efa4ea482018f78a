// The last word on what goes on the CAN bus. Judges the frames themselves, decoded again, with its
// own limits and its own memory; knows nothing of control or planning. Default deny. Refuses, never
// repairs: a refused frame is counted by reason and refused_now is a fault event for the supervisor
// on the next tick; a silent bus is a state that the drive-by-wire survives.
//   in     the frames proposed for this tick, the mode, whether the car is armed, its speed, the
//          instant of the command behind the frames
//   out    the frames that pass, in their order; one verdict per frame
//   units  as in the CAN database: degrees at the motor, %, kPa, gears
//   errors frames beyond kMaxFrames are refused as kTooMany
//
// The engine goes off at standstill only: a ct_report with state 11 passes while the car stands or
// is not armed, one with 12 in an emergency stop too, and in a controlled stop whose throttle does
// not close.
//
// Disarmed, only these pass: 1404 ct_report, 1405 ct_report_2, 1406 dash_switches_cmd, 1450
// ct_vehicle_acc_feedback. Brake frames are judged before the others, wherever they stand: where
// throttle and brake contradict each other it is the throttle that is refused.
//
//   armed and      throttle    brake                              steering
//   Driving        may rise    up to brake_max                    table
//   Coast          none        up to stop_brake, or less than was share of the table
//   ControlledStop may fall    up to stop_brake, or less than was share of the table
//   EmergencyStop  may fall    up to brake_max                    table
//   Standby,       none        up to brake_max, not less than     table, hardly moves
//   Halted                     hold_least once it is there
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "protocol/can/av21.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/mode.hpp"

namespace pitwall::safety {

inline constexpr std::size_t kMaxFrames = 16;     // 8 messages per tick, twice
inline constexpr std::size_t kGatedMessages = 8;  // kToCar messages of the database
inline constexpr std::size_t kSteerRows = 10, kStopBrakeRows = 5;
inline constexpr Duration kRateWindow = milliseconds(250);
inline constexpr std::size_t kMaxPerWindow = 31;  // all have 100 Hz: x 0.25 s x 1.2 + 1

enum class Verdict : std::uint8_t {
  kPass,
  kTooMany,         // more than kMaxFrames in one tick
  kUnknownId,       // not in the database
  kWrongDirection,  // in the database, but not ours to send
  kNotClassic,      // remote, FD or extended
  kWrongLength,
  kNotArmed,      // an actuator frame while disarmed
  kStale,         // the command behind it is older than the limit, or from the future
  kTooOften,      // more than kMaxPerWindow in any kRateWindow
  kStuckCounter,  // equals the last one that passed
  kOutOfRange,
  kTooFast,            // slew since any frame that passed, in real time
  kGearStep,           // more than one gear, or sooner than the least time between shifts
  kThrottleForbidden,  // throttle in a mode that does not drive
  kThrottleRises,      // in a stop
  kThrottleWithBrake,  // both above their thresholds
  kBrakeReleased,      // at standstill
  kEngineOff           // while the car moves
};
inline constexpr std::size_t kVerdicts = 18;

constexpr const char* text_of(Verdict verdict) {
  constexpr std::array<const char*, kVerdicts> kTexts{"pass",
                                                      "too many",
                                                      "unknown id",
                                                      "wrong direction",
                                                      "not a classic frame",
                                                      "wrong length",
                                                      "not armed",
                                                      "stale",
                                                      "too often",
                                                      "stuck counter",
                                                      "out of range",
                                                      "too fast",
                                                      "gear step",
                                                      "throttle forbidden",
                                                      "throttle rises",
                                                      "throttle with brake",
                                                      "brake released",
                                                      "engine off while moving"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

// Largest motor angle at a speed; linear between rows, constant outside.
struct SteerRow {
  double speed_mps, motor_deg;
};

// Largest pressure at a speed, likewise.
struct StopBrakeRow {
  double speed_mps, kpa;
};

struct GateParams {
  // About 1.5 times the steady-state angle for 28 m/s^2 plus 10 degrees. Speeds rise, angles do
  // not; angles within [5, 300].
  std::array<SteerRow, kSteerRows> steer{{{0.0, 240.0},
                                          {15.0, 240.0},
                                          {20.0, 230.0},
                                          {25.0, 200.0},
                                          {30.0, 165.0},
                                          {40.0, 97.0},
                                          {50.0, 66.0},
                                          {60.0, 50.0},
                                          {70.0, 40.0},
                                          {80.0, 33.0}}};
  double steer_slew_deg_per_s = 720.0;      // the motor's own limit
  double stop_steer_share = 0.85;           // of the table, in a stop
  double hold_steer_slew_deg_per_s = 60.0;  // at standstill; [1, steer_slew]
  // What the front tyres can take on a straight before they lock: 1.05 x 350 kPa per m/s^2 x 0.65
  // x 1.3 (g + downforce). Speeds and pressures rise; an unknown speed counts as none.
  std::array<StopBrakeRow, kStopBrakeRows> stop_brake{
      {{0.0, 3050.0}, {20.0, 3210.0}, {40.0, 3700.0}, {60.0, 4510.0}, {80.0, 5640.0}}};
  double hold_least_kpa = 300.0;
  double brake_max_kpa = 6000.0;
  double brake_rise_kpa_per_s = 30000.0;
  double brake_fall_kpa_per_s = 60000.0;
  double throttle_max_percent = 100.0;
  double throttle_rise_percent_per_s = 400.0;  // falling is free
  double both_throttle_percent = 2.0;          // above this with ...
  double both_brake_kpa = 100.0;               // ... above this is a contradiction
  double standing_mps = 1.0;                   // gear 0 only below
  std::uint8_t gear_max = 6;                   // [1, 8]
  Duration shift_least = milliseconds(100);    // between gears
  Duration command_age_max = milliseconds(50);
};

inline constexpr auto kGateRanges = std::to_array<world::NamedRange<GateParams>>({
    {"stop_steer_share", &GateParams::stop_steer_share, 0.5, 1.0},
    {"hold_steer_slew_deg_per_s", &GateParams::hold_steer_slew_deg_per_s, 1.0, 1500.0},
    {"hold_least_kpa", &GateParams::hold_least_kpa, 0.0, 3000.0},
    {"steer_slew_deg_per_s", &GateParams::steer_slew_deg_per_s, 60.0, 1500.0},
    {"brake_max_kpa", &GateParams::brake_max_kpa, 1000.0, 8191.0},
    {"brake_rise_kpa_per_s", &GateParams::brake_rise_kpa_per_s, 1000.0, 100000.0},
    {"brake_fall_kpa_per_s", &GateParams::brake_fall_kpa_per_s, 1000.0, 200000.0},
    {"throttle_max_percent", &GateParams::throttle_max_percent, 1.0, 100.0},
    {"throttle_rise_percent_per_s", &GateParams::throttle_rise_percent_per_s, 10.0, 2000.0},
    {"both_throttle_percent", &GateParams::both_throttle_percent, 0.0, 10.0},
    {"both_brake_kpa", &GateParams::both_brake_kpa, 0.0, 500.0},
    {"standing_mps", &GateParams::standing_mps, 0.1, 5.0},
});

inline constexpr auto kGateTimes = std::to_array<world::NamedTime<GateParams>>({
    {"shift_least_s", &GateParams::shift_least, 0.0, 1.0},
    {"command_age_max_s", &GateParams::command_age_max, 0.01, 0.2},
});

struct GateContext {
  world::Mode mode = world::Mode::kDisarmed;
  bool armed = false;         // mode is not disarmed, and the operator's arm request stands
  double speed_mps = kUnset;  // by the wheels; unset is judged as the highest speed
  Instant command_at{};       // when the command behind the actuator frames was computed
  Instant now{};
  bool engine_off = false;  // the throttle does not close in a stop
};

// Instants of the last frames of one id that passed.
struct PassWindow {
  std::array<Instant, kMaxPerWindow> at{};
  std::uint64_t count = 0;
};

// The most that the frames so far let a value be. It grows with time, and a frame that passes
// lowers it to its own value at most: no two frames that passed differ by more than the slew times
// the time between them and one rounding step, however many passed in between.
struct Ceiling {
  double value = std::numeric_limits<double>::infinity();
  Instant at{};
};

struct GearChange {
  double gear = kUnset;
  Instant at{};  // of the last change
};

// What the actuators were last told. Forgotten while disarmed, when the pedal counts as released.
struct GateMemory {
  Ceiling steer_deg, steer_negated_deg, brake_kpa, brake_negated_kpa, throttle_percent;
  double last_brake_kpa{}, last_throttle_percent{};
  GearChange gear;
};

struct GateState {
  std::array<PassWindow, kGatedMessages> windows{};
  std::array<std::uint8_t, kGatedMessages> counters{};  // of the last frame that passed
  GateMemory memory;
  std::array<std::uint64_t, kVerdicts> verdicts{};  // frames by verdict since the start
};
static_assert(std::is_trivially_copyable_v<GateState>);

struct GateVerdict {
  std::uint32_t id{};
  Verdict verdict{};
};

struct GateOutput {
  FixedVector<can::Frame, kMaxFrames> frames;     // what may be sent
  FixedVector<GateVerdict, kMaxFrames> verdicts;  // in the order proposed
  bool refused_now = false;
  Verdict first_refusal{};
  std::uint64_t refused_total{};  // since the start
};

GateOutput gate(const GateParams& params, GateState& state, const GateContext& context,
                std::span<const can::Frame> proposed);

// The limits of the tables at a speed; where it is not a number, that of the last row for steering
// and that of the first for the brake.
double steer_limit_deg(const GateParams& params, double speed_mps);
double stop_brake_limit_kpa(const GateParams& params, double speed_mps);

}  // namespace pitwall::safety
