// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/handshake.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/vehicle/gateway/traffic.hpp"

namespace pitwall::gateway {
namespace {

using namespace testing;
using world::CtState;
using world::Mode;
using world::SysState;
using world::TrackFlag;
using world::VehicleFlag;

constexpr std::array kStates{
    CtState::kDefault,          CtState::kPowerOn,         CtState::kInitialized,
    CtState::kActuatorTest,     CtState::kCrankReady,      CtState::kCranking,
    CtState::kRaceReady,        CtState::kInitDriving,     CtState::kCaution,
    CtState::kNominalRace,      CtState::kCoordinatedStop, CtState::kControlledShutdown,
    CtState::kEmergencyShutdown};

struct DriveByWireRig {
  HandshakeParams params;
  HandshakeState state;
  HandshakeInputs inputs{.speed_mps = 0.0};
  Instant now{};

  CtState wait(Duration span) {
    CtState ct = state.ct;
    for (const Instant end = now + span; now < end;) {
      now += milliseconds(10);
      ct = handshake(params, state, inputs, now);
    }
    return ct;
  }
};

TEST(Handshake, AWholeDayFromPowerOnToShutdown) {
  DriveByWireRig adapter;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kDefault) << "waits for race control";
  adapter.inputs.track = TrackFlag::kRed;
  adapter.inputs.sys = SysState::kPowerOn;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kActuatorTest) << "waits for the actuator test";
  adapter.inputs.sys = SysState::kActuatorTestDone;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCrankReady);
  adapter.inputs.track = TrackFlag::kOrange;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCrankReady)
      << "no cranking before the brake is held";
  adapter.inputs.mode = Mode::kStandby;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCranking);
  adapter.inputs.sys = SysState::kEngineRunning;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kInitDriving);
  adapter.inputs.sys = SysState::kDriving;
  adapter.inputs.track = TrackFlag::kYellow;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kInitDriving)
      << "no rolling before the mode is driving";
  adapter.inputs.mode = Mode::kDriving;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCaution);
  adapter.inputs.track = TrackFlag::kGreen;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kNominalRace);
  adapter.inputs.track = TrackFlag::kWavingGreen;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kNominalRace);
  adapter.inputs.track = TrackFlag::kYellow;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCaution);
  adapter.inputs.track = TrackFlag::kRed;
  EXPECT_EQ(adapter.wait(milliseconds(10)), CtState::kCoordinatedStop) << "at once";
  adapter.inputs.track = TrackFlag::kGreen;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kNominalRace);
  adapter.inputs.mode = Mode::kControlledStop;
  EXPECT_EQ(adapter.wait(milliseconds(10)), CtState::kCoordinatedStop);
  adapter.inputs.operator_shutdown = true;
  adapter.inputs.speed_mps = 20.0;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCoordinatedStop) << "not while it rolls";
  adapter.inputs.speed_mps = kUnset;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCoordinatedStop) << "nor when nobody knows";
  adapter.inputs.speed_mps = 0.2;
  EXPECT_EQ(adapter.wait(seconds(5)), CtState::kControlledShutdown);
}

// The drive-by-wire waits for commands in 7 to 10, and nobody gives any while disarmed.
TEST(Handshake, ACarThatIsDisarmedAtRestIsReadyToBeArmedAgain) {
  for (const CtState from : {CtState::kInitDriving, CtState::kCaution, CtState::kNominalRace,
                             CtState::kCoordinatedStop}) {
    for (const TrackFlag flag : {TrackFlag::kGreen, TrackFlag::kRed}) {
      DriveByWireRig adapter;
      adapter.state = {from, adapter.now};
      adapter.inputs = {.sys = SysState::kDriving, .track = flag, .mode = Mode::kHalted};
      adapter.inputs.speed_mps = 0.0;
      EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCoordinatedStop) << "halted it is still held";
      adapter.inputs.mode = Mode::kDisarmed;
      adapter.inputs.speed_mps = 5.0;
      EXPECT_EQ(adapter.wait(seconds(5)), CtState::kCoordinatedStop) << "not while it rolls";
      adapter.inputs.speed_mps = 0.0;
      EXPECT_EQ(adapter.wait(seconds(1)), CtState::kRaceReady);
      adapter.inputs.track = TrackFlag::kGreen;
      adapter.inputs.mode = Mode::kStandby;
      EXPECT_EQ(adapter.wait(seconds(1)), CtState::kInitDriving);
      adapter.inputs.mode = Mode::kDriving;
      EXPECT_EQ(adapter.wait(seconds(2)), CtState::kNominalRace);
    }
  }
}

// Whatever is asked while the car moves: only what an emergency or an open throttle asks.
TEST(Handshake, NothingElseTurnsTheEngineOffWhileTheCarMoves) {
  DriveByWireRig adapter;
  adapter.state = {CtState::kNominalRace, adapter.now};
  for (const Mode mode : {Mode::kDriving, Mode::kCoast, Mode::kControlledStop}) {
    for (const double v : {1.01, 20.0, 65.0, kUnset}) {
      adapter.inputs = {.sys = SysState::kDriving,
                        .track = TrackFlag::kRed,
                        .vehicle = VehicleFlag::kEngineKill,
                        .mode = mode,
                        .speed_mps = v,
                        .operator_shutdown = true};
      EXPECT_EQ(adapter.wait(seconds(2)), CtState::kCoordinatedStop) << v;
    }
  }
}

