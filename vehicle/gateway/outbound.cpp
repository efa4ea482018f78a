// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/outbound.hpp"

#include "protocol/can/av21.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::gateway {
namespace {

namespace av21 = can::av21;

constexpr double kPercentPerFraction = 100.0;

// In the order of sending: the brake first.
enum Slot : std::size_t { kBrake, kThrottle, kSteering, kGear, kReport, kReport2, kDash, kAccel };

consteval Duration period_of(std::uint32_t id) {
  for (const can::MessageRow& row : av21::kMessages)
    if (row.id == id) return row.period;
  return {};
}

// Sends at the period rounded to ticks; after a pause the schedule starts anew instead of catching
// up with a burst.
bool due(OutboundState& state, const OutboundParams& params, Slot slot, Duration period,
         Instant now) {
  Instant& next = state.due[slot];
  if (now + params.tick / 2 < next) return false;
  const bool paused = now - next > period;
  next = (paused ? now : next) + period;
  return true;
}

struct Writer {
  const OutboundParams& params;
  OutboundState& state;
  Instant now;
  FixedVector<can::Frame, kOutboundFrames> frames;

  // True if the frame is on its way.
  template <class M>
  bool write(Slot slot, const M& message) {
    constexpr Duration kPeriod = period_of(M::kId);
    static_assert(kPeriod > Duration{});
    if (!due(state, params, slot, kPeriod, now)) return false;
    can::Frame frame;
    if (!av21::encode(message, frame, state.refused)) return false;
    const bool room = frames.push(frame);
    CHECK(room);  // one slot per message
    return true;
  }
};

void actuators(Writer& w, const world::ActuatorCommand& command) {
  OutboundState& s = w.state;
  av21::BrakePressureCmd brake;
  brake.brake_pressure_cmd = command.brake_kpa;
  brake.brk_pressure_cmd_counter = s.brake_counter;
  if (w.write(kBrake, brake)) ++s.brake_counter;

  av21::AcceleratorCmd throttle;
  throttle.acc_pedal_cmd = command.throttle_fraction * kPercentPerFraction;
  throttle.acc_pedal_cmd_counter = s.throttle_counter;
  if (w.write(kThrottle, throttle)) ++s.throttle_counter;

  av21::SteeringCmd steering;
  steering.steering_motor_ang_cmd = to_deg(command.road_wheel_rad) * w.params.steering_ratio;
  steering.steering_motor_cmd_counter = s.steering_counter;
  if (w.write(kSteering, steering)) ++s.steering_counter;

  av21::GearShiftCmd gear;
  gear.desired_gear = command.gear;
  w.write(kGear, gear);
}

// The raw flags by encoding, whichever of them has the say.
struct Acknowledged {
  std::uint8_t track, vehicle, sector;
};
Acknowledged acknowledged(const world::RaceControl& rc, world::FlagEncoding encoding) {
  if (rc.encoding == encoding) return {rc.raw_track, rc.raw_vehicle, rc.raw_sector};
  return {rc.other_raw_track, rc.other_raw_vehicle, rc.other_raw_sector};
}

void reports(Writer& w, const OutboundInputs& in) {
  OutboundState& s = w.state;
  const Acknowledged mylaps = acknowledged(in.acted_on, world::FlagEncoding::kMyLaps);
  av21::CtReport report;
  report.veh_sig_ack = mylaps.vehicle;
  report.track_cond_ack = mylaps.track;
  report.ct_state = static_cast<double>(in.ct_state);
  report.ct_state_rolling_counter = s.report_counter;
  report.veh_num = w.params.vehicle_number;
  if (w.write(kReport, report))
    s.report_counter = static_cast<std::uint8_t>((s.report_counter + 1) % kReportCounterEnd);

  const Acknowledged marelli = acknowledged(in.acted_on, world::FlagEncoding::kMarelli);
  av21::CtReport2 report_2;
  report_2.marelli_track_flag_ack = marelli.track;
  report_2.marelli_vehicle_flag_ack = marelli.vehicle;
  report_2.marelli_sector_flag_ack = marelli.sector;
  w.write(kReport2, report_2);

  av21::DashSwitchesCmd dash;
  dash.driver_traction_aim_switch = w.params.traction_aim;
  dash.driver_traction_range_switch = w.params.traction_range;
  w.write(kDash, dash);

  av21::CtVehicleAccFeedback accelerations;
  accelerations.long_ct_vehicle_acc_fbk = in.ego.ax_mps2 / kGravity_mps2;
  accelerations.lat_ct_vehicle_acc_fbk = in.ego.ay_mps2 / kGravity_mps2;
  accelerations.vertical_ct_vehicle_acc_fbk = 1.0;
  w.write(kAccel, accelerations);
}

}  // namespace

OutboundOutput encode(const OutboundParams& params, OutboundState& state,
                      const OutboundInputs& inputs, Instant now) {
  Writer writer{params, state, now, {}};
  if (inputs.actuate) actuators(writer, inputs.command);
  reports(writer, inputs);
  return {.frames = writer.frames, .counters = state.refused};
}

}  // namespace pitwall::gateway
