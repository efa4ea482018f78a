// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

LivePlan plan() {
  LivePlan p;
  p.interface = "vcan7";
  p.vehicle = {"car", "--track", "oval"};
  p.folder = "out/x";
  p.guardian_name = "shared";
  return p;
}

const Member& member(const std::array<Member, kRoles>& members, Role role) {
  return members[static_cast<std::size_t>(role)];
}

bool says(const std::vector<std::string>& command, const std::string& word) {
  return std::ranges::find(command, word) != command.end();
}

std::string after(const std::vector<std::string>& command, const std::string& word) {
  const auto at = std::ranges::find(command, word);
  return at == command.end() || at + 1 == command.end() ? "" : *(at + 1);
}

TEST(LivePlan, OnlyTheFirstStartOfTheCarIsArmed) {
  LivePlan p = plan();
  p.guardian = {"guardian"};
  p.base = {"base"};
  const auto members = members_of(p);
  for (const Role role : {Role::kCar, Role::kGuardian, Role::kBase}) {
    EXPECT_EQ(says(member(members, role).command, "--arm"), role == Role::kCar);
    EXPECT_FALSE(says(member(members, role).restart, "--arm"));
    EXPECT_FALSE(member(members, role).restart.empty());
  }
  std::vector<std::string> first = member(members, Role::kCar).command;
  first.pop_back();
  EXPECT_EQ(first, member(members, Role::kCar).restart) << "else it is the same car";
}

TEST(LivePlan, EachHasReceiversAndASummaryOfItsOwn) {
  LivePlan p = plan();
  p.guardian = {"guardian"};
  const auto members = members_of(p);
  const auto& car = member(members, Role::kCar).command;
  const auto& guardian = member(members, Role::kGuardian).command;
  EXPECT_EQ(after(car, "--can"), "vcan7");
  EXPECT_EQ(after(guardian, "--can"), "vcan7");
  EXPECT_EQ(after(car, "--guardian"), "shared");
  EXPECT_EQ(after(guardian, "--guardian"), "shared");
  EXPECT_NE(after(car, "--gnss"), after(guardian, "--gnss"));
  EXPECT_NE(after(car, "--summary"), after(guardian, "--summary"));
  EXPECT_EQ(after(car, "--track"), "oval") << "what the caller gave stays";
}

TEST(LivePlan, WhoIsNotPlannedIsNotPlayed) {
  const auto members = members_of(plan());
  EXPECT_TRUE(member(members, Role::kGuardian).command.empty());
  EXPECT_TRUE(member(members, Role::kBase).command.empty());
  EXPECT_FALSE(says(member(members, Role::kCar).command, "--guardian"));
  LivePlan attached = plan();
  attached.vehicle.clear();
  EXPECT_TRUE(attached.attached());
  EXPECT_TRUE(member(members_of(attached), Role::kCar).command.empty());
}

TEST(LivePlan, WithABaseTheCarHasKeysAndAPathForEachRadio) {
  LivePlan p = plan();
  EXPECT_TRUE(says(member(members_of(p), Role::kCar).command, "--no-base"));
  EXPECT_FALSE(says(member(members_of(p), Role::kCar).command, "--keys"));
  p.base = {"base"};
  p.keys = "out/x/keys";
  p.paths = 2;
  p.has_operator = true;
  const auto members = members_of(p);
  const auto& car = member(members, Role::kCar).command;
  const auto& base = member(members, Role::kBase).command;
  EXPECT_FALSE(says(car, "--no-base"));
  EXPECT_EQ(after(car, "--keys"), "out/x/keys/car.keys");
  EXPECT_EQ(after(base, "--keys"), "out/x/keys/base.keys");
  EXPECT_EQ(std::ranges::count(car, "--radio"), 2);
  EXPECT_EQ(std::ranges::count(base, "--listen"), 2);
  EXPECT_EQ(after(base, "--command-socket"), "out/x/commands");
  EXPECT_EQ(after(car, "--local-report"), std::to_string(p.report_port));
  p.base.clear();
  p.radio[0].onward = 23'429;  // somebody else's base
  EXPECT_FALSE(says(member(members_of(p), Role::kCar).command, "--no-base"));
}

