// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/guardian.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>

#include "tests/vehicle/guardian/straight.hpp"

namespace pitwall::guardian {
namespace {

struct Test : ::testing::Test {
  std::unique_ptr<Straight> car = std::make_unique<Straight>();

  // A car that drove, and whose process fell silent in this millisecond.
  void silence() {
    car->drive_for_a_second();
    car->fall_silent();
  }
};
using Guardian = Test;

template <class M>
std::vector<M> of_kind(const std::vector<can::Frame>& frames) {
  std::vector<M> found;
  for (const can::Frame& frame : frames) {
    M message;
    if (frame.id == M::kId && av21::decode(frame, message)) found.push_back(message);
  }
  return found;
}

TEST_F(Guardian, WatchesACarThatDrivesAndSaysNothing) {
  car->run(seconds(3));
  EXPECT_EQ(car->mode(), Mode::kWatching);
  EXPECT_TRUE(car->so_far.empty());
}

TEST_F(Guardian, ActsAfterThirtyMillisecondsAndNotBefore) {
  silence();
  const Instant last = car->now;
  while (car->now - last < milliseconds(29)) {
    car->tick();
    ASSERT_EQ(car->mode(), Mode::kWatching) << (car->now - last).milliseconds();
    ASSERT_TRUE(car->sent.empty());
  }
  car->tick();
  EXPECT_EQ(car->now - last, milliseconds(30));
  EXPECT_EQ(car->mode(), Mode::kDriving);
  EXPECT_EQ(car->cause(), Cause::kCarSilent);
  EXPECT_EQ(car->sent.size(), 6u) << "four commands, the report, the accelerations";
}

TEST_F(Guardian, AMachineThatStoodStillIsNoSilentCar) {
  for (const int stood_ms : {11, 31, 113, 2000}) {
    silence();
    car->now += milliseconds(stood_ms);
    car->run(milliseconds(14));
    EXPECT_EQ(car->mode(), Mode::kWatching) << stood_ms;
    car->car_sends = car->car_publishes = true;
    car->run(milliseconds(100));
    EXPECT_EQ(car->mode(), Mode::kWatching) << stood_ms;
    EXPECT_TRUE(car->so_far.empty()) << stood_ms;
  }
}

TEST_F(Guardian, ACarThatIsSilentAfterThatIsOneAfterThirtyMilliseconds) {
  for (const int stood_ms : {11, 31, 113, 2000}) {
    car = std::make_unique<Straight>();
    silence();
    car->now += milliseconds(stood_ms);
    car->run(milliseconds(31));
    EXPECT_EQ(car->mode(), Mode::kDriving) << stood_ms;
  }
}

TEST_F(Guardian, EveryCounterGoesOnWithoutAGapOrARepetition) {
  for (const int start : {0, 200, 254, 255}) {
    car = std::make_unique<Straight>();
    car->counter = static_cast<std::uint8_t>(start + 156);  // 100 messages before the silence
    silence();
    std::uint8_t expected = car->counter, report = car->report_counter;
    Instant before = car->now + milliseconds(20);
    car->run(seconds(3));
    const auto brakes = of_kind<av21::BrakePressureCmd>(car->so_far);
    const auto throttles = of_kind<av21::AcceleratorCmd>(car->so_far);
    const auto steerings = of_kind<av21::SteeringCmd>(car->so_far);
    const auto reports = of_kind<av21::CtReport>(car->so_far);
    ASSERT_GE(brakes.size(), 290u);
    ASSERT_EQ(throttles.size(), brakes.size());
    ASSERT_EQ(steerings.size(), brakes.size());
    ASSERT_EQ(reports.size(), brakes.size());
    for (std::size_t i = 0; i < brakes.size(); ++i) {
      ++expected;
      report = static_cast<std::uint8_t>((report + 1) % 10);
      ASSERT_EQ(brakes[i].brk_pressure_cmd_counter, expected) << i;
      ASSERT_EQ(throttles[i].acc_pedal_cmd_counter, expected) << i;
      ASSERT_EQ(steerings[i].steering_motor_cmd_counter, expected) << i;
      ASSERT_EQ(reports[i].ct_state_rolling_counter, report) << i;
      const double earlier = i > 0 ? throttles[i - 1].acc_pedal_cmd : 40.0;
      ASSERT_LE(throttles[i].acc_pedal_cmd, earlier) << "it closes";
      ASSERT_TRUE(brakes[i].brake_pressure_cmd <= safety::kBrakeTouched_kpa ||
                  throttles[i].acc_pedal_cmd == 0.0);
      ASSERT_TRUE(i < 5 || throttles[i].acc_pedal_cmd == 0.0);
      ASSERT_EQ(reports[i].ct_state, 10.0);
      ASSERT_EQ(reports[i].veh_sig_ack, 3.0) << "acknowledged as the autonomy did last";
      ASSERT_EQ(reports[i].track_cond_ack, 2.0);
      ASSERT_EQ(reports[i].veh_num, 21.0);
    }
    EXPECT_LT(before, car->now);
  }
}

TEST_F(Guardian, StopsTheCarThroughItsOwnGateAndHoldsIt) {
  silence();
  car->run(seconds(25));
  EXPECT_EQ(car->mode(), Mode::kHalted);
  EXPECT_EQ(car->cause(), Cause::kStands);
  EXPECT_EQ(car->speed_mps, 0.0);
  EXPECT_EQ(car->out.gate_refusals, 0u);
  EXPECT_NEAR(of_kind<av21::BrakePressureCmd>(car->so_far).back().brake_pressure_cmd,
              car->params.following.stop.hold_kpa, 1.0);
  EXPECT_TRUE(car->state.status.latched);
  const std::size_t before = car->so_far.size();
  car->run(seconds(1));
  EXPECT_EQ(car->so_far.size(), before + 600) << "the hold is said at 100 Hz";
}

TEST_F(Guardian, WhatItsOwnGateRefusesIsNotSaid) {
  car->params.gate.brake_max_kpa = 500.0;  // less than the stop asks for
  silence();
  car->run(seconds(5));
  EXPECT_GT(car->out.gate_refusals, 0u);
  for (const auto& brake : of_kind<av21::BrakePressureCmd>(car->so_far))
    EXPECT_LE(brake.brake_pressure_cmd, 500.0);
}

struct Obstacle {
  const char* what;
  std::function<void(Straight&)> change;  // before the silence
  Mode mode;
  Cause cause;
};

TEST_F(Guardian, NeverActsWithoutEverythingThatItNeeds) {
  const std::vector<Obstacle> cases{
      {"no record",
       [](Straight& c) {
         c.record_there = false;
         c.state = {};
       },
       Mode::kIdle, Cause::kNone},
      {"no record any more", [](Straight& c) { c.record_there = false; }, Mode::kNothingToDrive,
       Cause::kStale},
      {"disarmed", [](Straight& c) { c.record.armed = false; }, Mode::kIdle, Cause::kNone},
      {"standby", [](Straight& c) { c.record.mode = world::Mode::kStandby; }, Mode::kIdle,
       Cause::kNone},
      {"halted", [](Straight& c) { c.record.mode = world::Mode::kHalted; }, Mode::kIdle,
       Cause::kNone},
      {"no path",
       [](Straight& c) {
         c.keep_stop = true;
         c.record.stop = {};
       },
       Mode::kNothingToDrive, Cause::kNoPath},
      {"off the path",
       [](Straight& c) {
         c.keep_stop = true;
         c.y_m = 6.0;
       },
       Mode::kNothingToDrive, Cause::kOffPath},
  };
  for (const Obstacle& obstacle : cases) {
    car = std::make_unique<Straight>();
    car->run(milliseconds(100));
    obstacle.change(*car);
    car->run(milliseconds(200));
    car->fall_silent();
    car->run(seconds(1));
    EXPECT_EQ(car->mode(), obstacle.mode) << obstacle.what;
    EXPECT_EQ(car->cause(), obstacle.cause) << obstacle.what;
    EXPECT_TRUE(car->so_far.empty()) << obstacle.what;
  }
}

// The record stopped first: the process was alive on the bus, but what it published is old.
TEST_F(Guardian, NeverActsOnARecordThatIsMuchOlderThanTheLastCommand) {
  for (const int lag_ms : {0, 50, 100, 110, 500}) {
    car = std::make_unique<Straight>();
    car->run(seconds(1));
    while ((car->now - Instant{}).ns % milliseconds(10).ns != 0) car->tick();
    car->car_publishes = false;
    car->run(milliseconds(lag_ms));
    car->fall_silent();
    car->run(milliseconds(200));
    EXPECT_EQ(car->mode() == Mode::kDriving, lag_ms <= 100) << lag_ms;
    EXPECT_EQ(car->cause(), lag_ms > 100 ? Cause::kStale : Cause::kCarSilent) << lag_ms;
  }
}

TEST_F(Guardian, ABusOnWhichNobodySendsIsNoSilentCar) {
  silence();
  car->bus_lives = false;
  car->run(milliseconds(25));
  car->state.others_at = car->now - milliseconds(60);
  car->run(milliseconds(100));
  EXPECT_EQ(car->mode(), Mode::kNothingToDrive);
  EXPECT_EQ(car->cause(), Cause::kBusSilent);
  EXPECT_TRUE(car->so_far.empty());
}

// Back after `stall`: the process publishes and is quiet until it is told that it has the car.
void come_back(Straight& car, bool (*quiet)(const Straight&)) {
  car.car_publishes = true;
  for (int i = 0; i < 200; ++i) {
    car.car_sends = !quiet(car);
    car.tick();
  }
}
bool guardian_drives(const Straight& car) { return drives(car.mode()); }

TEST_F(Guardian, GivesTheCarBackToAProcessThatIsBackInTimeAndNeverTwoSend) {
  silence();
  car->run(milliseconds(200));
  ASSERT_EQ(car->mode(), Mode::kDriving);
  car->car_publishes = true;
  bool sent_at_once = false;
  std::size_t sent_after = 0;
  for (int i = 0; i < 500; ++i) {
    car->car_sends = !guardian_drives(*car);
    const bool was_given = !guardian_drives(*car);
    car->tick();
    sent_at_once |= car->car_sends && drives(car->mode());
    if (was_given) sent_after += car->sent.size();
  }
  EXPECT_FALSE(sent_at_once);
  EXPECT_EQ(sent_after, 0u);
  EXPECT_EQ(car->mode(), Mode::kWatching);
  EXPECT_EQ(car->state.status.hand_backs, 1u);
  EXPECT_FALSE(car->state.status.latched);
  // Believed after three records: no sooner.
  EXPECT_GE(car->state.status.drove_until - car->state.status.drove_from, milliseconds(170 + 20));
  EXPECT_LE(car->state.status.drove_until - car->state.status.drove_from, milliseconds(170 + 40));
}

TEST_F(Guardian, KeepsTheCarFromAProcessThatComesBackTooLate) {
  silence();
  car->run(milliseconds(600));
  come_back(*car, guardian_drives);
  EXPECT_EQ(car->mode(), Mode::kDriving);
  EXPECT_TRUE(car->state.status.latched);
  car->run(seconds(25));
  EXPECT_EQ(car->mode(), Mode::kHalted);
}

TEST_F(Guardian, KeepsTheCarFromAnotherRunAndFromOneThatIsNotArmed) {
  for (const bool other_run : {true, false}) {
    car = std::make_unique<Straight>();
    silence();
    car->run(milliseconds(200));
    if (other_run) ++car->record.run;
    if (!other_run) car->record.armed = false;
    come_back(*car, guardian_drives);
    EXPECT_EQ(car->mode(), Mode::kDriving) << other_run;
  }
}

TEST_F(Guardian, KeepsTheCarTheSecondTimeWithinFiveSeconds) {
  silence();
  car->run(milliseconds(200));
  come_back(*car, guardian_drives);
  ASSERT_EQ(car->mode(), Mode::kWatching);
  car->fall_silent();
  car->run(milliseconds(200));
  ASSERT_EQ(car->mode(), Mode::kDriving);
  come_back(*car, guardian_drives);
  EXPECT_EQ(car->mode(), Mode::kDriving);
  EXPECT_TRUE(car->state.status.latched);
}

// A tick of the car that began before it could read that the guardian drives reports `sends` too.
TEST_F(Guardian, ATickOfTheCarThatCrossesTheTakeOverDoesNotTakeTheCarBack) {
  silence();
  while (car->mode() != Mode::kDriving) car->tick();
  for (const auto& [late, stops] :
       {std::pair{milliseconds(1), false}, std::pair{milliseconds(19), false},
        std::pair{milliseconds(21), true}}) {
    Straight crossing = *car;
    while (crossing.now - crossing.state.status.drove_from < late) crossing.tick();
    ++crossing.record.sequence;
    crossing.record.at = crossing.now;
    crossing.record.sends = true;
    crossing.tick();
    EXPECT_EQ(drives(crossing.mode()), !stops) << late.milliseconds();
  }
}

// The car process took the guardian for dead, and sends: it is the guardian that stops.
TEST_F(Guardian, YieldsToAProcessThatSends) {
  silence();
  car->run(milliseconds(700));
  ASSERT_TRUE(car->state.status.latched);
  car->car_publishes = car->car_sends = true;
  car->run(milliseconds(30));
  EXPECT_FALSE(drives(car->mode()));
  EXPECT_TRUE(car->sent.empty());
  EXPECT_TRUE(car->state.status.latched) << "the car's process learns that it must stop";
}

TEST_F(Guardian, TheHoldEndsByAResetOrAStartThatIsNotArmed) {
  struct Case {
    bool other_run, armed, reset, released;
  };
  for (const Case& c : {Case{false, true, false, false}, Case{false, true, true, true},
                        Case{true, false, true, true}, Case{true, true, true, false},
                        Case{true, false, false, false}}) {
    car = std::make_unique<Straight>();
    silence();
    car->run(seconds(25));
    ASSERT_EQ(car->mode(), Mode::kHalted);
    if (c.other_run) ++car->record.run;
    car->record.armed = c.armed;
    car->record.reset = c.reset;
    car->record.mode = c.armed ? world::Mode::kHalted : world::Mode::kDisarmed;
    come_back(*car, guardian_drives);
    EXPECT_EQ(!drives(car->mode()), c.released) << c.other_run << c.armed << c.reset;
    EXPECT_EQ(car->state.status.latched, !c.released);
  }
}

TEST_F(Guardian, WithoutWheelSpeedsTheSpeedIsWhatTheBrakeLeaves) {
  silence();
  car->run(milliseconds(40));
  ASSERT_EQ(car->mode(), Mode::kDriving);
  car->bus_lives = false;
  car->run(seconds(25));
  EXPECT_EQ(car->mode(), Mode::kHalted);
}

}  // namespace
}  // namespace pitwall::guardian
