// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/command_frames.hpp"

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/mode.hpp"

namespace pitwall::guardian {
namespace {

namespace av21 = can::av21;

constexpr double kPercentPerFraction = 100.0;
constexpr std::uint8_t kReportCounterEnd = 10;  // ct_state_rolling_counter runs 0..9

template <class M>
bool take(const can::Frame& frame, std::optional<M>& last) {
  M message;
  if (!av21::decode(frame, message)) return false;
  last = message;
  return true;
}

bool take_any(ReceivedCommands& car, const can::Frame& frame) {
  switch (frame.id) {
    case av21::BrakePressureCmd::kId:
      return take(frame, car.brake);
    case av21::AcceleratorCmd::kId:
      return take(frame, car.throttle);
    case av21::SteeringCmd::kId:
      return take(frame, car.steering);
    case av21::GearShiftCmd::kId:
      return take(frame, car.gear);
    case av21::CtReport::kId:
      return take(frame, car.report);
    case av21::CtReport2::kId:
      return take(frame, car.report_2);
    case av21::DashSwitchesCmd::kId:
      return take(frame, car.dash);
    default:
      return false;
  }
}

template <class M>
void add(CommandFrames& frames, const M& message) {
  can::Frame frame;
  can::EncodeCounters refused;
  if (av21::encode(message, frame, refused)) CHECK(frames.push(frame));  // one slot per message
}

template <class M>
void add(CommandFrames& frames, const std::optional<M>& message) {
  if (message) add(frames, *message);
}

template <class M>
std::uint8_t counter(const std::optional<M>& message, double M::*field) {
  return message ? static_cast<std::uint8_t>((*message).*field) : std::uint8_t{0};
}

}  // namespace

bool receive(ReceivedCommands& car, const can::ReceivedFrame& received) {
  const can::Frame& frame = received.frame;
  if (frame.extended || frame.remote || frame.fd || !take_any(car, frame)) return false;
  const bool command = frame.id == av21::BrakePressureCmd::kId ||
                       frame.id == av21::AcceleratorCmd::kId || frame.id == av21::SteeringCmd::kId;
  if (!command) return false;
  car.commanded = true;
  if (received.at > car.commanded_at) car.commanded_at = received.at;
  return true;
}

CommandCounters counters_of(const ReceivedCommands& car) {
  return {.brake = counter(car.brake, &av21::BrakePressureCmd::brk_pressure_cmd_counter),
          .throttle = counter(car.throttle, &av21::AcceleratorCmd::acc_pedal_cmd_counter),
          .steering = counter(car.steering, &av21::SteeringCmd::steering_motor_cmd_counter),
          .report = counter(car.report, &av21::CtReport::ct_state_rolling_counter)};
}

world::ActuatorCommand command_of(const ReceivedCommands& car, double steering_ratio) {
  world::ActuatorCommand command{.at = car.commanded_at};
  if (car.steering)
    command.road_wheel_rad = from_deg(car.steering->steering_motor_ang_cmd) / steering_ratio;
  if (car.throttle) command.throttle_fraction = car.throttle->acc_pedal_cmd / kPercentPerFraction;
  if (car.brake) command.brake_kpa = car.brake->brake_pressure_cmd;
  if (car.gear) command.gear = static_cast<std::uint8_t>(car.gear->desired_gear);
  return command;
}

CommandFrames repeat(const ReceivedCommands& car) {
  CommandFrames frames;
  add(frames, car.brake);
  add(frames, car.throttle);
  add(frames, car.steering);
  add(frames, car.gear);
  add(frames, car.report);
  return frames;
}

CommandFrames encode_frames(const ReceivedCommands& car, CommandCounters& counters,
                            const CommandValues& values) {
  CommandFrames frames;
  av21::BrakePressureCmd brake;
  brake.brake_pressure_cmd = values.command.brake_kpa;
  brake.brk_pressure_cmd_counter = ++counters.brake;
  add(frames, brake);

  av21::AcceleratorCmd throttle;
  throttle.acc_pedal_cmd = values.command.throttle_fraction * kPercentPerFraction;
  throttle.acc_pedal_cmd_counter = ++counters.throttle;
  add(frames, throttle);

  av21::SteeringCmd steering;
  steering.steering_motor_ang_cmd = to_deg(values.command.road_wheel_rad) * values.steering_ratio;
  steering.steering_motor_cmd_counter = ++counters.steering;
  add(frames, steering);

  av21::GearShiftCmd gear;
  gear.desired_gear = values.command.gear;
  add(frames, gear);

  av21::CtReport report = car.report.value_or(av21::CtReport{});
  counters.report = static_cast<std::uint8_t>((counters.report + 1) % kReportCounterEnd);
  report.ct_state = static_cast<double>(world::CtState::kCoordinatedStop);
  report.ct_state_rolling_counter = counters.report;
  add(frames, report);
  add(frames, car.report_2);
  add(frames, car.dash);

  av21::CtVehicleAccFeedback accelerations;
  accelerations.long_ct_vehicle_acc_fbk = values.ax_mps2 / kGravity_mps2;
  accelerations.lat_ct_vehicle_acc_fbk = values.ay_mps2 / kGravity_mps2;
  accelerations.vertical_ct_vehicle_acc_fbk = 1.0;
  add(frames, accelerations);
  return frames;
}

}  // namespace pitwall::guardian
