// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/raptor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <type_traits>
#include <vector>

#include "protocol/can/av21.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::drive_by_wire {
namespace {

namespace av21 = can::av21;
using world::CtState;
using world::SysState;

// A computer, race control and a plant that follows at once, around the drive-by-wire.
struct Rig {
  Params params{.hot_start = true};
  State state;
  Feedback feedback;
  Output out;
  Instant now{};
  CtState ct = CtState::kNominalRace;
  double brake_kpa = 0.0, throttle_percent = 40.0, steering_deg = 20.0, gear = 3.0;
  bool commands = true, reports_ct = true, race_control = true, counters_live = true;
  double track_flag = 4.0;
  int ticks = 0, counter = 0;
  std::vector<can::ReceivedFrame> received;
  std::optional<av21::DiagnosticReport> diagnostics;

  Rig() {
    feedback.wheel_speed_mps = {50.0, 50.0, 50.0, 50.0};
    feedback.vehicle_speed_mps = 50.0;
    feedback.brake_front_kpa = feedback.brake_rear_kpa = feedback.throttle_fraction = 0.0;
    feedback.steering_motor_rad = 0.0;
    feedback.engine_speed_rpm = 5000.0;
    feedback.engine_running = true;
  }

  template <class Message>
  void say(const Message& m) {
    can::Frame f;
    can::EncodeCounters ignored;
    ASSERT_TRUE(av21::encode(m, f, ignored));
    received.push_back({f, now});
  }

  void speak() {
    if (commands && ticks % 10 == 0) {
      if (counters_live) counter = (counter + 1) % 8;
      const double c = counter;
      say(av21::BrakePressureCmd{.brake_pressure_cmd = brake_kpa, .brk_pressure_cmd_counter = c});
      say(av21::AcceleratorCmd{.acc_pedal_cmd = throttle_percent, .acc_pedal_cmd_counter = c});
      say(av21::SteeringCmd{.steering_motor_ang_cmd = steering_deg,
                            .steering_motor_cmd_counter = c});
      say(av21::GearShiftCmd{.desired_gear = gear});
    }
    if (reports_ct && ticks % 100 == 0)
      say(av21::CtReport{.veh_sig_ack = 0.0,
                         .track_cond_ack = 0.0,
                         .ct_state = static_cast<double>(ct),
                         .ct_state_rolling_counter = static_cast<double>(ticks / 100 % 10),
                         .veh_num = 1.0});
    if (race_control && ticks % 500 == 0)
      say(av21::BaseToCarSummary{.base_to_car_heartbeat = static_cast<double>(ticks / 500 % 16),
                                 .track_flag = track_flag,
                                 .veh_flag = 0.0,
                                 .veh_rank = 1.0,
                                 .round_target_speed = 0.0,
                                 .lap_count = 0.0,
                                 .lap_distance = 0.0});
  }

