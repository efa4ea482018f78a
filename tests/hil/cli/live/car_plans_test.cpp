// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/car_plans.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hil/cli/live/shipped_scenario.hpp"

namespace pitwall::cli {
namespace {

RunOptions on_unix_bus() {
  RunOptions options;
  options.folder = "out/x";
  options.interface = "unix:/tmp/x/bus";
  options.record_folder = "out/record/";
  return options;
}

const bench::Member& member(const std::array<bench::Member, bench::kRoles>& members,
                            bench::Role role) {
  return members[static_cast<std::size_t>(role)];
}

std::string after(const std::vector<std::string>& command, const std::string& word) {
  const auto at = std::ranges::find(command, word);
  return at == command.end() || at + 1 == command.end() ? "" : *(at + 1);
}

TEST(CarPlans, AFileOfAnotherCarIsBesideOurs) {
  EXPECT_EQ(file_of("rival", "out/events.mcap"), "out/events.rival.mcap");
  EXPECT_EQ(file_of("rival", "events"), "events.rival");
  EXPECT_EQ(file_of("rival", "unix:/tmp/bus"), "unix:/tmp/bus.rival");
  EXPECT_EQ(file_of("rival", "out/record/"), "out/record.rival");
  EXPECT_EQ(file_of("rival", ""), "");
}

TEST(CarPlans, OneCarIsPlannedAsItIsAlone) {
  RunOptions options = on_unix_bus();
  options.bay = 2;
  const auto plans = plans_of(options, shipped("five_ghosts"));
  ASSERT_TRUE(plans) << to_string(plans.error());
  ASSERT_EQ(plans->size(), 1u) << "ghosts have no processes";
  EXPECT_TRUE(plans->front().base.empty());
  EXPECT_EQ(plans->front().cars_file, "");
  EXPECT_EQ(plans->front().report_port, bench::kReportPort + 2 * bench::kBayPorts);
  options.interface = "vcan0";
  EXPECT_TRUE(plans_of(options, shipped("five_ghosts")));
}

TEST(CarPlans, EachStackHasBusFolderAndBayAndOneBaseStationHasBoth) {
  const bench::Loaded two = shipped("two_stacks");
  const auto read = plans_of(on_unix_bus(), two);
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->size(), 2u);
  const bench::LivePlan &own = (*read)[0], &other = (*read)[1];
  EXPECT_EQ(own.interface, "unix:/tmp/x/bus");
  EXPECT_EQ(other.interface, "unix:/tmp/x/bus.compliant");
  EXPECT_EQ(own.folder, "out/x");
  EXPECT_EQ(other.folder, "out/x/compliant");
  EXPECT_EQ(other.report_port, own.report_port + bench::kBayPorts);
  EXPECT_NE(other.guardian_name, own.guardian_name);
  EXPECT_EQ(after(other.vehicle, "--car"), two.stacks[0].scenario.car_file);
  EXPECT_EQ(after(own.vehicle, "--record"), "out/record/");
  EXPECT_EQ(after(other.vehicle, "--record"), "out/record.compliant");

  EXPECT_EQ(own.base.size(), 1u) << "the program alone";
  EXPECT_TRUE(other.base.empty()) << "one process for both";
  const auto base = member(members_of(own), bench::Role::kBase).command;
  EXPECT_EQ(after(base, "--cars"), "out/x/cars.yaml");
  EXPECT_TRUE(member(members_of(other), bench::Role::kBase).command.empty());
  EXPECT_EQ(other.radio[0].onward, other.base_port) << "where that process listens to this car";
  const auto car = member(members_of(other), bench::Role::kCar).command;
  EXPECT_EQ(after(car, "--keys"), "out/x/compliant/keys/car.keys");
  EXPECT_EQ(std::ranges::count(car, "--no-base"), 0);
}

TEST(CarPlans, OnSocketCanTheNextCarHasTheNextInterface) {
  RunOptions options = on_unix_bus();
  options.interface = "vcan9";
  const auto plans = plans_of(options, shipped("two_stacks"));
  ASSERT_TRUE(plans) << to_string(plans.error());
  EXPECT_EQ((*plans)[0].interface, "vcan9");
  EXPECT_EQ((*plans)[1].interface, "vcan10");
  options.radio_port = 23'431;
  options.keys = "keys";
  ASSERT_FALSE(plans_of(options, shipped("two_stacks")));
  EXPECT_EQ(plans_of(options, shipped("two_stacks")).error().place, "--radio-port");
}

TEST(CarPlans, ABaseStationThatIsThereHearsEachAtItsPortWithItsKeys) {
  RunOptions options = on_unix_bus();
  options.radio_port = 23'431;
  options.keys = "out/x/keys";
  const auto plans = plans_of(options, shipped("two_stacks"));
  ASSERT_TRUE(plans) << to_string(plans.error());
  const bench::LivePlan &own = (*plans)[0], &other = (*plans)[1];
  EXPECT_TRUE(own.base.empty() && other.base.empty());
  EXPECT_EQ(own.cars_file, "");
  EXPECT_EQ(own.radio[0].onward, 23'431);
  EXPECT_EQ(other.radio[0].onward, 23'431 + bench::kBayPorts);
  EXPECT_EQ(own.keys, "out/x/keys");
  EXPECT_EQ(other.keys, "out/x/keys.compliant");
}

TEST(CarPlans, AMatchOfCarsThatCannotSeeIsRefused) {
  RunOptions options = on_unix_bus();
  const bench::Loaded match = shipped("matches/match_two_stacks");
  ASSERT_FALSE(plans_of(options, match));
  EXPECT_EQ(plans_of(options, match).error().place, "--sensors");
  options.sensors_file = std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/sensors/av21.yaml";
  EXPECT_TRUE(plans_of(options, match));
}

TEST(CarPlans, WhatIsOfOneCarIsRefusedForSeveral) {
  const bench::Loaded two = shipped("two_stacks");
  const auto refused = [&](auto change) {
    RunOptions options = on_unix_bus();
    change(options);
    const auto plans = plans_of(options, two);
    return plans ? std::string("planned") : plans.error().place;
  };
  EXPECT_EQ(refused([](RunOptions&) {}), "planned");
  EXPECT_EQ(refused([](RunOptions& o) { o.interface = "can"; }), "--interface");
  EXPECT_EQ(refused([](RunOptions& o) { o.interface = "vcan3"; }), "planned");
  EXPECT_EQ(refused([](RunOptions& o) { o.attach = true; }), "--attach");
  EXPECT_EQ(refused([](RunOptions& o) { o.radio_port = 23'431; }), "--radio-port");
  EXPECT_EQ(refused([](RunOptions& o) { o.bay = bench::kBaysMax - 2; }), "planned");
  EXPECT_EQ(refused([](RunOptions& o) { o.bay = bench::kBaysMax - 1; }), "cars");
}

}  // namespace
}  // namespace pitwall::cli
