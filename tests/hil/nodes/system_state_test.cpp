// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/system_state.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pitwall::drive_by_wire {
namespace {

using world::CtState;
using world::SysState;

struct Rng {
  std::mt19937 engine;
  std::uint32_t operator()() { return static_cast<std::uint32_t>(engine()); }
};

// Ticks of 10 ms with constant inputs; the states that were entered, in order.
std::vector<SysState> walk(SysState& state, const SystemInputs& in, Duration time) {
  std::vector<SysState> seen;
  Duration lasted{};
  for (Duration t{}; t < time; t = t + milliseconds(10)) {
    const SysState next = next_state(state, lasted, in);
    lasted = next == state ? lasted + milliseconds(10) : Duration{};
    if (next != state) seen.push_back(next);
    state = next;
  }
  return seen;
}

TEST(SystemState, StartsUpInThePublishedOrderAndWaitsInStandby) {
  SysState state = SysState::kPowerOn;
  EXPECT_EQ(walk(state, {}, seconds(60)),
            (std::vector{SysState::kSubsystemsConnected, SysState::kActuatorTesting,
                         SysState::kActuatorTestDone, SysState::kCrankReady,
                         SysState::kPreCrankCheck, SysState::kStandby}));
}

TEST(SystemState, CranksOnlyForBothComputerAndRaceControl) {
  for (int ct = 0; ct <= 12; ++ct)
    for (const bool orange : {false, true}) {
      SysState state = SysState::kStandby;
      walk(state, {.ct = static_cast<CtState>(ct), .orange = orange}, seconds(2));
      const bool cranks = ct == 5 && orange;
      EXPECT_EQ(state == SysState::kCranking, cranks) << "ct " << ct << " orange " << orange;
    }
}

TEST(SystemState, DrivesOnceTheEngineRunsAndOrangeIsGone) {
  SysState state = SysState::kCranking;
  SystemInputs in{.ct = CtState::kCranking, .orange = true, .engine_running = true};
  walk(state, in, seconds(5));
  EXPECT_EQ(state, SysState::kEngineRunning);
  in.ct = CtState::kRaceReady;
  walk(state, in, seconds(5));
  EXPECT_EQ(state, SysState::kEngineRunning);  // still orange
  in.orange = false;
  walk(state, in, seconds(5));
  EXPECT_EQ(state, SysState::kDriving);
}

TEST(SystemState, AnEngineThatDoesNotStartIsReportedAndCanBeTriedAgain) {
  SysState state = SysState::kCranking;
  walk(state, {.ct = CtState::kCranking, .orange = true}, kStarterTimeout + seconds(1));
  EXPECT_EQ(state, SysState::kEngineFailedToStart);
  walk(state, {.ct = CtState::kCrankReady, .orange = true}, seconds(1));
  EXPECT_EQ(state, SysState::kStandby);
}

TEST(SystemState, EmergencyActsAtOnceFromEveryStateWithATurningEngine) {
  for (const SysState from :
       {SysState::kCranking, SysState::kEngineRunning, SysState::kDriving, SysState::kShutEngine}) {
    const SystemInputs in{
        .ct = CtState::kEmergencyShutdown, .engine_kill = true, .engine_running = true};
    EXPECT_EQ(next_state(from, {}, in), SysState::kEmergencyShutdown);
  }
}

TEST(SystemState, EmergencyIsLeftOnlyAtStandstillWithTheEngineOff) {
  for (int bits = 0; bits < 8; ++bits) {
    const SystemInputs in{
        .ct = (bits & 1) != 0 ? CtState::kEmergencyShutdown : CtState::kInitialized,
        .engine_running = (bits & 2) != 0,
        .standstill = (bits & 4) != 0};
    SysState state = SysState::kEmergencyShutdown;
    walk(state, in, seconds(5));
    EXPECT_EQ(state == SysState::kStandby, bits == 4) << bits;
  }
}

TEST(SystemState, EngineKillAndControlledShutdownStopTheEngineThenReturnToStandby) {
  for (const bool by_flag : {false, true}) {
    SysState state = SysState::kDriving;
    SystemInputs in{.ct = by_flag ? CtState::kNominalRace : CtState::kControlledShutdown,
                    .engine_kill = by_flag,
                    .engine_running = true};
    walk(state, in, seconds(3));
    EXPECT_EQ(state, SysState::kShutEngine);
    in.engine_running = false;
    walk(state, in, seconds(3));
    EXPECT_EQ(state, SysState::kStandby);
  }
}

// Driving is entered from "engine running" only, and that from cranking only, whatever happens.
TEST(SystemState, NoInputsLeadToDrivingPastTheStarter) {
  Rng rng{std::mt19937{5}};
  SysState state = SysState::kPowerOn;
  int drives = 0;
  Duration lasted{};
  SystemInputs in;
  for (int i = 0; i < 400'000; ++i) {
    if (rng() % 200 == 0)
      in = {.ct = static_cast<CtState>(rng() % 13),
            .orange = rng() % 2 == 0,
            .engine_kill = rng() % 8 == 0,
            .engine_running = rng() % 2 == 0,
            .standstill = rng() % 2 == 0};
    const SysState next = next_state(state, lasted, in);
    if (next != state) {
      if (next == SysState::kDriving) {
        EXPECT_EQ(state, SysState::kEngineRunning);
        ++drives;
      }
      EXPECT_TRUE(next != SysState::kEngineRunning || state == SysState::kCranking);
      EXPECT_TRUE(next != SysState::kCranking || state == SysState::kStandby);
    }
    lasted = next == state ? lasted + milliseconds(10) : Duration{};
    state = next;
  }
  EXPECT_GT(drives, 0);
}

}  // namespace
}  // namespace pitwall::drive_by_wire
