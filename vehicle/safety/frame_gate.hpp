// Frame gate: the last check before frames go to the CAN bus. It decodes the frames again and
// checks them against its own limits and its own state, independent of control and planning. Frames
// are denied by default. The gate refuses and never repairs: a refused frame is counted by reason,
// and refused_now is a fault for the supervisor in the next tick. The drive-by-wire survives a
// silent bus.
//   in     the frames proposed for this tick, the mode, whether the car is armed, its speed, the
//          instant of the command behind the frames
//   out    the frames that pass, in their order; one verdict per frame
//   units  as in the CAN database: degrees at the motor, %, kPa, gears
//   errors frames beyond kMaxFrames are refused as kTooMany
//
// The engine may be shut down at standstill or while disarmed. While the car moves, a ct_report
// with state 12 passes in an emergency stop, and in a controlled stop whose throttle does not
// close; one with state 11 does not pass.
//
// While disarmed only these pass: 1404 ct_report, 1405 ct_report_2, 1406 dash_switches_cmd, 1450
// ct_vehicle_acc_feedback. Brake frames are checked before the others, at any position: if throttle
// and brake contradict each other, the throttle is refused.
//
//   armed and      throttle    brake                              steering
//   Driving        may rise    up to brake_max                    table
//   Coast          zero        up to stop_brake, or falling       stop_steer_share of the table
//   ControlledStop may fall    up to stop_brake, or falling       stop_steer_share of the table
//   EmergencyStop  may fall    up to brake_max                    table
//   Standby,       zero        up to brake_max; at least          table, slew limited to
//   Halted                     hold_least, or not falling         hold_steer_slew
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
  kWrongDirection,  // in the database, but sent by another node
  kNotClassic,      // remote, FD or extended
  kWrongLength,
  kNotArmed,      // an actuator frame while disarmed
  kStale,         // its command is older than the limit, or from the future
  kTooOften,      // more than kMaxPerWindow in any kRateWindow
  kStuckCounter,  // same counter as in the last frame that passed
  kOutOfRange,
  kTooFast,            // slew relative to the frames that passed, in real time
  kGearStep,           // more than one gear, or before shift_least has passed
  kThrottleForbidden,  // throttle in a mode that does not drive
  kThrottleRises,      // throttle rises in a stop
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

// Largest motor angle at a speed: linear between rows, constant outside.
struct SteerRow {
  double speed_mps, motor_deg;
};

// Largest brake pressure at a speed: linear between rows, constant outside.
struct StopBrakeRow {
  double speed_mps, kpa;
};

struct GateParams {
  // About 1.5 times the steady-state angle for 28 m/s^2 plus 10 degrees. Speeds rise, angles do not
  // rise; angles within [5, 300].
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
  double stop_steer_share = 0.85;           // of the table, in Coast and ControlledStop
  double hold_steer_slew_deg_per_s = 60.0;  // at standstill; [1, steer_slew]
  // Pressure at which the front tyres lock on a straight: 1.05 x 350 kPa per m/s^2 x 0.65 x 1.3 (g
  // + downforce). Speeds and pressures rise; an unknown speed counts as zero.
  std::array<StopBrakeRow, kStopBrakeRows> stop_brake{
      {{0.0, 3050.0}, {20.0, 3210.0}, {40.0, 3700.0}, {60.0, 4510.0}, {80.0, 5640.0}}};
  double hold_least_kpa = 300.0;
  double brake_max_kpa = 6000.0;
  double brake_rise_kpa_per_s = 30000.0;
  double brake_fall_kpa_per_s = 60000.0;
  double throttle_max_percent = 100.0;
  double throttle_rise_percent_per_s = 400.0;  // no limit on falling
  double both_throttle_percent = 2.0;          // refused above this together with a brake
  double both_brake_kpa = 100.0;               // above this
  double standing_mps = 1.0;                   // gear 0 passes only below
  std::uint8_t gear_max = 6;                   // [1, 8]
  Duration shift_least = milliseconds(100);    // minimum time between shifts
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
  bool armed = false;         // mode is not disarmed, and the arm request is set
  double speed_mps = kUnset;  // from the wheels; see the limit functions for unset
  Instant command_at{};       // when the command of the frames was computed
  Instant now{};
  bool engine_off = false;  // the throttle does not close in a stop
};

// Times of the last frames of one identifier that passed.
struct PassWindow {
  std::array<Instant, kMaxPerWindow> at{};
  std::uint64_t count = 0;
};

// Upper bound of a value from the frames that passed. It rises with the slew limit, and a frame
// that passes lowers it to at most its own value: two frames that passed differ by at most the slew
// times the time between them plus one rounding step, however many passed in between.
struct Ceiling {
  double value = std::numeric_limits<double>::infinity();
  Instant at{};
};

struct GearChange {
  double gear = kUnset;
  Instant at{};  // time of the last change
};

// Last values sent to the actuators. Cleared while disarmed, when the throttle counts as released.
struct GateMemory {
  Ceiling steer_deg, steer_negated_deg, brake_kpa, brake_negated_kpa, throttle_percent;
  double last_brake_kpa{}, last_throttle_percent{};
  GearChange gear;
};

struct GateState {
  std::array<PassWindow, kGatedMessages> windows{};
  std::array<std::uint8_t, kGatedMessages> counters{};  // of the last frame that passed
  GateMemory memory;
  std::array<std::uint64_t, kVerdicts> verdicts{};  // frame count per verdict since the start
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

// Limits of the tables at a speed. A speed that is not a number gives the last row for steering and
// the first row for the brake.
double steer_limit_deg(const GateParams& params, double speed_mps);
double stop_brake_limit_kpa(const GateParams& params, double speed_mps);

}  // namespace pitwall::safety