  void tick() {
    received.clear();
    speak();
    out = step(params, state, received, feedback, now);
    for (const can::Frame& f : out.frames) {
      av21::DiagnosticReport m;
      if (av21::decode(f, m)) diagnostics = m;
    }
    feedback.steering_motor_rad = out.demand.steering_motor_rad;
    feedback.brake_front_kpa = out.demand.brake_front_kpa;
    feedback.brake_rear_kpa = out.demand.brake_rear_kpa;
    feedback.throttle_fraction = out.demand.throttle_fraction;
    now += milliseconds(1);
    ++ticks;
  }
  void run(Duration time) {
    for (const Instant end = now + time; now < end;) tick();
  }
};

static_assert(std::is_trivially_copyable_v<State>);

TEST(Raptor, FollowsALiveComputerWhileDriving) {
  Rig rig;
  rig.brake_kpa = 321.0;
  rig.run(seconds(1));
  EXPECT_NEAR(rig.out.demand.steering_motor_rad, from_deg(20.0), 1e-12);
  EXPECT_NEAR(rig.out.demand.throttle_fraction, 0.4, 1e-12);
  EXPECT_EQ(rig.out.demand.brake_front_kpa, 321.0);
  EXPECT_EQ(rig.out.demand.gear, 3);
  EXPECT_TRUE(rig.out.demand.engine_on);
  EXPECT_FALSE(rig.out.watchdog);
}

TEST(Raptor, ColdStartReachesDrivingOnlyThroughTheHandshake) {
  Rig rig;
  rig.params.hot_start = false;
  rig.feedback.vehicle_speed_mps = 0.0;
  rig.feedback.engine_running = false;
  rig.feedback.engine_speed_rpm = 0.0;
  rig.ct = CtState::kCrankReady;
  rig.track_flag = 1.0;
  rig.run(seconds(20));
  EXPECT_EQ(rig.out.system, SysState::kStandby);
  EXPECT_FALSE(rig.out.demand.engine_on);
  EXPECT_EQ(rig.out.demand.throttle_fraction, 0.0);
  EXPECT_EQ(rig.out.demand.brake_front_kpa, rig.params.standby_brake_kpa);

  rig.ct = CtState::kCranking;
  rig.track_flag = 2.0;  // orange
  rig.run(seconds(1));
  EXPECT_EQ(rig.out.system, SysState::kCranking);
  EXPECT_TRUE(rig.out.demand.crank);
  EXPECT_FALSE(rig.out.demand.engine_on);  // starter first
  rig.run(rig.params.starter_time + milliseconds(500));
  EXPECT_TRUE(rig.out.demand.engine_on);
  rig.feedback.engine_running = true;
  rig.feedback.engine_speed_rpm = 1500.0;
  rig.run(seconds(1));
  EXPECT_EQ(rig.out.system, SysState::kEngineRunning);
  EXPECT_FALSE(rig.out.demand.crank);

  rig.ct = CtState::kRaceReady;
  rig.track_flag = 3.0;
  rig.run(seconds(2));
  EXPECT_EQ(rig.out.system, SysState::kDriving);
  EXPECT_EQ(rig.out.demand.throttle_fraction, 0.0);  // CT 6 does not drive yet
  rig.ct = CtState::kInitDriving;
  rig.run(seconds(1));
  EXPECT_GT(rig.out.demand.throttle_fraction, 0.0);
  EXPECT_FALSE(rig.out.watchdog);
}

TEST(Raptor, TheWatchdogActsAfterItsTimeNotBeforeAndRampsTheBrake) {
  Rig rig;
  rig.run(seconds(1));
  const double held_rad = rig.out.demand.steering_motor_rad;
  const Instant last = rig.now - milliseconds(10);  // the commands at 990 ms were the last
  rig.commands = false;
  rig.steering_deg = -50.0;
  while (!rig.out.watchdog && rig.now - last < seconds(1)) rig.tick();
  EXPECT_EQ(rig.now - last, rig.params.command_timeout + milliseconds(2));  // now is one ahead
  double before_kpa = rig.out.demand.brake_front_kpa;
  for (int i = 0; i < 1500; ++i) {
    rig.tick();
    ASSERT_EQ(rig.out.demand.throttle_fraction, 0.0);
    ASSERT_EQ(rig.out.demand.steering_motor_rad, held_rad);
    const double rise_kpa = rig.out.demand.brake_front_kpa - before_kpa;
    ASSERT_GE(rise_kpa, 0.0);
    ASSERT_LE(rise_kpa, rig.params.brake_ramp_kpa_per_s * 1e-3 + 1e-9);
    before_kpa = rig.out.demand.brake_front_kpa;
  }
  EXPECT_EQ(before_kpa, rig.params.emergency_brake_kpa);
  ASSERT_TRUE(rig.diagnostics.has_value());
  EXPECT_EQ(rig.diagnostics->adlink_hb_lost, 1.0);
  EXPECT_EQ(rig.diagnostics->est6_sd_ebrake, 1.0);
}

TEST(Raptor, AFrozenCounterIsNoLife) {
  Rig rig;
  rig.run(seconds(1));
  rig.counters_live = false;
  rig.run(rig.params.command_timeout + milliseconds(20));
  EXPECT_TRUE(rig.out.watchdog);
  EXPECT_GT(rig.state.counters.duplicates, 0U);
}

TEST(Raptor, OneDeadStreamIsEnough) {
  for (const std::uint32_t dead : {1400U, 1401U, 1402U}) {
    Rig rig;
    rig.run(seconds(1));
    for (int i = 0; i < 200; ++i) {
      rig.received.clear();
      rig.speak();
      std::erase_if(rig.received, [&](const auto& r) { return r.frame.id == dead; });
      rig.out = step(rig.params, rig.state, rig.received, rig.feedback, rig.now);
      rig.now += milliseconds(1);
      ++rig.ticks;
    }
    EXPECT_TRUE(rig.out.watchdog) << dead;
  }
}

TEST(Raptor, TheWatchdogStaysUntilTheCarStandsAndCommandsLive) {
  Rig rig;
  rig.run(seconds(1));
  rig.commands = false;
  rig.run(milliseconds(300));
  rig.commands = true;
  rig.run(seconds(3));
  EXPECT_TRUE(rig.out.watchdog) << "still moving";
  rig.feedback.vehicle_speed_mps = 0.0;
  rig.run(milliseconds(20));
  EXPECT_FALSE(rig.out.watchdog);
  rig.run(milliseconds(200));
  EXPECT_EQ(rig.diagnostics->adlink_hb_lost, 0.0);
}

TEST(Raptor, GapsShorterThanTheTimeoutAreNothing) {
  Rig rig;
  for (int i = 0; i < 50; ++i) {
    rig.commands = true;
    rig.run(milliseconds(20));
    rig.commands = false;
    rig.run(milliseconds(80));
    ASSERT_FALSE(rig.out.watchdog) << i;
  }
}

TEST(Raptor, EmergencyShutdownStopsTheEngineBrakesAndStillSteers) {
  Rig rig;
  rig.run(seconds(1));
  rig.ct = CtState::kEmergencyShutdown;
  rig.steering_deg = -30.0;
  rig.run(seconds(2));
  EXPECT_EQ(rig.out.system, SysState::kEmergencyShutdown);
  EXPECT_FALSE(rig.out.demand.engine_on);
  EXPECT_EQ(rig.out.demand.throttle_fraction, 0.0);
  EXPECT_EQ(rig.out.demand.brake_front_kpa, rig.params.emergency_brake_kpa);
  EXPECT_NEAR(rig.out.demand.steering_motor_rad, from_deg(-30.0), 1e-12);
  rig.brake_kpa = 3000.0;
  rig.run(milliseconds(50));
  EXPECT_EQ(rig.out.demand.brake_front_kpa, 3000.0);
}

TEST(Raptor, CoordinatedStopFollowsTheComputerAndControlledShutdownStopsTheEngine) {
  Rig rig;
  rig.run(seconds(1));
  rig.ct = CtState::kCoordinatedStop;
  rig.brake_kpa = 700.0;
  rig.throttle_percent = 0.0;
  rig.run(seconds(1));
  EXPECT_EQ(rig.out.system, SysState::kDriving);
  EXPECT_EQ(rig.out.demand.brake_front_kpa, 700.0);
  rig.ct = CtState::kControlledShutdown;
  rig.throttle_percent = 50.0;
  rig.run(seconds(1));
  EXPECT_EQ(rig.out.system, SysState::kShutEngine);
  EXPECT_FALSE(rig.out.demand.engine_on);
  EXPECT_EQ(rig.out.demand.throttle_fraction, 0.0);
  EXPECT_EQ(rig.out.demand.brake_front_kpa, 700.0);
}

TEST(Raptor, RaceControlIsLostTenSecondsAfterItsLastHeartbeat) {
  Rig rig;
  rig.run(milliseconds(1001));  // the last heartbeat changes at 1000 ms
  rig.race_control = false;
  rig.run(milliseconds(9999));
  EXPECT_FALSE(rig.state.diagnostics.race_control_lost);
  rig.run(milliseconds(2));
  EXPECT_TRUE(rig.state.diagnostics.race_control_lost);
  rig.race_control = true;
  rig.run(seconds(1));
  EXPECT_FALSE(rig.state.diagnostics.race_control_lost);
}

TEST(Raptor, ActuatorFaultsActOnThePlantAndShowInTheDiagnostics) {
  Rig rig;
  rig.run(seconds(1));
  rig.state.faults.steering_stuck = true;
  rig.state.faults.throttle_stuck = true;
  rig.state.faults.brake_leak = 0.75;
  rig.steering_deg = 100.0;
  rig.throttle_percent = 90.0;
  rig.brake_kpa = 4000.0;
  rig.run(seconds(1));
  EXPECT_NEAR(rig.out.demand.steering_motor_rad, from_deg(20.0), 1e-12);
  EXPECT_NEAR(rig.out.demand.throttle_fraction, 0.4, 1e-12);
  EXPECT_NEAR(rig.out.demand.brake_front_kpa, 1000.0, 1e-9);
  rig.state.faults.brake_stuck_kpa = 300.0;
  rig.tick();
  EXPECT_EQ(rig.out.demand.brake_front_kpa, 300.0);
  EXPECT_EQ(rig.out.demand.brake_rear_kpa, 300.0);
  EXPECT_EQ(rig.diagnostics->sd_steer_warning1, 1.0);
  EXPECT_EQ(rig.diagnostics->est1_oos_front_brk, 1.0);
  rig.state.faults = {};
  rig.run(seconds(1));
  EXPECT_NEAR(rig.out.demand.steering_motor_rad, from_deg(100.0), 1e-12);
  EXPECT_EQ(rig.out.demand.brake_front_kpa, 4000.0);
  EXPECT_EQ(rig.diagnostics->est1_oos_front_brk, 0.0);
}

TEST(Raptor, ASlowSteeringMotorKeepsItsRateAndABiasIsInvisible) {
  Rig rig;
  rig.run(seconds(1));
  rig.state.faults.steering_rate_rad_per_s = 0.5;
  rig.steering_deg = -90.0;
  double before_rad = rig.out.demand.steering_motor_rad;
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    ASSERT_LE(std::abs(rig.out.demand.steering_motor_rad - before_rad), 0.5e-3 + 1e-12);
    before_rad = rig.out.demand.steering_motor_rad;
  }
  rig.state.faults = {.steering_bias_rad = 0.7};
  rig.run(seconds(1));
  EXPECT_NEAR(rig.out.demand.steering_motor_rad, from_deg(-90.0) + 0.7, 1e-12);
  EXPECT_EQ(rig.diagnostics->sd_steer_warning1, 0.0);
}

