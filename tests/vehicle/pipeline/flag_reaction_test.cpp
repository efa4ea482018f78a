// Every row of the published flag tables, of both encodings, in every mode of the car: what it does
// and after how many ticks. What is expected is written here by hand, by the raw values.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "tests/vehicle/pipeline/standing_car.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::pipeline {
namespace {

using planning::Reason;
using testing::kStart;
using testing::kTick;
using testing::Received;
using testing::StandingCar;
using world::CtState;
using world::FlagEncoding;
using world::Mode;

constexpr int kPlanTicks = 5;   // planning comes every fifth tick
constexpr int kFlagTicks = 50;  // the flags come every 500 ms

// The last two are for a car whose supervisor acts at once.
enum class Reacts : std::uint8_t { kRaces, kDrives, kStays, kStopsDead, kBrakes };

struct FlagCase {
  FlagEncoding encoding;
  std::uint8_t track, vehicle;
  Reacts reacts;
  Reason reason;
  double speed_mps;  // of the plan
  CtState ct;        // of a car that was in CT 9
};

constexpr auto kMyLaps = FlagEncoding::kMyLaps, kMarelli = FlagEncoding::kMarelli;
constexpr auto k8 = CtState::kCaution, k9 = CtState::kNominalRace, k10 = CtState::kCoordinatedStop,
               k12 = CtState::kEmergencyShutdown;
constexpr double kRound_mps = from_mph(60.0), kGreen_mps = 40.0, kSlow_mps = 22.0;
constexpr std::uint8_t kNoFlag = 200;  // in no table; MyLaps has 4 bits: 13 stands for it

constexpr std::array kCases{
    // MyLaps, track
    FlagCase{kMyLaps, 0, 0, Reacts::kStays, Reason::kNoFlag, 0.0, k9},
    FlagCase{kMyLaps, 1, 0, Reacts::kStays, Reason::kRed, 0.0, k10},
    FlagCase{kMyLaps, 2, 0, Reacts::kStays, Reason::kOrange, 0.0, k9},
    FlagCase{kMyLaps, 3, 0, Reacts::kDrives, Reason::kCaution, kSlow_mps, k8},
    FlagCase{kMyLaps, 4, 0, Reacts::kRaces, Reason::kRoundSpeed, kRound_mps, k9},
    FlagCase{kMyLaps, 8, 0, Reacts::kRaces, Reason::kRoundSpeed, kRound_mps, k9},
    FlagCase{kMyLaps, 13, 0, Reacts::kStays, Reason::kUnknownFlag, 0.0, k10},
    // MyLaps, vehicle
    FlagCase{kMyLaps, 4, 2, Reacts::kStays, Reason::kBlack, kSlow_mps, k9},
    FlagCase{kMyLaps, 4, 4, Reacts::kStays, Reason::kChequered, kSlow_mps, k9},
    FlagCase{kMyLaps, 4, 5, Reacts::kRaces, Reason::kRoundSpeed, kRound_mps, k9},
    FlagCase{kMyLaps, 4, 7, Reacts::kRaces, Reason::kRoundSpeed, kRound_mps, k9},
    FlagCase{kMyLaps, 8, 7, Reacts::kRaces, Reason::kRoundSpeed, kRound_mps, k9},
    FlagCase{kMyLaps, 4, 8, Reacts::kStopsDead, Reason::kStopFlag, 0.0, k12},
    FlagCase{kMyLaps, 4, 13, Reacts::kStays, Reason::kUnknownFlag, 0.0, k10},
    // Marelli, track
    FlagCase{kMarelli, 0, 0, Reacts::kStays, Reason::kNoFlag, 0.0, k9},
    FlagCase{kMarelli, 1, 0, Reacts::kRaces, Reason::kGreen, kGreen_mps, k9},
    FlagCase{kMarelli, 3, 0, Reacts::kStays, Reason::kRed, 0.0, k10},
    FlagCase{kMarelli, 4, 0, Reacts::kStays, Reason::kChequered, kSlow_mps, k8},
    FlagCase{kMarelli, 9, 0, Reacts::kDrives, Reason::kCaution, kSlow_mps, k8},
    FlagCase{kMarelli, 37, 0, Reacts::kRaces, Reason::kGreen, kGreen_mps, k9},
    FlagCase{kMarelli, 40, 0, Reacts::kRaces, Reason::kRoundSpeed, from_mph(40.0), k9},
    FlagCase{kMarelli, 80, 0, Reacts::kRaces, Reason::kRoundSpeed, from_mph(80.0), k9},
    FlagCase{kMarelli, 110, 0, Reacts::kStays, Reason::kUnknownFlag, 0.0, k10},
    FlagCase{kMarelli, kNoFlag, 0, Reacts::kStays, Reason::kUnknownFlag, 0.0, k10},
    // Marelli, vehicle
    FlagCase{kMarelli, 1, 2, Reacts::kRaces, Reason::kGreen, kGreen_mps, k9},
    FlagCase{kMarelli, 1, 4, Reacts::kStays, Reason::kBlack, kSlow_mps, k9},
    FlagCase{kMarelli, 1, 7, Reacts::kDrives, Reason::kCaution, kSlow_mps, k9},
    FlagCase{kMarelli, 1, 25, Reacts::kStays, Reason::kOrange, 0.0, k9},
    FlagCase{kMarelli, 1, 32, Reacts::kStopsDead, Reason::kStopFlag, 0.0, k12},
    FlagCase{kMarelli, 1, 33, Reacts::kBrakes, Reason::kStopFlag, 0.0, k10},
    FlagCase{kMarelli, 1, 34, Reacts::kStays, Reason::kStopFlag, 0.0, k10},
    FlagCase{kMarelli, 1, 35, Reacts::kRaces, Reason::kGreen, kGreen_mps, k9},
    FlagCase{kMarelli, 1, 36, Reacts::kRaces, Reason::kGreen, kGreen_mps, k9},
    FlagCase{kMarelli, 1, kNoFlag, Reacts::kStays, Reason::kUnknownFlag, 0.0, k10}};

// Of the mode in the tick that brings the flag.
Mode expected(Mode from, Reacts reacts) {
  const bool dead = reacts == Reacts::kStopsDead;
  switch (from) {
    case Mode::kStandby:
      if (dead) return Mode::kEmergencyStop;
      return reacts == Reacts::kRaces || reacts == Reacts::kDrives ? Mode::kDriving : from;
    case Mode::kDriving:
    case Mode::kCoast:
      if (dead) return Mode::kEmergencyStop;
      return reacts == Reacts::kBrakes ? Mode::kControlledStop : from;
    case Mode::kControlledStop:
      return dead ? Mode::kEmergencyStop : from;
    default:
      return from;
  }
}

struct FlagRig {
  explicit FlagRig(FlagEncoding encoding) : setup(testing::setup()) {
    setup.params.inbound.flag_encoding = encoding;
    source.marelli_hears = true;
    source.mylaps_track = 0;
    // Until just before the next flags.
    for (int i = 0; i < 4 * kFlagTicks; ++i) tick();
  }

