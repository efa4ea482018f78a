// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/frame_gate.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "protocol/can/manifest.hpp"

namespace pitwall::safety {
namespace {

namespace av21 = can::av21;
using world::Mode;

// The smallest step of a field: what rounding alone may add to a slew.
constexpr double kSteerStep_deg = 0.5, kBrakeStep_kpa = 1.0, kThrottleStep_percent = 0.01;
constexpr double kCtStateLast = 12.0, kCtStateDefault = 255.0;
constexpr double kControlledShutdown = 11.0, kEmergencyShutdown = 12.0;
constexpr double kTractionSwitchLast = 4.0;  // the most aggressive of the database's 0..4

struct GatedMessage {
  std::uint32_t id;
  bool actuator;  // passes while armed only
};
// The whitelist, the gate's own.
constexpr std::array<GatedMessage, kGatedMessages> kGated{
    {{av21::BrakePressureCmd::kId, true},
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

static_assert(std::ranges::all_of(kRows,
                                  [](const can::MessageRow& row) {
                                    return row.direction == can::Direction::kToCar &&
                                           row.period == milliseconds(10) &&
                                           (!row.has_counter || row.counter_bits == 8);
                                  }),
              "every gated message is ours, has the period behind kMaxPerWindow, counts in a byte");

// The first byte, which is no counter, where the message has none.
std::uint8_t counter_of(const can::MessageRow& row, const can::Frame& frame) {
  std::uint64_t raw{};
  std::memcpy(&raw, frame.data.data(), sizeof raw);  // Intel order, as the host
  return static_cast<std::uint8_t>(raw >> row.counter_start);
}

struct Slew {
  double per_s, step;
};
double grown(const Ceiling& ceiling, double per_s, Instant now) {
  return ceiling.value + per_s * (now - ceiling.at).seconds();
}
bool too_fast(const Ceiling& ceiling, double value, const Slew& slew, Instant now) {
  return value > grown(ceiling, slew.per_s, now) + slew.step;
}
void lower(Ceiling& ceiling, double value, const Slew& slew, Instant now) {
  ceiling = {std::min(value, grown(ceiling, slew.per_s, now)), now};
}

// The judges below decode the frame: decode() refuses every length but the database's.
struct Bench {
  const GateParams& params;
  const GateContext& context;
  GateState& state;

  // The line is held, gently; an emergency is another matter.
  bool is_gentle() const {
    return context.mode == Mode::kControlledStop || context.mode == Mode::kCoast;
  }
  bool stands() const { return context.mode == Mode::kStandby || context.mode == Mode::kHalted; }
};

// A pressure that was higher already may come down.
Verdict brake_by_mode(const Bench& b, double kpa) {
  const double last_kpa = b.state.memory.last_brake_kpa;
  const double grip_kpa = stop_brake_limit_kpa(b.params, b.context.speed_mps);
  if (b.is_gentle() && kpa > grip_kpa && kpa >= last_kpa) return Verdict::kOutOfRange;
  if (b.stands() && kpa < b.params.hold_least_kpa && kpa < last_kpa) return Verdict::kBrakeReleased;
  return Verdict::kPass;
}

Verdict judge_brake(Bench& b, const can::Frame& frame) {
  av21::BrakePressureCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double kpa = m.brake_pressure_cmd;
  if (kpa > b.params.brake_max_kpa) return Verdict::kOutOfRange;
  const Verdict by_mode = brake_by_mode(b, kpa);
  if (by_mode != Verdict::kPass) return by_mode;
  const Slew rise{b.params.brake_rise_kpa_per_s, kBrakeStep_kpa};
  const Slew fall{b.params.brake_fall_kpa_per_s, kBrakeStep_kpa};
  GateMemory& last = b.state.memory;
  const Instant now = b.context.now;
  if (too_fast(last.brake_kpa, kpa, rise, now) || too_fast(last.brake_negated_kpa, -kpa, fall, now))
    return Verdict::kTooFast;
  lower(last.brake_kpa, kpa, rise, now);
  lower(last.brake_negated_kpa, -kpa, fall, now);
  last.last_brake_kpa = kpa;
  return Verdict::kPass;
}

Verdict throttle_by_mode(const Bench& b, double percent) {
  const Mode mode = b.context.mode;
  if (mode == Mode::kDriving || percent == 0.0) return Verdict::kPass;
  if (mode != Mode::kControlledStop && mode != Mode::kEmergencyStop)
    return Verdict::kThrottleForbidden;
  return percent <= b.state.memory.last_throttle_percent ? Verdict::kPass : Verdict::kThrottleRises;
}

Verdict judge_throttle(Bench& b, const can::Frame& frame) {
  av21::AcceleratorCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double percent = m.acc_pedal_cmd;
  if (percent < 0.0 || percent > b.params.throttle_max_percent) return Verdict::kOutOfRange;
  const Verdict by_mode = throttle_by_mode(b, percent);
  if (by_mode != Verdict::kPass) return by_mode;
  const Slew rise{b.params.throttle_rise_percent_per_s, kThrottleStep_percent};
  GateMemory& last = b.state.memory;
  if (too_fast(last.throttle_percent, percent, rise, b.context.now)) return Verdict::kTooFast;
  if (percent > b.params.both_throttle_percent && last.last_brake_kpa > b.params.both_brake_kpa)
    return Verdict::kThrottleWithBrake;
  lower(last.throttle_percent, percent, rise, b.context.now);
  last.last_throttle_percent = percent;
  return Verdict::kPass;
}

Verdict judge_steering(Bench& b, const can::Frame& frame) {
  av21::SteeringCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double deg = m.steering_motor_ang_cmd;
  const double share = b.is_gentle() ? b.params.stop_steer_share : 1.0;
  if (std::abs(deg) > share * steer_limit_deg(b.params, b.context.speed_mps))
    return Verdict::kOutOfRange;
  const double per_s =
      b.stands() ? b.params.hold_steer_slew_deg_per_s : b.params.steer_slew_deg_per_s;
  const Slew slew{per_s, kSteerStep_deg};
  GateMemory& last = b.state.memory;
  const Instant now = b.context.now;
  if (too_fast(last.steer_deg, deg, slew, now) || too_fast(last.steer_negated_deg, -deg, slew, now))
    return Verdict::kTooFast;
  lower(last.steer_deg, deg, slew, now);
  lower(last.steer_negated_deg, -deg, slew, now);
  return Verdict::kPass;
}

Verdict judge_gear(Bench& b, const can::Frame& frame) {
  av21::GearShiftCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const double gear = m.desired_gear;
  const bool standing = b.context.speed_mps < b.params.standing_mps;  // unset: false
  if (gear > b.params.gear_max || (gear < 1.0 && !standing)) return Verdict::kOutOfRange;
  GearChange& last = b.state.memory.gear;
  const double step = std::abs(gear - last.gear);  // not a number before the first
  if (step > 1.0) return Verdict::kGearStep;
  if (step > 0.0 && b.context.now - last.at < b.params.shift_least) return Verdict::kGearStep;
  if (gear != last.gear) last = {gear, b.context.now};
  return Verdict::kPass;
}

bool engine_may_stop(const Bench& b, double ct_state) {
  const GateContext& c = b.context;
  if (!c.armed || b.stands() || c.speed_mps <= b.params.standing_mps) return true;  // unset: false
  if (ct_state != kEmergencyShutdown) return false;
  return c.mode == Mode::kEmergencyStop || (c.mode == Mode::kControlledStop && c.engine_off);
}

Verdict judge_report(const Bench& b, const can::Frame& frame) {
  av21::CtReport m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const bool listed =
      (m.ct_state >= 1.0 && m.ct_state <= kCtStateLast) || m.ct_state == kCtStateDefault;
  if (!listed) return Verdict::kOutOfRange;
  const bool shuts_down = m.ct_state == kControlledShutdown || m.ct_state == kEmergencyShutdown;
  return !shuts_down || engine_may_stop(b, m.ct_state) ? Verdict::kPass : Verdict::kEngineOff;
}

Verdict judge_switches(const can::Frame& frame) {
  av21::DashSwitchesCmd m;
  if (!av21::decode(frame, m)) return Verdict::kWrongLength;
  const bool listed = m.driver_traction_aim_switch <= kTractionSwitchLast &&
                      m.driver_traction_range_switch <= kTractionSwitchLast;
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
      return judge_report(b, frame);
    case av21::DashSwitchesCmd::kId:
      return judge_switches(frame);
    default:  // acknowledgements, accelerations
      return frame.length == length ? Verdict::kPass : Verdict::kWrongLength;
  }
}

// What an id that is not on the whitelist is: one that others send, or nobody's.
Verdict judge_unlisted(std::uint32_t id) {
  return database_row(id) < av21::kMessages.size() ? Verdict::kWrongDirection : Verdict::kUnknownId;
}

// The ring is as long as the limit: what it is about to forget is the frame that counts.
Instant& oldest(PassWindow& window) { return window.at[window.count % kMaxPerWindow]; }

bool too_often(PassWindow& window, Instant now) {
  return window.count >= kMaxPerWindow && now - oldest(window) < kRateWindow;
}

Verdict judge(Bench& b, const can::Frame& frame) {
  if (frame.extended || frame.remote || frame.fd) return Verdict::kNotClassic;
  const std::size_t i = gated_index(frame.id);
  if (i == kNotFound) return judge_unlisted(frame.id);
  const can::MessageRow& row = kRows[i];
  if (kGated[i].actuator) {
    if (!b.context.armed) return Verdict::kNotArmed;
    const Duration age = b.context.now - b.context.command_at;
    if (age < Duration{} || age > b.params.command_age_max) return Verdict::kStale;
  }
  PassWindow& window = b.state.windows[i];
  if (too_often(window, b.context.now)) return Verdict::kTooOften;
  const std::uint8_t counter = counter_of(row, frame);
  if (row.has_counter && window.count > 0 && b.state.counters[i] == counter)
    return Verdict::kStuckCounter;
  const Verdict value = judge_value(b, frame, row.length);
  if (value != Verdict::kPass) return value;
  oldest(window) = b.context.now;
  ++window.count;
  b.state.counters[i] = counter;
  return Verdict::kPass;
}

// Brakes first, so that where throttle and brake contradict each other the throttle is refused.
std::array<Verdict, kMaxFrames> judge_all(Bench& bench, std::span<const can::Frame> frames) {
  std::array<Verdict, kMaxFrames> verdicts{};
  for (const bool brakes : {true, false})
    for (std::size_t i = 0; i < frames.size(); ++i)
      if ((frames[i].id == av21::BrakePressureCmd::kId) == brakes)
        verdicts[i] = judge(bench, frames[i]);
  return verdicts;
}

}  // namespace

// A sum over the segments, each taken as far as the speed goes. fmin() of a number and none is the
// number: without a speed every segment counts fully.
double steer_limit_deg(const GateParams& params, double speed_mps) {
  const auto& rows = params.steer;
  double limit_deg = rows.front().motor_deg;
  for (std::size_t i = 1; i < kSteerRows; ++i) {
    const SteerRow &below = rows[i - 1], &above = rows[i];
    const double share = (speed_mps - below.speed_mps) / (above.speed_mps - below.speed_mps);
    limit_deg += std::fmax(0.0, std::fmin(1.0, share)) * (above.motor_deg - below.motor_deg);
  }
  return limit_deg;
}

double stop_brake_limit_kpa(const GateParams& params, double speed_mps) {
  const auto& rows = params.stop_brake;
  double limit_kpa = rows.front().kpa;
  for (std::size_t i = 1; i < kStopBrakeRows; ++i) {
    const StopBrakeRow &below = rows[i - 1], &above = rows[i];
    const double share = (speed_mps - below.speed_mps) / (above.speed_mps - below.speed_mps);
    limit_kpa += std::fmin(1.0, std::fmax(0.0, share)) * (above.kpa - below.kpa);
  }
  return limit_kpa;
}

GateOutput gate(const GateParams& params, GateState& state, const GateContext& context,
                std::span<const can::Frame> proposed) {
  GateContext own = context;
  own.armed = context.armed && context.mode != Mode::kDisarmed;
  if (!own.armed) {
    state.memory = {};
    state.memory.throttle_percent = {0.0, context.now};
  }
  Bench bench{params, own, state};
  const std::size_t judged = std::min(proposed.size(), kMaxFrames);
  const auto verdicts = judge_all(bench, proposed.first(judged));

  GateOutput out;
  for (std::size_t i = 0; i < proposed.size(); ++i) {
    const Verdict verdict = i < judged ? verdicts[i] : Verdict::kTooMany;
    ++state.verdicts[static_cast<std::size_t>(verdict)];
    // Both lists have room for as many frames as are judged; beyond that this one is full.
    static_cast<void>(out.verdicts.push({proposed[i].id, verdict}));
    if (verdict == Verdict::kPass) {
      static_cast<void>(out.frames.push(proposed[i]));
      continue;
    }
    if (!out.refused_now) out.first_refusal = verdict;
    out.refused_now = true;
  }
  for (std::size_t v = 1; v < kVerdicts; ++v) out.refused_total += state.verdicts[v];
  return out;
}

}  // namespace pitwall::safety
