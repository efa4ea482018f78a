// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/frame_gate.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::safety {
namespace {

namespace av21 = can::av21;
using world::Mode;

// The smallest step of a field: what rounding alone may add to a slew.
constexpr double kSteerStep_deg = 0.5, kBrakeStep_kpa = 1.0, kThrottleStep_percent = 0.01;
constexpr double kRateMargin = 1.2;
constexpr double kCtStateLast = 12.0, kCtStateDefault = 255.0;

struct Gated {
  std::uint32_t id;
  bool actuator;  // passes while armed only
};
// The whitelist, the gate's own. The brake stands first: see judged_order below.
constexpr std::array<Gated, kGatedMessages> kGated{{{av21::BrakePressureCmd::kId, true},
                                                    {av21::AcceleratorCmd::kId, true},
                                                    {av21::SteeringCmd::kId, true},
                                                    {av21::GearShiftCmd::kId, true},
                                                    {av21::CtReport::kId, false},
                                                    {av21::CtReport2::kId, false},
                                                    {av21::DashSwitchesCmd::kId, false},
                                                    {av21::CtVehicleAccFeedback::kId, false}}};

constexpr std::size_t kNotFound = kGatedMessages;

constexpr std::size_t gated_index(std::uint32_t id) {
  for (std::size_t i = 0; i < kGatedMessages; ++i)
    if (kGated[i].id == id) return i;
  return kNotFound;
}

constexpr std::size_t database_row(std::uint32_t id) {
  for (std::size_t i = 0; i < av21::kMessages.size(); ++i)
    if (av21::kMessages[i].id == id) return i;
  return av21::kMessages.size();
}

// What the database says of each gated message, looked up when compiled.
consteval std::array<can::MessageRow, kGatedMessages> gated_rows() {
  std::array<can::MessageRow, kGatedMessages> rows{};
  for (std::size_t i = 0; i < kGatedMessages; ++i)
    rows[i] = av21::kMessages[database_row(kGated[i].id)];
  return rows;
}
constexpr std::array<can::MessageRow, kGatedMessages> kRows = gated_rows();

constexpr std::size_t per_window(const can::MessageRow& row) {
  return static_cast<std::size_t>(kRateWindow.seconds() / row.period.seconds() * kRateMargin + 1.0);
}
consteval bool rows_are_sound() {
  for (const can::MessageRow& row : kRows)
    if (row.direction != can::Direction::kToCar || per_window(row) > kMaxPerWindow) return false;
  return true;
}
static_assert(rows_are_sound(), "every gated message is ours and fits the window");

std::uint8_t counter_of(const can::MessageRow& row, const can::Frame& frame) {
  std::uint64_t raw = 0;
  std::memcpy(&raw, frame.data.data(), sizeof raw);  // Intel order, as the host
  return static_cast<std::uint8_t>((raw >> row.counter_start) & ((1ull << row.counter_bits) - 1));
}

struct Allowance {
  double rise_per_s, fall_per_s, step;
};
bool too_fast(const Passed& last, double value, const Allowance& allowed, Instant now) {
  if (!last.known) return false;
  const double elapsed_s = (now - last.at).seconds();
  const double change = value - last.value;
  return change > allowed.rise_per_s * elapsed_s + allowed.step ||
         -change > allowed.fall_per_s * elapsed_s + allowed.step;
}

// The judges below decode the frame: decode() refuses every length but the database's.
struct Bench {
  const GateParams& params;
  const GateContext& context;
  GateState& state;
};

Verdict judge_brake(Bench& b, const can::Frame& frame) {
  av21::BrakePressureCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double kpa = m.brake_pressure_cmd;
  if (kpa > b.params.brake_max_kpa) return Verdict::kOutOfRange;
  const Allowance allowed{b.params.brake_rise_kpa_per_s, b.params.brake_fall_kpa_per_s,
                          kBrakeStep_kpa};
  if (too_fast(b.state.brake_kpa, kpa, allowed, b.context.now)) return Verdict::kTooFast;
  b.state.brake_kpa = {true, kpa, b.context.now};
  return Verdict::kPass;
}

Verdict throttle_by_mode(const Bench& b, double percent) {
  if (b.context.mode == Mode::kDriving || percent == 0.0) return Verdict::kPass;
  const bool stopping =
      b.context.mode == Mode::kControlledStop || b.context.mode == Mode::kEmergencyStop;
  if (!stopping) return Verdict::kThrottleForbidden;
  const Passed& last = b.state.throttle_percent;
  return last.known && percent <= last.value ? Verdict::kPass : Verdict::kThrottleRises;
}

Verdict judge_throttle(Bench& b, const can::Frame& frame) {
  av21::AcceleratorCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double percent = m.acc_pedal_cmd;
  if (percent < 0.0 || percent > b.params.throttle_max_percent) return Verdict::kOutOfRange;
  const Verdict by_mode = throttle_by_mode(b, percent);
  if (by_mode != Verdict::kPass) return by_mode;
  const Allowance allowed{b.params.throttle_rise_percent_per_s,
                          std::numeric_limits<double>::infinity(), kThrottleStep_percent};
  const Passed& last = b.state.throttle_percent;
  if (percent > last.value && too_fast(last, percent, allowed, b.context.now))
    return Verdict::kTooFast;
  const Passed& brake = b.state.brake_kpa;
  if (percent > b.params.both_throttle_percent && brake.known &&
      brake.value > b.params.both_brake_kpa)
    return Verdict::kThrottleWithBrake;
  b.state.throttle_percent = {true, percent, b.context.now};
  return Verdict::kPass;
}

Verdict judge_steering(Bench& b, const can::Frame& frame) {
  av21::SteeringCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double angle_deg = m.steering_motor_ang_cmd;
  if (std::abs(angle_deg) > steer_limit_deg(b.params, b.context.speed_mps))
    return Verdict::kOutOfRange;
  const Allowance allowed{b.params.steer_slew_deg_per_s, b.params.steer_slew_deg_per_s,
                          kSteerStep_deg};
  if (too_fast(b.state.steer_deg, angle_deg, allowed, b.context.now)) return Verdict::kTooFast;
  b.state.steer_deg = {true, angle_deg, b.context.now};
  return Verdict::kPass;
}

Verdict judge_gear(Bench& b, const can::Frame& frame) {
  av21::GearShiftCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double gear = m.desired_gear;
  const bool standing = b.context.speed_mps < b.params.standing_mps;  // unset: false
  if (gear > b.params.gear_max || (gear < 1.0 && !standing)) return Verdict::kOutOfRange;
  Passed& last = b.state.gear;  // `at` is the instant of the last change
  const double step = last.known ? std::abs(gear - last.value) : 0.0;
  if (step > 1.0) return Verdict::kGearStep;
  if (step > 0.0 && b.context.now - last.at < b.params.shift_least) return Verdict::kGearStep;
  if (!last.known || step > 0.0) last = {true, gear, b.context.now};
  return Verdict::kPass;
}

Verdict judge_report(const can::Frame& frame) {
  av21::CtReport m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const bool listed =
      (m.ct_state >= 1.0 && m.ct_state <= kCtStateLast) || m.ct_state == kCtStateDefault;
  return listed ? Verdict::kPass : Verdict::kOutOfRange;
}

Verdict judge_value(Bench& b, const can::Frame& frame, std::uint8_t length) {
  switch (frame.id) {
    case av21::BrakePressureCmd::kId:
      return judge_brake(b, frame);
    case av21::AcceleratorCmd::kId:
      return judge_throttle(b, frame);
    case av21::SteeringCmd::kId:
      return judge_steering(b, frame);
    case av21::GearShiftCmd::kId:
      return judge_gear(b, frame);
    case av21::CtReport::kId:
      return judge_report(frame);
    default:  // acknowledgements, switches, accelerations
      return frame.length == length ? Verdict::kPass : Verdict::kWrongLength;
  }
}

// What an id that is not on the whitelist is: one that others send, or nobody's.
Verdict stranger(std::uint32_t id) {
  return database_row(id) < av21::kMessages.size() ? Verdict::kWrongDirection : Verdict::kUnknownId;
}

bool too_often(const PassWindow& window, const can::MessageRow& row, Instant now) {
  const std::size_t limit = per_window(row);
  if (window.count < limit) return false;
  return now - window.at[(window.count - limit) % kMaxPerWindow] < kRateWindow;
}

Verdict judge(Bench& b, const can::Frame& frame) {
  if (frame.extended || frame.remote || frame.fd) return Verdict::kNotClassic;
  const std::size_t i = gated_index(frame.id);
  if (i == kNotFound) return stranger(frame.id);
  const can::MessageRow& row = kRows[i];
  if (kGated[i].actuator) {
    if (!b.context.armed) return Verdict::kNotArmed;
    const Duration age = b.context.now - b.context.command_at;
    if (age < Duration{} || age > b.params.command_age_max) return Verdict::kStale;
  }
  PassWindow& window = b.state.windows[i];
  if (too_often(window, row, b.context.now)) return Verdict::kTooOften;
  const std::uint8_t counter = row.has_counter ? counter_of(row, frame) : std::uint8_t{0};
  if (row.has_counter && b.state.counter_known[i] && b.state.counters[i] == counter)
    return Verdict::kStuckCounter;
  const Verdict value = judge_value(b, frame, row.length);
  if (value != Verdict::kPass) return value;
  window.at[window.count++ % kMaxPerWindow] = b.context.now;
  b.state.counters[i] = counter;
  b.state.counter_known[i] = true;
  return Verdict::kPass;
}

}  // namespace