  Outputs tick() {
    Received received = source.receive(now);
    received.requests.arm = armed;
    const Outputs out = step(setup, *car, received.inputs(now));
    now += kTick;
    return out;
  }

  void put_in(Mode mode) {
    armed = mode != Mode::kDisarmed && mode != Mode::kHalted;
    car->supervisor.mode = mode;
    car->supervisor.mode_since = car->supervisor.coast_last = now;
    car->supervisor.standing = false;  // a stop has not ended yet
    car->handshake.ct = CtState::kNominalRace;
  }

  void show(const FlagCase& c) {
    if (c.encoding == kMyLaps)
      source.mylaps_track = c.track, source.mylaps_vehicle = c.vehicle, source.round_speed_mph = 60;
    else
      source.marelli_track = c.track, source.marelli_vehicle = c.vehicle;
  }

  Setup setup;
  StandingCar source;
  std::unique_ptr<Car> car = std::make_unique<Car>();
  Instant now = kStart;
  bool armed = false;
};

// A copy of the rig's car as it was.
struct Snapshot {
  Car car;
  Instant now;
};

TEST(FlagReaction, EveryFlagInEveryModeHasItsReactionInTime) {
  for (const FlagEncoding encoding : {kMyLaps, kMarelli}) {
    FlagRig rig{encoding};
    const Snapshot before{*rig.car, rig.now};
    for (const FlagCase& c : kCases) {
      if (c.encoding != encoding) continue;
      for (std::size_t m = 0; m < world::kModes; ++m) {
        const auto mode = static_cast<Mode>(m);
        SCOPED_TRACE(::testing::Message()
                     << "encoding " << static_cast<int>(encoding) << " track " << int{c.track}
                     << " vehicle " << int{c.vehicle} << " mode " << m);
        *rig.car = before.car, rig.now = before.now;
        rig.put_in(mode);
        rig.show(c);
        const Outputs first = rig.tick();
        EXPECT_EQ(first.chosen.mode, expected(mode, c.reacts));
        if (mode == Mode::kDriving) {
          EXPECT_EQ(first.ct_state, c.ct);
        }
        int ticks = 1;
        while (rig.car->plan.output.reason != c.reason && ticks < kPlanTicks) rig.tick(), ++ticks;
        EXPECT_EQ(rig.car->plan.output.reason, c.reason);
        EXPECT_DOUBLE_EQ(rig.car->plan.output.target_speed_mps, c.speed_mps);
        EXPECT_EQ(rig.car->plan.made_with.raw_track, c.track) << "acknowledged";
      }
    }
  }
}

TEST(FlagReaction, LossOfRaceControlStopsTheCar) {
  for (const Mode mode : {Mode::kDriving, Mode::kCoast}) {
    FlagRig rig{kMyLaps};
    rig.source.mylaps_track = 4;
    rig.put_in(mode);
    rig.tick();
    rig.source.race_control = false;
    int ticks = 0;
    Outputs out;
    for (; ticks < 1100 && !safety::stops(out.chosen.mode) && out.chosen.mode != Mode::kHalted;
         ++ticks) {
      out = rig.tick();
      if (mode == Mode::kCoast) rig.car->supervisor.coast_last = rig.now;
      if (mode == Mode::kCoast) rig.car->supervisor.mode_since = rig.now;
    }
    EXPECT_EQ(out.chosen.mode, Mode::kControlledStop);
    EXPECT_EQ(out.chosen.cause, safety::Cause::kRaceControlLost);
    EXPECT_NEAR(ticks, 1001, 1) << "10 s after the last heartbeat";
  }
}

// A flag of the base binds within the tick of its command, in both directions of restriction.
TEST(FlagReaction, TheStricterOfRaceControlAndBaseHoldsAndTheConflictIsReported) {
  struct Case {
    std::uint8_t mylaps_track;
    world::TrackFlag of_base;
    Reason reason;
    bool reported;
  };
  for (const Case& c : {Case{4, world::TrackFlag::kRed, Reason::kRed, true},
                        Case{4, world::TrackFlag::kYellow, Reason::kCaution, true},
                        Case{1, world::TrackFlag::kGreen, Reason::kRed, true},
                        Case{4, world::TrackFlag::kGreen, Reason::kRoundSpeed, false},
                        Case{4, world::TrackFlag::kNone, Reason::kRoundSpeed, false}}) {
    FlagRig rig{kMyLaps};
    rig.source.mylaps_track = c.mylaps_track, rig.source.round_speed_mph = 60;
    rig.put_in(Mode::kDriving);
    rig.car->orders.flag = c.of_base;
    const Outputs out = rig.tick();
    EXPECT_EQ(out.chosen.causes.has(safety::Cause::kFlagsDisagree), c.reported);
    for (int i = 1; i < kPlanTicks; ++i) rig.tick();
    EXPECT_EQ(rig.car->plan.output.reason, c.reason) << int{c.mylaps_track};
  }
}

TEST(FlagReaction, ARoundSpeedAboveTheCarsIsReportedAtOnceAndDrivenAtTheCarsOwn) {
  for (const double mph : {150.0, 180.0}) {
    FlagRig rig{kMyLaps};
    rig.source.mylaps_track = 4, rig.source.round_speed_mph = mph;
    rig.put_in(Mode::kDriving);
    const Outputs out = rig.tick();
    const double most_mps = rig.setup.params.planning.line.speed_max_mps;
    const bool too_fast = from_mph(mph) > most_mps;
    EXPECT_EQ(out.chosen.causes.has(safety::Cause::kRoundSpeedTooHigh), too_fast) << mph;
    EXPECT_EQ(out.chosen.mode, Mode::kDriving);
    for (int i = 1; i < kPlanTicks; ++i) rig.tick();
    EXPECT_LE(rig.car->plan.made_with.round_target_speed_mps, most_mps);
    EXPECT_GT(rig.car->plan.output.target_speed_mps, 0.0);
  }
}

}  // namespace
}  // namespace pitwall::pipeline
