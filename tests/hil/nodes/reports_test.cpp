// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/reports.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "protocol/can/av21.hpp"

namespace pitwall::drive_by_wire {
namespace {

namespace av21 = can::av21;

ReportInputs moving_car() {
  ReportInputs in;
  in.feedback.wheel_speed_mps = {50.0, 51.0, 52.0, 53.0};
  in.feedback.vehicle_speed_mps = 51.5;
  in.feedback.brake_front_kpa = 1234.0;
  in.feedback.brake_rear_kpa = 987.0;
  in.feedback.throttle_fraction = 0.42;
  in.feedback.steering_motor_rad = from_deg(-37.5);
  in.feedback.engine_speed_rpm = 5120.0;
  in.feedback.engine_running = true;
  in.feedback.gear = 5;
  in.feedback.tyre_temperature_c = {70.0, 75.0, 80.0, 85.0};
  in.feedback.tyre_pressure_kpa = {140.0, 145.0, 150.0, 155.0};
  in.system = world::SysState::kDriving;
  in.engine_switch = true;
  return in;
}

std::map<std::uint32_t, std::vector<Instant>> send_times(Duration step, Duration time,
                                                         ReportState& state) {
  std::map<std::uint32_t, std::vector<Instant>> sent;
  for (Instant now{}; now - Instant{} < time; now += step)
    for (const can::Frame& f : due_reports(state, moving_car(), now)) sent[f.id].push_back(now);
  return sent;
}

// The cycle times of the public bridge, written down a second time.
Duration period_of(std::uint32_t id) {
  if (id == 1300) return milliseconds(5);
  if (id == 1304) return milliseconds(500);
  if (id >= 1324 && id <= 1339) return milliseconds(1000);
  const std::set<std::uint32_t> fast{1301, 1302, 1303, 1340, 1341, 1343};
  return milliseconds(fast.count(id) != 0 ? 10 : 100);
}

TEST(Reports, EveryPeriodIsExact) {
  for (const Duration step : {microseconds(500), milliseconds(1), milliseconds(5)}) {
    ReportState state;
    const auto sent = send_times(step, seconds(5), state);
    EXPECT_EQ(sent.size(), kReports.size());
    for (const auto& [id, times] : sent) {
      // A phase that is no multiple of the step costs the last report of the run, never more.
      const auto full = static_cast<std::size_t>(seconds(5) / period_of(id));
      ASSERT_GE(times.size() + (step == milliseconds(5) ? 1U : 0U), full) << id;
      ASSERT_LE(times.size(), full) << id;
      for (std::size_t i = 1; i < times.size(); ++i)
        ASSERT_EQ(times[i] - times[i - 1], period_of(id)) << id;
    }
    EXPECT_EQ(state.skipped, 0U);
  }
}

TEST(Reports, TooFewCallsAreCountedAndTheGridStays) {
  ReportState state;
  const auto sent = send_times(milliseconds(10), seconds(1), state);
  EXPECT_EQ(sent.at(1300).size(), 100U);
  EXPECT_EQ(state.skipped, 99U);  // 1300 once in each call but the first
}

TEST(Reports, NoTwoReportsOfOnePeriodShareAMillisecond) {
  for (std::size_t a = 0; a < kReports.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const bool alike = kReports[a].period == kReports[b].period;
      EXPECT_TRUE(!alike || kReports[a].phase.ns % kReports[a].period.ns !=
                                kReports[b].phase.ns % kReports[b].period.ns);
    }
}

TEST(Reports, CoverEveryMessageOfTheDriveByWire) {
  std::set<std::uint32_t> here, database;
  for (const ReportRow& row : kReports) here.insert(row.id);
  for (const can::MessageRow& row : av21::kMessages)
    if (row.direction == can::Direction::kFromCar && row.id >= 1300) database.insert(row.id);
  EXPECT_EQ(here, database);
}

TEST(Reports, CountersChangeOnEveryFrameAndWrapAtAByte) {
  ReportState state;
  std::map<std::uint32_t, std::vector<double>> counters;
  for (Instant now{}; now - Instant{} < seconds(6); now += milliseconds(1))
    for (const can::Frame& f : due_reports(state, moving_car(), now)) {
      av21::BrakePressureReport brake;
      av21::AcceleratorReport pedal;
      av21::SteeringReport steering;
      av21::MiscReport misc;
      if (av21::decode(f, brake)) counters[f.id].push_back(brake.brk_pressure_fdbk_counter);
      if (av21::decode(f, pedal)) counters[f.id].push_back(pedal.acc_pedal_fdbk_counter);
      if (av21::decode(f, steering)) counters[f.id].push_back(steering.steering_motor_fdbk_counter);
      if (av21::decode(f, misc)) counters[f.id].push_back(misc.raptor_rolling_counter);
    }
  ASSERT_EQ(counters.size(), 4U);
  for (const auto& [id, values] : counters)
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_EQ(values[i], static_cast<double>(i % 256)) << id;
}

template <class Message>
Message report(const ReportInputs& in) {
  ReportState state;
  can::Frame frame;
  EXPECT_TRUE(encode_report(Message::kId, state, in, frame));
  Message out;
  EXPECT_TRUE(av21::decode(frame, out));
  EXPECT_EQ(state.saturated, 0U);
  return out;
}

TEST(Reports, CarryTheFeedbackWithinTheirResolution) {
  const ReportInputs in = moving_car();
  const auto wheels = report<av21::WheelSpeedReport>(in);
  EXPECT_NEAR(from_kmh(wheels.wheel_speed_FL), 50.0, 0.014);
  EXPECT_NEAR(from_kmh(wheels.wheel_speed_FR), 51.0, 0.014);
  EXPECT_NEAR(from_kmh(wheels.wheel_speed_RL), 52.0, 0.014);
  EXPECT_NEAR(from_kmh(wheels.wheel_speed_RR), 53.0, 0.014);
  const auto brake = report<av21::BrakePressureReport>(in);
  EXPECT_EQ(brake.brake_pressure_fdbk_front, 1234.0);
  EXPECT_EQ(brake.brake_pressure_fdbk_rear, 987.0);
  EXPECT_NEAR(report<av21::AcceleratorReport>(in).acc_pedal_fdbk, 42.0, 0.051);
  EXPECT_EQ(report<av21::SteeringReport>(in).steering_motor_ang_avg_fdbk, -37.5);
  EXPECT_EQ(report<av21::SteeringReportExtd>(in).steering_motor_ang_3_fdbk, -37.5);
  const auto power = report<av21::PtReport1>(in);
  EXPECT_EQ(power.engine_speed_rpm, 5120.0);
  EXPECT_EQ(power.current_gear, 5.0);
  EXPECT_EQ(power.engine_state, 1.0);
  EXPECT_NEAR(power.throttle_position, 42.0, 0.051);
  EXPECT_NEAR(from_kmh(power.vehicle_speed_kmph), 51.5, 0.014);
  EXPECT_EQ(report<av21::MiscReport>(in).sys_state, 9.0);
  EXPECT_NEAR(report<av21::TirePressureFr>(in).FR_Tire_Pressure_Gauge, 1450.0, 0.5);
  EXPECT_NEAR(report<av21::TirePressureRr>(in).RR_Tire_Pressure, 1550.0 + 1013.0, 0.5);
}

TEST(Reports, SixteenTyreSensorsHaveTheMeanOfTheTyre) {
  ReportState state;
  const ReportInputs in = moving_car();
  for (std::uint32_t wheel = 0; wheel < 4; ++wheel) {
    double sum_c = 0.0;
    for (std::uint32_t part = 0; part < 4; ++part) {
      can::Frame f;
      ASSERT_TRUE(encode_report(1324 + 4 * wheel + part, state, in, f));
      EXPECT_EQ(f.id, 1324 + 4 * wheel + part);
      for (std::size_t i = 0; i < 8; i += 2)  // Motorola, 0.1 C, offset -100 C
        sum_c += 0.1 * (256.0 * f.data[i] + f.data[i + 1]) - 100.0;
    }
    EXPECT_NEAR(sum_c / 16.0, in.feedback.tyre_temperature_c[wheel], 0.051) << wheel;
  }
}

TEST(Reports, ANumberThatNobodyGaveIsNotSentAndCounted) {
  ReportInputs in = moving_car();
  in.feedback.brake_rear_kpa = kUnset;
  ReportState state;
  std::set<std::uint32_t> sent;
  for (Instant now{}; now - Instant{} < seconds(1); now += milliseconds(1))
    for (const can::Frame& f : due_reports(state, in, now)) sent.insert(f.id);
  EXPECT_EQ(sent.size(), kReports.size() - 1);
  EXPECT_EQ(sent.count(1301), 0U);
  EXPECT_EQ(state.unsent, 100U);
}

TEST(Reports, EveryDiagnosticHasItsOwnBit) {
  const auto bits_of = [](const Diagnostics& d) {
    ReportInputs in = moving_car();
    in.diagnostics = d;
    const auto m = report<av21::DiagnosticReport>(in);
    return std::vector{m.est1_oos_front_brk,
                       m.est2_oos_rear_brk,
                       m.est3_low_eng_speed,
                       m.sd_steer_warning1,
                       m.est6_sd_ebrake,
                       m.adlink_hb_lost,
                       m.rc_lost};
  };
  using Field = bool Diagnostics::*;
  const std::vector<Field> fields{
      &Diagnostics::front_brake_out_of_spec, &Diagnostics::rear_brake_out_of_spec,
      &Diagnostics::low_engine_speed,        &Diagnostics::steer_warning,
      &Diagnostics::emergency_brake,         &Diagnostics::computer_heartbeat_lost,
      &Diagnostics::race_control_lost};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    Diagnostics d;
    d.*fields[i] = true;
    std::vector<double> expected(fields.size(), 0.0);
    expected[i] = 1.0;
    EXPECT_EQ(bits_of(d), expected);
  }
}

}  // namespace
}  // namespace pitwall::drive_by_wire
