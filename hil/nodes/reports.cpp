// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/reports.hpp"

#include <algorithm>

#include "protocol/can/av21.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::drive_by_wire {
namespace {

namespace av21 = can::av21;

constexpr double kAtmosphere_kpa = 101.3;
constexpr std::size_t kTyreSensors = 16;
constexpr std::size_t kSensorsPerMessage = 4;
constexpr std::uint32_t kFirstTyreTemperature = 1324, kMessagesPerTyre = 4;
// Across the tread the shoulders run cooler than the middle; the profile's mean is zero.
constexpr double kShoulderCooling_c = 0.2;

double bit(bool b) { return b ? 1.0 : 0.0; }

template <class Message>
bool encoded(const Message& message, ReportState& state, can::Frame& out) {
  can::EncodeCounters counters;
  const bool sendable = av21::encode(message, out, counters);
  state.saturated += counters.saturated;
  state.unsent += sendable ? 0U : 1U;
  return sendable;
}

double sensor_c(double mean_c, std::size_t sensor) {
  const double from_middle = std::abs(static_cast<double>(sensor) - 7.5);  // 0.5 .. 7.5, mean 4
  return mean_c + kShoulderCooling_c * (4.0 - from_middle);
}

template <class Message>
Message filled(const double (&v)[kSensorsPerMessage], double Message::*a, double Message::*b,
               double Message::*c, double Message::*d) {
  Message m;
  m.*a = v[0];
  m.*b = v[1];
  m.*c = v[2];
  m.*d = v[3];
  return m;
}

bool encode_tyre_temperature(std::uint32_t id, ReportState& state, const Feedback& f,
                             can::Frame& out) {
  const std::uint32_t index = id - kFirstTyreTemperature;
  const std::size_t wheel = index / kMessagesPerTyre;
  const std::size_t first = (index % kMessagesPerTyre) * kSensorsPerMessage;
  static_assert(kTyreSensors == kMessagesPerTyre * kSensorsPerMessage);
  double v[kSensorsPerMessage] = {};
  for (std::size_t i = 0; i < kSensorsPerMessage; ++i)
    v[i] = sensor_c(f.tyre_temperature_c[wheel], first + i);
  switch (id) {
#define PITWALL_TYRE(ID, TYPE, CORNER, A, B, C, D)                            \
  case ID:                                                                    \
    return encoded(filled<av21::TYPE>(v, &av21::TYPE::CORNER##_Tire_Temp_##A, \
                                      &av21::TYPE::CORNER##_Tire_Temp_##B,    \
                                      &av21::TYPE::CORNER##_Tire_Temp_##C,    \
                                      &av21::TYPE::CORNER##_Tire_Temp_##D),   \
                   state, out)
    PITWALL_TYRE(1324, TireTempFl1, FL, 01, 02, 03, 04);
    PITWALL_TYRE(1325, TireTempFl2, FL, 05, 06, 07, 08);
    PITWALL_TYRE(1326, TireTempFl3, FL, 09, 10, 11, 12);
    PITWALL_TYRE(1327, TireTempFl4, FL, 13, 14, 15, 16);
    PITWALL_TYRE(1328, TireTempFr1, FR, 01, 02, 03, 04);
    PITWALL_TYRE(1329, TireTempFr2, FR, 05, 06, 07, 08);
    PITWALL_TYRE(1330, TireTempFr3, FR, 09, 10, 11, 12);
    PITWALL_TYRE(1331, TireTempFr4, FR, 13, 14, 15, 16);
    PITWALL_TYRE(1332, TireTempRl1, RL, 01, 02, 03, 04);
    PITWALL_TYRE(1333, TireTempRl2, RL, 05, 06, 07, 08);
    PITWALL_TYRE(1334, TireTempRl3, RL, 09, 10, 11, 12);
    PITWALL_TYRE(1335, TireTempRl4, RL, 13, 14, 15, 16);
    PITWALL_TYRE(1336, TireTempRr1, RR, 01, 02, 03, 04);
    PITWALL_TYRE(1337, TireTempRr2, RR, 05, 06, 07, 08);
    PITWALL_TYRE(1338, TireTempRr3, RR, 09, 10, 11, 12);
    PITWALL_TYRE(1339, TireTempRr4, RR, 13, 14, 15, 16);
#undef PITWALL_TYRE
    default:
      CHECK(false);
  }
  return false;
}

bool encode_tyre_pressure(std::uint32_t id, ReportState& state, const Feedback& f,
                          can::Frame& out) {
  const auto mbar = [](double kpa) { return kpa * 10.0; };
  const double gauge_kpa = f.tyre_pressure_kpa[id - 1320];
  const double gauge = mbar(gauge_kpa), absolute = mbar(gauge_kpa + kAtmosphere_kpa);
  switch (id) {
    case 1320:
      return encoded(av21::TirePressureFl{absolute, gauge}, state, out);
    case 1321:
      return encoded(av21::TirePressureFr{absolute, gauge}, state, out);
    case 1322:
      return encoded(av21::TirePressureRl{absolute, gauge}, state, out);
    default:
      return encoded(av21::TirePressureRr{absolute, gauge}, state, out);
  }
}

bool encode_wheels(std::uint32_t id, ReportState& state, const Feedback& f, can::Frame& out) {
  if (id == 1300) {
    av21::WheelSpeedReport m;  // the field has no sign: a wheel that turns back reads zero
    const auto kmh = [](double v_mps) { return v_mps < 0.0 ? 0.0 : to_kmh(v_mps); };
    m.wheel_speed_FL = kmh(f.wheel_speed_mps[0]);
    m.wheel_speed_FR = kmh(f.wheel_speed_mps[1]);
    m.wheel_speed_RL = kmh(f.wheel_speed_mps[2]);
    m.wheel_speed_RR = kmh(f.wheel_speed_mps[3]);
    return encoded(m, state, out);
  }
  if (id == 1310) {
    av21::WheelStrainGauge m;
    m.wheel_strain_gauge_FL = f.wheel_load_n[0];
    m.wheel_strain_gauge_FR = f.wheel_load_n[1];
    m.wheel_strain_gauge_RL = f.wheel_load_n[2];
    m.wheel_strain_gauge_RR = f.wheel_load_n[3];
    return encoded(m, state, out);
  }
  av21::WheelPotentiometerData m;
  m.wheel_potentiometer_FL = f.damper_mm[0];
  m.wheel_potentiometer_FR = f.damper_mm[1];
  m.wheel_potentiometer_RL = f.damper_mm[2];
  m.wheel_potentiometer_RR = f.damper_mm[3];
  return encoded(m, state, out);
}

bool encode_actuators(std::uint32_t id, ReportState& state, const Feedback& f, can::Frame& out) {
  const double steering_deg = to_deg(f.steering_motor_rad);
  if (id == 1301) {
    av21::BrakePressureReport m;
    m.brake_pressure_fdbk_front = f.brake_front_kpa;
    m.brake_pressure_fdbk_rear = f.brake_rear_kpa;
    m.brk_pressure_fdbk_counter = state.brake_counter++;
    return encoded(m, state, out);
  }
  if (id == 1302) {
    av21::AcceleratorReport m;
    m.acc_pedal_fdbk = 100.0 * f.throttle_fraction;
    m.acc_pedal_fdbk_counter = state.throttle_counter++;
    return encoded(m, state, out);
  }
  if (id == 1303) {
    av21::SteeringReport m;
    m.steering_motor_ang_avg_fdbk = steering_deg;
    m.steering_motor_fdbk_counter = state.steering_counter++;
    return encoded(m, state, out);
  }
  av21::SteeringReportExtd m;
  m.steering_motor_ang_1_fdbk = steering_deg;
  m.steering_motor_ang_2_fdbk = steering_deg;
  m.steering_motor_ang_3_fdbk = steering_deg;
  return encoded(m, state, out);
}

bool encode_powertrain(std::uint32_t id, ReportState& state, const ReportInputs& in,
                       can::Frame& out) {
  const Feedback& f = in.feedback;
  if (id == 1340) {
    av21::PtReport1 m;
    m.throttle_position = 100.0 * f.throttle_fraction;
    m.engine_state = bit(f.engine_running);
    m.engine_run_switch = bit(in.engine_switch);
    m.current_gear = f.gear;
    m.engine_speed_rpm = f.engine_speed_rpm;
    m.vehicle_speed_kmph = f.vehicle_speed_mps < 0.0 ? 0.0 : to_kmh(f.vehicle_speed_mps);
    m.gear_shift_status = f.gear_shift_status;
    return encoded(m, state, out);
  }
  if (id == 1341) {
    av21::PtReport2 m;
    m.fuel_pressure_kPa = f.fuel_pressure_kpa;
    m.engine_oil_pressure_kPa = f.oil_pressure_kpa;
    m.coolant_temperature = f.coolant_c;
    m.transmission_temperature = f.transmission_c;
    m.transmission_pressure_kPa = f.transmission_pressure_kpa;
    return encoded(m, state, out);
  }
  av21::PtReport3 m;
  m.engine_oil_temperature = f.oil_temperature_c;
  m.torque_wheels = f.wheel_torque_nm;
  m.driver_traction_aim_swicth_fbk = 0.0;
  m.driver_traction_range_switch_fbk = 0.0;
  return encoded(m, state, out);
}

bool encode_misc(ReportState& state, const ReportInputs& in, can::Frame& out) {
  av21::MiscReport m;
  m.battery_voltage = in.feedback.battery_v;
  m.sys_state = static_cast<double>(in.system);
  m.mode_switch_state = 1.0;
  m.raptor_rolling_counter = state.misc_counter++;
  m.safety_switch_state = 0.0;
  return encoded(m, state, out);
}

bool encode_diagnostics(ReportState& state, const Diagnostics& d, can::Frame& out) {
  av21::DiagnosticReport m{};
  m.sd_system_warning = bit(d.steer_warning);
  m.sd_system_failure = 0.0;
  m.sd_brake_warning1 = bit(d.front_brake_out_of_spec || d.rear_brake_out_of_spec);
  m.sd_brake_warning2 = m.sd_brake_warning3 = 0.0;
  m.sd_steer_warning1 = bit(d.steer_warning);
  m.sd_steer_warning2 = m.sd_steer_warning3 = 0.0;
  m.motec_warning = 0.0;
  m.est1_oos_front_brk = bit(d.front_brake_out_of_spec);
  m.est2_oos_rear_brk = bit(d.rear_brake_out_of_spec);
  m.est3_low_eng_speed = bit(d.low_engine_speed);
  m.est4_sd_comms_loss = m.est5_motec_comms_loss = 0.0;
  m.est6_sd_ebrake = bit(d.emergency_brake);
  m.adlink_hb_lost = bit(d.computer_heartbeat_lost);
  m.rc_lost = bit(d.race_control_lost);
  return encoded(m, state, out);
}

Duration period_of(const ReportRow& row, const ReportInputs& in) {
  return row.id == av21::MiscReport::kId ? in.misc_period : row.period;
}

// The first instant of the grid phase + i * period that is not before `now`.
Instant first_due(Duration phase, Duration period, Instant now) {
  const std::int64_t steps = (now.ns - phase.ns + period.ns - 1) / period.ns;
  return Instant{} + phase + period * std::max<std::int64_t>(steps, 0);
}

}  // namespace

bool encode_report(std::uint32_t id, ReportState& state, const ReportInputs& in, can::Frame& out) {
  if (id >= kFirstTyreTemperature && id < kFirstTyreTemperature + 4 * kMessagesPerTyre)
    return encode_tyre_temperature(id, state, in.feedback, out);
  switch (id) {
    case 1300:
    case 1310:
    case 1311:
      return encode_wheels(id, state, in.feedback, out);
    case 1301:
    case 1302:
    case 1303:
    case 1312:
      return encode_actuators(id, state, in.feedback, out);
    case 1304:
      return encode_misc(state, in, out);
    case 1320:
    case 1321:
    case 1322:
    case 1323:
      return encode_tyre_pressure(id, state, in.feedback, out);
    case 1340:
    case 1341:
    case 1343:
      return encode_powertrain(id, state, in, out);
    case 1342:
      return encode_diagnostics(state, in.diagnostics, out);
    default:
      CHECK(false);
  }
  return false;
}

ReportFrames due_reports(ReportState& state, const ReportInputs& in, Instant now) {
  CHECK(in.misc_period.ns > 0);
  if (!state.begun)
    for (std::size_t i = 0; i < kReports.size(); ++i)
      state.due[i] = first_due(kReports[i].phase, period_of(kReports[i], in), now);
  state.begun = true;

  ReportFrames frames;
  for (std::size_t i = 0; i < kReports.size(); ++i) {
    if (state.due[i] > now) continue;
    const Duration period = period_of(kReports[i], in);
    const std::int64_t passed = (now - state.due[i]) / period;
    state.skipped += static_cast<std::uint64_t>(passed);
    state.due[i] += period * (passed + 1);
    can::Frame frame;
    if (encode_report(kReports[i].id, state, in, frame)) CHECK(frames.push(frame));
  }
  return frames;
}

}  // namespace pitwall::drive_by_wire