TEST(Raptor, WrongFramesAreCountedAndChangeNothing) {
  Rig rig;
  rig.run(seconds(1));
  const Demand before = rig.out.demand;
  can::Frame f;
  f.id = av21::SteeringCmd::kId;
  f.length = 3;
  f.data.fill(0x55);
  const std::vector<can::ReceivedFrame> bad{{f, rig.now}};
  rig.out = step(rig.params, rig.state, bad, rig.feedback, rig.now);
  EXPECT_EQ(rig.state.counters.undecoded, 1U);
  EXPECT_EQ(rig.out.demand.steering_motor_rad, before.steering_motor_rad);
}

// Whatever the computer says: throttle only in states 8 and 9 with CT 7..10 and a live computer.
TEST(Raptor, ThrottleOnlyWhereTheCarMayDrive) {
  std::mt19937 engine{17};
  const auto draw = [&](std::uint32_t n) { return static_cast<std::uint32_t>(engine()) % n; };
  Rig rig;
  int driven = 0;
  for (int i = 0; i < 60'000; ++i) {
    if (i % 100 == 0) {
      rig.ct = static_cast<CtState>(1 + draw(12));
      rig.commands = draw(4) != 0;
      rig.track_flag = draw(5);
      rig.feedback.engine_running = draw(3) != 0;
      rig.feedback.vehicle_speed_mps = draw(2) == 0 ? 0.0 : 30.0;
      rig.throttle_percent = draw(120);
    }
    rig.tick();
    const bool engine_on =
        rig.out.system == SysState::kEngineRunning || rig.out.system == SysState::kDriving;
    const auto ct = rig.state.ct_state;
    const bool may = engine_on && ct >= CtState::kInitDriving && ct <= CtState::kCoordinatedStop;
    const bool barred = !may || rig.out.watchdog;
    ASSERT_TRUE(!barred || rig.out.demand.throttle_fraction == 0.0) << i;
    ASSERT_LE(rig.out.demand.throttle_fraction, 1.0);
    ASSERT_GE(rig.out.demand.brake_front_kpa, 0.0);
    if (rig.out.demand.throttle_fraction > 0.0) ++driven;
  }
  EXPECT_GT(driven, 100);
}

TEST(Raptor, ACopiedStateContinuesIdenticallyAndStepDoesNotAllocate) {
  Rig rig;
  rig.run(seconds(1));
  Rig copy = rig;
  rig.run(milliseconds(700));
  copy.run(milliseconds(700));
  EXPECT_EQ(rig.out.frames.size(), copy.out.frames.size());
  for (std::size_t i = 0; i < rig.out.frames.size(); ++i)
    EXPECT_EQ(rig.out.frames[i], copy.out.frames[i]);
  EXPECT_EQ(rig.out.demand.brake_front_kpa, copy.out.demand.brake_front_kpa);
  const std::size_t taken = testing::allocations_of(
      [&] { rig.out = step(rig.params, rig.state, rig.received, rig.feedback, rig.now); });
  EXPECT_EQ(taken, 0U);
}

}  // namespace
}  // namespace pitwall::drive_by_wire