TEST(Handshake, EveryEmergencyFromEveryStateAndThereItStays) {
  for (const CtState from : kStates) {
    for (int kind = 0; kind < 4; ++kind) {
      DriveByWireRig adapter;
      adapter.state = {from, adapter.now};
      if (kind == 0) adapter.inputs.mode = Mode::kEmergencyStop;
      if (kind == 1) adapter.inputs.operator_emergency = true;
      if (kind == 2) adapter.inputs.vehicle = VehicleFlag::kPurpleEmergency;
      if (kind == 3) adapter.inputs.engine_off = true;
      EXPECT_EQ(adapter.wait(milliseconds(10)), CtState::kEmergencyShutdown);
      adapter.inputs = {.sys = SysState::kDriving,
                        .track = TrackFlag::kGreen,
                        .mode = Mode::kDriving,
                        .speed_mps = 0.0};
      EXPECT_EQ(adapter.wait(seconds(10)), CtState::kEmergencyShutdown);
    }
  }
}

// The transitions as published, one line each; every other change must be an emergency or a stop.
struct Edge {
  CtState from, to;
};
const std::vector<Edge> kPublished{{CtState::kDefault, CtState::kPowerOn},
                                   {CtState::kPowerOn, CtState::kInitialized},
                                   {CtState::kInitialized, CtState::kActuatorTest},
                                   {CtState::kActuatorTest, CtState::kCrankReady},
                                   {CtState::kCrankReady, CtState::kCranking},
                                   {CtState::kCranking, CtState::kRaceReady},
                                   {CtState::kRaceReady, CtState::kInitDriving},
                                   {CtState::kInitDriving, CtState::kCaution},
                                   {CtState::kCaution, CtState::kNominalRace},
                                   {CtState::kNominalRace, CtState::kCaution},
                                   {CtState::kCoordinatedStop, CtState::kCaution},
                                   {CtState::kControlledShutdown, CtState::kCranking}};

bool is_published(CtState from, CtState to) {
  for (const Edge& edge : kPublished)
    if (edge.from == from && edge.to == to) return true;
  return false;
}

HandshakeInputs any_inputs(Random& random) {
  HandshakeInputs in;
  in.sys = static_cast<SysState>(random.below(20));
  in.track = static_cast<TrackFlag>(random.below(8));
  in.vehicle = static_cast<VehicleFlag>(random.below(12));
  if (random.below(4) != 0) in.vehicle = VehicleFlag::kNone;
  in.mode = static_cast<Mode>(random.below(world::kModes));
  // Emergencies end a run: rare, so that there is something to end.
  const bool rare = random.below(40) != 0;
  if (rare && in.mode == Mode::kEmergencyStop) in.mode = Mode::kDriving;
  if (rare && in.vehicle == VehicleFlag::kPurpleEmergency) in.vehicle = VehicleFlag::kNone;
  in.speed_mps = random.below(3) == 0 ? kUnset : random.between(0.0, 3.0);
  in.operator_shutdown = random.below(20) == 0;
  in.operator_emergency = random.below(500) == 0;
  return in;
}

TEST(Handshake, RandomInputsNeverLeaveThePublishedEdges) {
  Random random{11};
  int changes = 0;
  for (int run = 0; run < 400; ++run) {
    DriveByWireRig adapter;
    adapter.state = {kStates[random.below(kStates.size())], adapter.now};
    for (int i = 0; i < 200; ++i) {
      const CtState from = adapter.state.ct;
      const Instant since = adapter.state.since;
      adapter.inputs = any_inputs(random);
      adapter.now += milliseconds(static_cast<std::int64_t>(10 + random.below(300)));
      const CtState to = handshake(adapter.params, adapter.state, adapter.inputs, adapter.now);
      const HandshakeInputs& in = adapter.inputs;
      const bool emergency = in.mode == Mode::kEmergencyStop || in.operator_emergency ||
                             in.vehicle == VehicleFlag::kPurpleEmergency;
      if (from == CtState::kEmergencyShutdown || emergency) {
        ASSERT_EQ(to, CtState::kEmergencyShutdown);
        continue;
      }
      const bool stopping = in.mode == Mode::kControlledStop || in.mode == Mode::kHalted ||
                            in.track == TrackFlag::kRed || in.track == TrackFlag::kUnknown ||
                            in.vehicle == VehicleFlag::kUnknown ||
                            in.vehicle == VehicleFlag::kStop ||
                            in.vehicle == VehicleFlag::kEngineKill;
      if (drives(from) && stopping) {
        ASSERT_EQ(to, CtState::kCoordinatedStop);
        continue;
      }
      if (to == from) continue;
      ++changes;
      ASSERT_GE(adapter.now - since, adapter.params.dwell);
      if (to == CtState::kControlledShutdown) {
        ASSERT_LE(in.speed_mps, adapter.params.standstill_mps);
      } else if (to == CtState::kRaceReady && from != CtState::kCranking) {
        ASSERT_EQ(in.mode, Mode::kDisarmed);
        ASSERT_LE(in.speed_mps, adapter.params.standstill_mps);
      } else {
        ASSERT_TRUE(is_published(from, to))
            << static_cast<int>(from) << ">" << static_cast<int>(to);
      }
      if (to == CtState::kCaution || to == CtState::kNominalRace) {
        ASSERT_TRUE(in.mode == Mode::kDriving || in.mode == Mode::kCoast);
        ASSERT_EQ(in.sys, SysState::kDriving);
      }
      if (drives(to)) {
        ASSERT_TRUE(in.mode == Mode::kStandby || in.mode == Mode::kDriving ||
                    in.mode == Mode::kCoast);
      }
    }
  }
  EXPECT_GT(changes, 1000);
}

TEST(Handshake, TheTableAloneKeepsTheStateWithoutEvents) {
  for (const CtState ct : kStates) EXPECT_EQ(next(ct, CtEvents{}), ct);
}

}  // namespace
}  // namespace pitwall::gateway
