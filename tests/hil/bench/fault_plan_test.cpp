// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/fault_plan.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "hil/faults/perception_faults.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchPart;
using faults::FrameFaultKind;

scenario::Fault row(std::string kind, double value = kUnset) {
  return {.kind = std::move(kind),
          .at = seconds(3),
          .lasts = seconds(2),
          .value = value,
          .place = "file.yaml:9:5"};
}

std::string refusal(const scenario::Fault& fault) {
  const auto plan = plan_faults({fault}, 1);
  return plan ? "" : to_string(plan.error());
}

bool is_refused_there(const scenario::Fault& fault) {
  return refusal(fault).starts_with("file.yaml:9:5: error: ");
}

// A value inside the range of every kind that takes one.
double legal_value(const faults::BenchFaultRow& kind) { return kind.value.empty() ? kUnset : 0.2; }

TEST(FaultPlan, EveryKindOfTheCatalogueIsPlannedOrRefusedByName) {
  std::size_t planned = 0, done_somewhere = 0;
  for (const auto& kind : faults::kBenchFaults) {
    done_somewhere +=
        carried_out(kind.kind, BenchMode::kLive) || carried_out(kind.kind, BenchMode::kLockstep);
    const scenario::Fault fault = row(std::string(kind.name), legal_value(kind));
    const auto plan = plan_faults({fault}, 1);
    if (!plan) {
      EXPECT_TRUE(is_refused_there(fault)) << kind.name;
      EXPECT_NE(refusal(fault).find(kind.name), std::string::npos);
      continue;
    }
    ++planned;
    const auto& here = is_process_fault(kind.kind)              ? plan->processes
                       : is_radio_fault(kind.kind)              ? plan->radio
                       : is_bus_fault(kind.kind)                ? plan->bus
                       : is_clock_fault(kind.kind)              ? plan->clock
                       : is_byte_fault(kind.kind)               ? plan->bytes
                       : is_module_fault(kind.kind)             ? plan->modules
                       : faults::is_perception_fault(kind.kind) ? plan->perception
                                                                : plan->models;
    ASSERT_EQ(here.size(), 1u);
    EXPECT_EQ(plan->frames.size() + plan->models.size() + plan->radio.size() + plan->bus.size() +
                  plan->clock.size() + plan->bytes.size() + plan->modules.size() +
                  plan->perception.size() + plan->processes.size(),
              1u)
        << kind.name;
    EXPECT_EQ(here[0].kind, kind.kind);
    EXPECT_EQ(here[0].start, Instant{} + seconds(3));
    EXPECT_EQ(here[0].duration, seconds(2));
    EXPECT_TRUE(carried_out(kind.kind, BenchMode::kLive) ||
                carried_out(kind.kind, BenchMode::kLockstep))
        << "planned means done somewhere";
  }
  EXPECT_EQ(planned, done_somewhere);
  EXPECT_GE(planned, 77u);
}

TEST(FaultPlan, ASignalIsNamedByItsMessageAndItsNumber) {
  scenario::Fault fault = row("signal_offset", 5.0);
  EXPECT_TRUE(is_refused_there(fault)) << "of which message?";
  fault.can_id = 1300;
  fault.unit = 3;
  const auto plan = plan_faults({fault}, 1);
  ASSERT_TRUE(plan) << to_string(plan.error());
  EXPECT_EQ(plan->frames.at(0).unit, 3);
  EXPECT_EQ(plan->frames.at(0).value, 5.0);
  fault.unit = 4;
  EXPECT_TRUE(is_refused_there(fault));
  fault.unit = 3;
  fault.value = kUnset;
  EXPECT_TRUE(is_refused_there(fault)) << "by how much?";
}

TEST(FaultPlan, OnlyTheComputersOwnFramesCanBeMasqueraded) {
  scenario::Fault fault = row("masquerade");
  EXPECT_TRUE(is_refused_there(fault));
  fault.can_id = 1303;
  EXPECT_TRUE(is_refused_there(fault));
  fault.can_id = 1402;
  EXPECT_TRUE(plan_faults({fault}, 1));
}

