// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/readings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/gateway/traffic.hpp"

namespace pitwall::gateway {
namespace {

using namespace testing;
using world::Corner;

struct Reader {
  InboundParams params;
  InboundState state;
  Reading operator()(const can::Frame& frame, Instant at = {}) {
    return apply(params, state, {frame, at});
  }
};

// One quarter of a tyre: four sensors, Motorola, 0.1 degrees, offset -100.
can::Frame quarter(std::size_t tyre, std::size_t part, std::array<double, 4> sensor_c) {
  can::Frame frame;
  frame.id = static_cast<std::uint32_t>(av21::TireTempFl1::kId + 4 * tyre + part);
  frame.length = 8;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto raw = static_cast<unsigned>(std::lround((sensor_c[i] + 100.0) * 10.0));
    frame.data[2 * i] = static_cast<std::uint8_t>(raw >> 8);
    frame.data[2 * i + 1] = static_cast<std::uint8_t>(raw);
  }
  return frame;
}

TEST(Readings, ATyreIsTheMeanOfItsOwnSixteenSensors) {
  Reader read;
  for (std::size_t tyre = 0; tyre < world::kCorners; ++tyre) {
    double sum_c = 0.0;
    for (std::size_t part = 0; part < 4; ++part) {
      EXPECT_TRUE(std::isnan(read.state.signals.tyre_temperature_c.value.at[tyre]));
      std::array<double, 4> sensor_c;
      for (std::size_t i = 0; i < 4; ++i) {
        sensor_c[i] = 20.0 * static_cast<double>(tyre) + 3.0 * static_cast<double>(4 * part + i);
        sum_c += sensor_c[i];
      }
      ASSERT_EQ(read(quarter(tyre, part, sensor_c)), Reading::kApplied);
    }
    EXPECT_NEAR(read.state.signals.tyre_temperature_c.value.at[tyre], sum_c / 16.0, 1e-9) << tyre;
  }
}

TEST(Readings, OneSensorThatLiesLeavesTheTyreAsItWas) {
  Reader read;
  for (std::size_t part = 0; part < 4; ++part)
    ASSERT_EQ(read(quarter(3, part, {50, 50, 50, 50})), Reading::kApplied);
  EXPECT_EQ(read(quarter(3, 2, {50, 50, 900, 50})), Reading::kOutOfRange);
  EXPECT_NEAR(read.state.signals.tyre_temperature_c.value[Corner::kRearRight], 50.0, 1e-9);
}

// Of those that were applied.
TEST(Readings, TheWheelSpeedsOfTheFrameBeforeAreKept) {
  Reader read;
  const auto wheels = [](double kmh) {
    av21::WheelSpeedReport m;
    m.wheel_speed_FL = m.wheel_speed_FR = m.wheel_speed_RL = m.wheel_speed_RR = kmh;
    can::Frame frame;
    can::EncodeCounters counters;
    EXPECT_TRUE(av21::encode(m, frame, counters));
    return frame;
  };
  const auto at = [](int ms) { return Instant{} + milliseconds(ms); };
  ASSERT_EQ(read(wheels(100.0), at(0)), Reading::kApplied);
  EXPECT_FALSE(read.state.signals.wheel_speed_before_mps.received);
  ASSERT_EQ(read(wheels(103.6), at(5)), Reading::kApplied);
  ASSERT_EQ(read(wheels(300.0), at(10)), Reading::kImplausibleSlew);
  const auto& before = read.state.signals.wheel_speed_before_mps;
  EXPECT_TRUE(before.received);
  EXPECT_EQ(before.at, at(0));
  EXPECT_NEAR(before.value[Corner::kRearRight], from_kmh(100.0), 1e-9);
  ASSERT_EQ(read(wheels(104.0), at(15)), Reading::kApplied);
  EXPECT_EQ(before.at, at(5));
  EXPECT_NEAR(before.value[Corner::kFrontLeft], from_kmh(103.6), 1e-9);
}

TEST(Readings, EachTyrePressureIsItsOwnGaugeInKilopascal) {
  Reader read;
  av21::TirePressureFl fl;
  fl.FL_Tire_Pressure = 2513;
  fl.FL_Tire_Pressure_Gauge = 1500;
  av21::TirePressureFr fr;
  fr.FR_Tire_Pressure = 2613;
  fr.FR_Tire_Pressure_Gauge = 1600;
  av21::TirePressureRl rl;
  rl.RL_Tire_Pressure = 2713;
  rl.RL_Tire_Pressure_Gauge = 1700;
  av21::TirePressureRr rr;
  rr.RR_Tire_Pressure = 2813;
  rr.RR_Tire_Pressure_Gauge = 1800;
  for (const can::Frame& frame : {frame_of(fl), frame_of(fr), frame_of(rl), frame_of(rr)})
    ASSERT_EQ(read(frame), Reading::kApplied);
  for (std::size_t tyre = 0; tyre < world::kCorners; ++tyre)
    EXPECT_NEAR(read.state.signals.tyre_pressure_kpa.value.at[tyre],
                150.0 + 10.0 * static_cast<double>(tyre), 1e-9);
}

TEST(Readings, PowertrainInSi) {
  Reader read;
  av21::PtReport1 m;
  m.throttle_position = 42.5;
  m.engine_state = 1;
  m.engine_run_switch = 1;
  m.current_gear = 4;
  m.engine_speed_rpm = 5400;
  m.vehicle_speed_kmph = 180;
  m.gear_shift_status = 3;
  ASSERT_EQ(read(frame_of(m), at_ms(3)), Reading::kApplied);
  const auto& p = read.state.signals.powertrain;
  EXPECT_TRUE(p.received);
  EXPECT_EQ(p.at, at_ms(3));
  EXPECT_NEAR(p.value.throttle_fraction, 0.425, 1e-9);
  EXPECT_NEAR(p.value.vehicle_speed_mps, 50.0, 1e-9);
  EXPECT_NEAR(p.value.engine_speed_rpm, 5400, 1e-9);
  EXPECT_EQ(p.value.gear, 4);
  EXPECT_EQ(p.value.gear_shift_status, 3);
  EXPECT_TRUE(p.value.engine_running);
  EXPECT_TRUE(p.value.engine_switch_on);
  m.current_gear = 7;
  EXPECT_EQ(read(frame_of(m), at_ms(13)), Reading::kOutOfRange);
  EXPECT_EQ(p.value.gear, 4);
}

TEST(Readings, TheCompetitorThatRaceControlNames) {
  Reader read;
  av21::RestOfField m;
  m.comp_veh_num = 17;
  m.comp_veh_flag = 0;
  m.comp_rank = 2;
  m.comp_laps_count = 8;
  m.comp_lap_distance = 1234;
  m.comp_speed = 221.4;
  ASSERT_EQ(read(frame_of(m), at_ms(3)), Reading::kApplied);
  const auto& rival = read.state.signals.rival;
  EXPECT_TRUE(rival.received);
  EXPECT_EQ(rival.at, at_ms(3));
  EXPECT_EQ(rival.value.number, 17);
  EXPECT_EQ(rival.value.rank, 2);
  EXPECT_EQ(rival.value.laps, 8);
  EXPECT_NEAR(rival.value.lap_distance_m, 1234, 1e-9);
  EXPECT_NEAR(rival.value.speed_mps, 61.5, 1e-9);
}

TEST(Readings, EngineHealthAndThrottleFeedback) {
  Reader read;
  av21::PtReport2 e;
  e.fuel_pressure_kPa = 350;
  e.engine_oil_pressure_kPa = 420;
  e.coolant_temperature = 92;
  e.transmission_temperature = 101;
  e.transmission_pressure_kPa = 77;
  ASSERT_EQ(read(frame_of(e)), Reading::kApplied);
  EXPECT_NEAR(read.state.signals.engine.value.oil_pressure_kpa, 420, 1e-9);
  EXPECT_NEAR(read.state.signals.engine.value.transmission_c, 101, 1e-9);
  av21::AcceleratorReport a;
  a.acc_pedal_fdbk = 33.3;
  a.acc_pedal_fdbk_counter = 1;
  ASSERT_EQ(read(frame_of(a)), Reading::kApplied);
  EXPECT_NEAR(read.state.signals.throttle_fraction.value, 0.333, 1e-9);
  a.acc_pedal_fdbk = 200;
  EXPECT_EQ(read(frame_of(a)), Reading::kOutOfRange);
}

TEST(Readings, EveryStateOfTheDriveByWireAndNoOther) {
  for (int raw = 0; raw < 256; ++raw) {
    Reader read;
    av21::MiscReport m;
    m.battery_voltage = 12.5;
    m.sys_state = raw;
    m.mode_switch_state = 1;
    m.raptor_rolling_counter = 9;
    m.safety_switch_state = 5;
    const bool known = raw <= 19 || raw == 255;
    EXPECT_EQ(read(frame_of(m)), known ? Reading::kApplied : Reading::kOutOfRange) << raw;
    EXPECT_EQ(read.state.signals.misc.received, known);
    if (!known) continue;
    EXPECT_EQ(static_cast<int>(read.state.signals.misc.value.sys_state), raw);
    EXPECT_EQ(read.state.signals.misc.value.safety_switch, 5);
    EXPECT_EQ(read.state.signals.misc.value.mode_switch, 1);
  }
}

TEST(Readings, EveryDiagnosticBitIsItsOwn) {
  // Bits of diagnostic_report; 8 to 15 are one number.
  for (unsigned bit = 0; bit < 24; ++bit) {
    if (bit >= 8 && bit < 16) continue;
    Reader read;
    can::Frame frame;
    frame.id = av21::DiagnosticReport::kId;
    frame.length = av21::DiagnosticReport::kLength;
    frame.data[bit / 8] = static_cast<std::uint8_t>(1u << (bit % 8));
    ASSERT_EQ(read(frame), Reading::kApplied);
    const auto& d = read.state.signals.diagnostics.value;
    const std::array<bool, 16> seen{
        d.system_warning,         d.system_failure,   d.brake_warning[0],
        d.brake_warning[1],       d.brake_warning[2], d.steer_warning[0],
        d.steer_warning[1],       d.steer_warning[2], d.front_brake_out_of_spec,
        d.rear_brake_out_of_spec, d.low_engine_speed, d.steer_comms_lost,
        d.motec_comms_lost,       d.emergency_brake,  d.computer_heartbeat_lost,
        d.race_control_lost};
    const unsigned expected = bit < 8 ? bit : bit - 8;
    for (unsigned i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], i == expected) << bit;
  }
}

TEST(Readings, MessagesWithoutAReaderOnlyLive) {
  Reader read;
  can::Frame frame;
  frame.id = av21::WheelPotentiometerData::kId;
  frame.length = av21::WheelPotentiometerData::kLength;
  EXPECT_EQ(read(frame), Reading::kApplied);
}

}  // namespace
}  // namespace pitwall::gateway
