// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/rig.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/hil/bench/standing.hpp"

namespace pitwall::bench {
namespace {

using FrameLog = std::vector<std::pair<Instant, Outgoing>>;

struct Received {
  FrameLog frames;
  std::map<std::pair<std::string, int>, std::vector<Instant>> samples;  // (kind, unit) -> validity
  std::vector<double> speed_mps;
};

// Nobody commands anything: the car stands with its brake on.
Received listen(const scenario::Scenario& scenario, Duration span) {
  auto rig = Rig::build(scenario, lap().setup.track);
  EXPECT_TRUE(rig) << to_string(rig.error());
  Received received;
  for (Instant at = Instant{} + kRigStep; at - Instant{} <= span; at += kRigStep) {
    rig->step({}, at);
    for (const Outgoing& outgoing : rig->take_frames()) received.frames.emplace_back(at, outgoing);
    EXPECT_TRUE(rig->take_frames().empty()) << "frames are taken once";
    const world::SensorInput samples = rig->take_samples();
    for (const auto& s : samples.positions) received.samples[{"position", s.unit}].push_back(s.at);
    for (const auto& s : samples.velocities) received.samples[{"velocity", s.unit}].push_back(s.at);
    for (const auto& s : samples.headings) received.samples[{"heading", s.unit}].push_back(s.at);
    for (const auto& s : samples.imu) received.samples[{"imu", s.unit}].push_back(s.at);
  }
  EXPECT_EQ(rig->overflows(), 0u);
  return received;
}

std::size_t count(const Received& received, std::uint32_t id, Duration from, Duration until) {
  return static_cast<std::size_t>(
      std::count_if(received.frames.begin(), received.frames.end(), [&](const auto& entry) {
        return entry.second.frame.id == id && entry.first - Instant{} > from &&
               entry.first - Instant{} <= until;
      }));
}

std::size_t count(const std::vector<Instant>& instants, Duration from, Duration until) {
  return static_cast<std::size_t>(std::count_if(instants.begin(), instants.end(), [&](Instant at) {
    return at - Instant{} > from && at - Instant{} <= until;
  }));
}

TEST(Rig, WhatCannotBeBuiltIsRefused) {
  scenario::Scenario s = standing();
  s.start.speed_mps = 10.0;
  EXPECT_FALSE(Rig::build(s, lap().setup.track));
  s = standing();
  s.start.s_m = lap().setup.track.length_m();
  EXPECT_FALSE(Rig::build(s, lap().setup.track));
  for (const double n_m : {40.0, -40.0}) {
    s = standing();
    s.start.n_m = n_m;
    EXPECT_FALSE(Rig::build(s, lap().setup.track)) << n_m;
  }
  s = standing();
  s.faults = {fault_at(seconds(2), "earthquake")};
  const auto rig = Rig::build(s, lap().setup.track);
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().place, "test");
}

TEST(Rig, TheCarStandsWhereTheScenarioSays) {
  scenario::Scenario s = standing();
  for (const double station_m : {0.0, 600.0, 1250.0, 2454.0}) {
    s.start = {.s_m = station_m, .n_m = 1.0};
    auto rig = Rig::build(s, lap().setup.track);
    ASSERT_TRUE(rig);
    EXPECT_NEAR(rig->road().s_m, station_m, 0.01);
    EXPECT_NEAR(rig->road().n_m, 1.0, 0.01);
    for (Instant at = Instant{} + kRigStep; at <= Instant{} + seconds(3); at += kRigStep)
      rig->step({}, at);
    EXPECT_NEAR(rig->road().s_m, station_m, 0.5) << "no command: it does not run away";
    EXPECT_LT(rig->truth().speed_mps, 0.2);
  }
}

TEST(Rig, EveryNodeSpeaksAtItsRate) {
  const Received received = listen(standing(), seconds(4));
  EXPECT_EQ(count(received, 1300, seconds(2), seconds(3)), 200u);
  EXPECT_EQ(count(received, 1303, seconds(2), seconds(3)), 100u);
  EXPECT_EQ(count(received, 1304, seconds(2), seconds(3)), 2u);
  EXPECT_EQ(count(received, 1200, seconds(2), seconds(3)), 2u);
  EXPECT_EQ(count(received, 1209, seconds(2), seconds(3)), 10u);
  for (const auto& [at, outgoing] : received.frames) {
    const bool of_race_control = outgoing.frame.id < 1300;
    EXPECT_EQ(outgoing.from, of_race_control ? Node::kRaceControl : Node::kDriveByWire)
        << outgoing.frame.id;
  }
  for (int unit = 0; unit < 2; ++unit) {
    const auto rate = [&](const char* kind) {
      return count(received.samples.at({kind, unit}), milliseconds(1500), milliseconds(3500));
    };
    EXPECT_EQ(rate("position"), 40u);
    EXPECT_EQ(rate("velocity"), 40u);
    EXPECT_EQ(rate("heading"), 2u);
    EXPECT_EQ(rate("imu"), 250u);
  }
}

TEST(Rig, AFaultOutsideItsTimeChangesNothing) {
  const Received without = listen(standing(), seconds(4));
  for (const auto& kind : faults::kBenchFaults) {
    scenario::Scenario s = standing();
    s.faults = {fault_at(seconds(2), std::string(kind.name), kind.value.empty() ? kUnset : 0.5)};
    if (!plan_faults(s.faults, 1)) continue;  // not in this bench
    const Received with = listen(s, seconds(2) - kRigStep);
    ASSERT_LE(with.frames.size(), without.frames.size());
    for (std::size_t i = 0; i < with.frames.size(); ++i) {
      ASSERT_EQ(with.frames[i].first, without.frames[i].first) << kind.name;
      ASSERT_EQ(with.frames[i].second.frame, without.frames[i].second.frame) << kind.name;
    }
  }
}

TEST(Rig, ASilentBusIsSilentForItsTime) {
  scenario::Scenario s = standing();
  s.faults = {fault_at(seconds(2), "bus_silent")};
  const Received received = listen(s, seconds(4));
  EXPECT_EQ(count(received, 1300, milliseconds(1999), milliseconds(2999)), 0u);
  EXPECT_EQ(count(received, 1200, milliseconds(1999), milliseconds(2999)), 0u);
  EXPECT_GT(count(received, 1300, seconds(1), milliseconds(1999)), 190u);
  EXPECT_GT(count(received, 1300, seconds(3), seconds(4)), 190u);
  EXPECT_EQ(count(received.samples.at({"imu", 0}), seconds(2), seconds(3)), 125u)
      << "satellites do not come over the bus";
}

// The car stands and its drive-by-wire brakes by itself: the lost circuit holds nothing, the other
// one what is asked.
TEST(Rig, ALostBrakeCircuitHoldsNoPressure) {
  for (const std::uint8_t lost : {std::uint8_t{0}, std::uint8_t{1}}) {
    auto rig = Rig::build(standing(), lap().setup.track);
    ASSERT_TRUE(rig);
    rig->add_fault({.kind = faults::BenchFaultKind::kBrakeCircuitLost,
                    .start = Instant{} + seconds(3),
                    .unit = lost});
    for (Instant at = Instant{} + kRigStep; at <= Instant{} + seconds(5); at += kRigStep) {
      rig->step({}, at);
      if (at != Instant{} + milliseconds(2999)) continue;
      EXPECT_GT(rig->truth().brake_front_kpa, 1000.0);
      EXPECT_GT(rig->truth().brake_rear_kpa, 1000.0);
    }
    const double front_kpa = rig->truth().brake_front_kpa, rear_kpa = rig->truth().brake_rear_kpa;
    EXPECT_LT(lost == 0 ? front_kpa : rear_kpa, 1.0);
    EXPECT_GT(lost == 0 ? rear_kpa : front_kpa, 1000.0);
  }
}

TEST(Rig, SilentRaceControlLeavesTheOthersAlone) {
  scenario::Scenario s = standing();
  s.faults = {fault_at(seconds(2), "race_control_silent")};
  const Received received = listen(s, seconds(4));
  EXPECT_EQ(count(received, 1200, seconds(2), milliseconds(2999)), 0u);
  EXPECT_EQ(count(received, 1300, seconds(2), seconds(3)), 200u);
  EXPECT_GE(count(received, 1200, seconds(3), seconds(4)), 2u);
}

TEST(Rig, AnOutageTakesItsUnitOnlyAndDisturbsNoOtherSample) {
  const Received without = listen(standing(), seconds(4));
  for (int unit = 0; unit < 2; ++unit) {
    scenario::Scenario s = standing();
    s.faults = {fault_at(seconds(2), "gnss_unit_outage")};
    s.faults[0].unit = static_cast<std::uint32_t>(unit);
    const Received with = listen(s, seconds(4));
    for (const char* kind : {"position", "velocity", "imu"}) {
      EXPECT_EQ(count(with.samples.at({kind, unit}), seconds(2), milliseconds(2999)), 0u) << kind;
      EXPECT_GT(count(with.samples.at({kind, unit}), seconds(3), seconds(4)), 15u) << kind;
      EXPECT_EQ(with.samples.at({kind, 1 - unit}), without.samples.at({kind, 1 - unit})) << kind;
    }
  }
}

TEST(Rig, ADelayedFrameKeepsItsSender) {
  scenario::Scenario s = standing();
  s.faults = {fault_at(seconds(2), "delay", 0.1)};
  const Received received = listen(s, seconds(4));
  std::size_t late = 0;
  for (const auto& [at, outgoing] : received.frames) {
    if (outgoing.frame.id != 1200 && outgoing.frame.id != 1209) continue;
    EXPECT_EQ(outgoing.from, Node::kRaceControl);
    late += at > Instant{} + milliseconds(2100) && at < Instant{} + milliseconds(3100) ? 1U : 0U;
  }
  EXPECT_GE(late, 11u);
  EXPECT_EQ(count(received, 1300, milliseconds(1999), milliseconds(2099)), 0u) << "all are delayed";
}

TEST(Rig, FrameFaultsReachTheFramesOfTheirId) {
  scenario::Scenario s = standing();
  s.faults = {fault_at(seconds(2), "drop_all")};
  s.faults[0].can_id = 1303;
  const Received received = listen(s, seconds(4));
  EXPECT_EQ(count(received, 1303, milliseconds(1999), milliseconds(2999)), 0u);
  EXPECT_EQ(count(received, 1301, seconds(2), seconds(3)), 100u);
  EXPECT_EQ(count(received, 1303, seconds(3), seconds(4)), 100u);
}

}  // namespace
}  // namespace pitwall::bench