TEST(FaultPlan, WhatABenchCannotCarryOutItRefusesByPlaceAndName) {
  for (const auto& kind : faults::kBenchFaults)
    for (const BenchMode mode : {BenchMode::kLockstep, BenchMode::kLive}) {
      const auto problem = refused_by(mode, {row("drop"), row(std::string(kind.name))});
      EXPECT_EQ(problem.has_value(), !carried_out(kind.kind, mode)) << kind.name;
      if (!problem) continue;
      EXPECT_EQ(problem->place, "file.yaml:9:5");
      EXPECT_NE(problem->what.find(kind.name), std::string::npos);
      EXPECT_EQ(problem->what.find("--live") != std::string::npos,
                carried_out(kind.kind, BenchMode::kLive));
    }
  EXPECT_TRUE(carried_out(faults::BenchFaultKind::kBaseKilled, BenchMode::kLockstep));
  EXPECT_FALSE(carried_out(faults::BenchFaultKind::kClockStep, BenchMode::kLockstep));
  for (const auto kind :
       {faults::BenchFaultKind::kBaseMoved, faults::BenchFaultKind::kBaseReplaced}) {
    EXPECT_TRUE(carried_out(kind, BenchMode::kLockstep));
    EXPECT_FALSE(carried_out(kind, BenchMode::kLive)) << "its base has one address";
  }
}

TEST(FaultPlan, AShareOfTheTimeIsBetweenNothingAndAll) {
  for (const double share : {0.01, 0.5, 0.99})
    EXPECT_EQ(refusal(row("computer_slow", share)), "") << share;
  for (const double share : {-0.5, 0.0, 1.0, 2.0, kUnset})
    EXPECT_NE(refusal(row("computer_slow", share)), "") << share;
}

TEST(FaultPlan, EveryKindOfFrameFaultIsPlanned) {
  for (std::size_t i = 0; i < faults::kFrameFaultKinds; ++i) {
    const auto kind = static_cast<FrameFaultKind>(i);
    const auto plan = plan_faults({row(std::string(faults::name_of(kind)))}, 1);
    using enum FrameFaultKind;
    const bool names_what = kind == kMasquerade || kind == kSignalOffset || kind == kSignalDrift ||
                            kind == kSignalNoise || kind == kSignalSet;
    ASSERT_EQ(static_cast<bool>(plan), !names_what) << faults::name_of(kind);
    if (names_what) continue;  // refused without the message
    ASSERT_EQ(plan->frames.size(), 1u);
    EXPECT_EQ(plan->frames[0].kind, kind);
    EXPECT_FALSE(plan->frames[0].id.has_value()) << "no id means every id";
    EXPECT_EQ(plan->frames[0].start, Instant{} + seconds(3));
    EXPECT_EQ(plan->frames[0].duration, seconds(2));
  }
}

TEST(FaultPlan, TheOneNumberOfARowMeansWhatItsKindSays) {
  const auto planned = [](const char* kind, double value) {
    scenario::Fault fault = row(kind, value);
    fault.can_id = 1303;
    const auto plan = plan_faults({fault}, 1);
    EXPECT_TRUE(plan) << kind;
    return plan->frames.at(0);
  };
  EXPECT_EQ(planned("drop", 0.25).probability, 0.25);
  EXPECT_EQ(planned("drop", 0.25).id, 1303u);
  EXPECT_EQ(planned("duplicate", 0.25).probability, 0.25);
  EXPECT_EQ(planned("delay", 0.25).delay, milliseconds(250));
  EXPECT_EQ(planned("bit_flip", 3).count, 3u);
  EXPECT_EQ(planned("counter_jump", 3).count, 3u);
}