TEST(LivePlan, ABaseOfSeveralCarsHasTheirFileAndWhatEachHasAlone) {
  LivePlan p = plan();
  p.base = {"base"};
  p.keys = "keys";
  p.paths = 2;
  p.has_operator = true;
  p.clock = "/dev/shm/time";
  const StationCar car = station_car_of(p);
  const auto alone = member(members_of(p), Role::kBase).command;
  EXPECT_EQ(car.listen.size(), 2u);
  EXPECT_EQ(after(alone, "--listen"), car.listen[0]);
  EXPECT_EQ(after(alone, "--keys"), car.keys);
  EXPECT_EQ(after(alone, "--json"), car.json);
  EXPECT_EQ(after(alone, "--command-socket"), car.command_socket);
  p.cars_file = "out/x/cars.yaml";
  EXPECT_EQ(
      member(members_of(p), Role::kBase).command,
      (std::vector<std::string>{"base", "--cars", "out/x/cars.yaml", "--clock", "/dev/shm/time"}));
}

TEST(LivePlan, SummariesGoToTheDiskThatFillsUp) {
  LivePlan p = plan();
  EXPECT_EQ(after(member(members_of(p), Role::kCar).command, "--summary"), "out/x/vehicle.json");
  p.disk = "out/x/disk";
  EXPECT_EQ(after(member(members_of(p), Role::kCar).command, "--summary"),
            "out/x/disk/vehicle.json");
}

TEST(LivePlan, BaysOfOneMachineShareNoPortAndNoMemory) {
  LivePlan first = plan();
  first.guardian = {"guardian"};
  first.base = {"base"};
  first.paths = 2;
  first.has_operator = true;
  std::vector<std::string> taken;
  for (int bay = 0; bay < kBaysMax; ++bay) {
    const LivePlan p = in_bay(first, bay);
    taken.push_back(p.guardian_name);
    for (const int port : {int{p.gnss_port}, p.gnss_port + 1, int{p.guardian_gnss_port},
                           p.guardian_gnss_port + 1, int{p.base_port}, int{p.second_base_port},
                           int{p.report_port}, int{p.radio[0].listen}, int{p.radio[1].listen}}) {
      taken.push_back(std::to_string(port));
    }
  }
  std::ranges::sort(taken);
  EXPECT_EQ(std::ranges::adjacent_find(taken), taken.end());
  EXPECT_EQ(in_bay(first, 0).report_port, first.report_port);
}

TEST(LivePlan, SensorsOfABayAreInARosDomainOfTheirOwn) {
  const auto folder = transport::TemporaryFolder::create("pitwall-live-plan-");
  ASSERT_TRUE(folder);
  const std::string file = folder->path() + "/sensors.yaml";
  ASSERT_TRUE(transport::write_file(
      file, "domain: 7\nsensors: [{name: a, topic: /a, type: Imu, rate_hz: 9}]\n"));
  LivePlan p = plan();
  EXPECT_FALSE(add_sensors(p, ""));
  EXPECT_FALSE(says(member(members_of(p), Role::kCar).command, "--sensors"));
  EXPECT_FALSE(add_sensors(p, file));
  EXPECT_EQ(after(member(members_of(p), Role::kCar).command, "--sensors"), file);
  for (int bay = 0; bay < kBaysMax; ++bay)
    EXPECT_EQ(after(member(members_of(in_bay(p, bay)), Role::kCar).command, "--sensors-domain"),
              std::to_string(7 + bay));
  const auto none = add_sensors(p, folder->path() + "/none.yaml");
  ASSERT_TRUE(none);
}

TEST(LivePlan, AllLiveByTheTimeOfTheBenchOrByTheWallClock) {
  LivePlan p = plan();
  p.guardian = {"guardian"};
  p.base = {"base"};
  for (const char* const clock : {"", "/dev/shm/time"}) {
    p.clock = clock;
    for (const Member& one : members_of(p)) {
      EXPECT_EQ(after(one.command, "--clock"), clock);
      EXPECT_EQ(after(one.restart, "--clock"), clock);
    }
  }
}

}  // namespace
}  // namespace pitwall::bench