double steer_limit_deg(const GateParams& params, double speed_mps) {
  const auto& rows = params.steer;
  if (speed_mps <= rows.front().speed_mps) return rows.front().motor_deg;
  for (std::size_t i = 1; i < kSteerRows; ++i) {
    const SteerRow &below = rows[i - 1], &above = rows[i];
    if (speed_mps > above.speed_mps) continue;
    if (std::isnan(speed_mps)) break;
    const double share = (speed_mps - below.speed_mps) / (above.speed_mps - below.speed_mps);
    return below.motor_deg + share * (above.motor_deg - below.motor_deg);
  }
  return rows.back().motor_deg;
}

GateOutput gate(const GateParams& params, GateState& state, const GateContext& context,
                std::span<const can::Frame> proposed) {
  GateContext own = context;
  own.armed = context.armed && context.mode != Mode::kDisarmed;
  if (!own.armed) state.steer_deg = state.brake_kpa = state.throttle_percent = state.gear = {};
  Bench bench{params, own, state};
  std::array<Verdict, kMaxFrames> verdicts{};
  const std::size_t judged = std::min(proposed.size(), kMaxFrames);
  for (const bool brakes : {true, false})
    for (std::size_t i = 0; i < judged; ++i)
      if ((proposed[i].id == av21::BrakePressureCmd::kId) == brakes)
        verdicts[i] = judge(bench, proposed[i]);

  GateOutput out;
  const auto settle = [&](const can::Frame& frame, Verdict verdict) {
    ++state.verdicts[static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::kPass) return out.frames.push(frame);
    if (!out.refused_now) out.first_refusal = verdict;
    return out.refused_now = true;
  };
  for (std::size_t i = 0; i < proposed.size(); ++i) {
    const Verdict verdict = i < judged ? verdicts[i] : Verdict::kTooMany;
    const bool settled = settle(proposed[i], verdict);
    CHECK(settled);
    if (i >= judged) continue;
    const bool listed = out.verdicts.push({proposed[i].id, verdict});
    CHECK(listed);
  }
  for (std::size_t v = 1; v < kVerdicts; ++v) out.refused_total += state.verdicts[v];
  return out;
}

}  // namespace pitwall::safety