TEST(FaultPlan, ANumberThatMakesNoSenseIsRefusedWithItsPlace) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  struct Case {
    const char* kind;
    std::vector<double> values;
  };
  const std::vector<Case> cases{{"drop", {-0.1, 1.1, kInfinity}},
                                {"drop_burst", {-0.1, 2}},
                                {"duplicate", {-1, 1.5}},
                                {"delay", {-0.1, 1.1}},
                                {"bit_flip", {0, -1, 2.5, 65, kInfinity}},
                                {"counter_jump", {0, 0.5}},
                                {"drop_all", {1}},
                                {"stuck_counter", {1}},
                                {"gnss_unit_outage", {1}},
                                {"bus_silent", {1}},
                                {"low_grip", {-1, 0, kUnset, 3}},
                                {"cold_tyres", {-21, 151, kUnset}},
                                {"imu_bias", {kUnset, kInfinity}},
                                {"wheel_speed_loss", {1}},
                                {"fuel_out", {1}},
                                {"brake_leak", {-0.5, 1.5, kUnset}},
                                {"brake_stuck", {-1, 9001, kUnset}},
                                {"brake_circuit_lost", {0.5}},
                                {"steering_slow", {-1, 0, kUnset}},
                                {"gnss_variance_spike", {0, -5, kUnset}},
                                {"gnss_position_jump", {kUnset, kInfinity}},
                                {"flags_late", {0, -1, 61, kUnset}},
                                {"wrong_round_speed", {-1, kUnset}}};
  for (const Case& c : cases)
    for (const double value : c.values)
      EXPECT_TRUE(is_refused_there(row(c.kind, value))) << c.kind << " " << value;
}

TEST(FaultPlan, WhatAKindDoesNotHaveIsRefusedRatherThanIgnored) {
  EXPECT_TRUE(is_refused_there(row("earthquake")));
  EXPECT_TRUE(is_refused_there(row("")));

  scenario::Fault fault = row("gnss_unit_outage");
  fault.unit = 1;
  EXPECT_EQ(refusal(fault), "");
  fault.unit = 2;
  EXPECT_TRUE(is_refused_there(fault)) << "the car has two units";

  fault = row("brake_circuit_lost");
  fault.unit = 1;
  EXPECT_EQ(refusal(fault), "");
  fault.unit = 2;
  EXPECT_TRUE(is_refused_there(fault)) << "the car has two circuits";

  for (const char* kind : {"bus_silent", "drop"}) {
    fault = row(kind);
    fault.unit = 1;
    EXPECT_TRUE(is_refused_there(fault)) << kind << " has no units";
  }
  fault = row("steering_stuck");
  fault.can_id = 1303;
  EXPECT_TRUE(is_refused_there(fault)) << "a model has no identifier";
}

TEST(FaultPlan, EachRowHasItsOwnRandomNumbers) {
  std::vector<scenario::Fault> rows;
  for (int i = 0; i < 5; ++i) {
    rows.push_back(row("drop", 0.5));
    rows.push_back(row("gnss_rtk_lost"));
  }
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto plan = plan_faults(rows, seed);
    ASSERT_TRUE(plan);
    for (const auto& fault : plan->frames) seeds.insert(fault.seed);
    for (const auto& fault : plan->models) seeds.insert(fault.seed);
  }
  EXPECT_EQ(seeds.size(), 30u);
}

TEST(FaultPlan, ThereIsALimit) {
  std::vector<scenario::Fault> rows(faults::kMaxFrameFaults, row("drop_all"));
  EXPECT_TRUE(plan_faults(rows, 1));
  rows.push_back(row("drop_all"));
  EXPECT_FALSE(plan_faults(rows, 1));
}

TEST(FaultPlan, RaysMeetNoDustOfANumber) {
  scenario::Scenario s;
  s.faults = {row("camera_outage"), row("dust", 5.0)};
  for (const scenario::LidarKind kind :
       {scenario::LidarKind::kModel, scenario::LidarKind::kMeasured}) {
    s.lidars = kind;
    EXPECT_FALSE(dust_in_rays(s));
  }
  for (const scenario::LidarKind kind :
       {scenario::LidarKind::kRays, scenario::LidarKind::kRaysClusters}) {
    s.lidars = kind;
    const auto problem = dust_in_rays(s);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->place, "file.yaml:9:5");
  }
  s.faults.pop_back();
  EXPECT_FALSE(dust_in_rays(s));
}

TEST(FaultPlan, UnitsOfSensorsThatSeeCarsAreThoseOfTheCar) {
  scenario::Fault fault = row("lidar_outage");
  fault.unit = 2;
  EXPECT_EQ(refusal(fault), "");
  fault.unit = 3;
  EXPECT_TRUE(is_refused_there(fault));
  fault.kind = "camera_outage";
  EXPECT_EQ(refusal(fault), "");
  fault.kind = "lidar_late";
  EXPECT_TRUE(is_refused_there(fault));
}

}  // namespace
}  // namespace pitwall::bench
