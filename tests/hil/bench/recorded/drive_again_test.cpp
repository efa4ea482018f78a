// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/drive_again.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "hil/bench/recorded/comparison.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"
#include "vehicle/parameters/car_setup.hpp"
#include "vehicle/raceline/bank_builder.hpp"
#include "vehicle/raceline/bank_file.hpp"

namespace pitwall::bench {
namespace {

Comparison compared(const RunFiles& files, std::vector<std::string>& remarks,
                    const CompareRules& rules = {}) {
  Comparison out{own_database(), rules};
  auto run = RecordedRun::open(recorded_folder());
  const auto setup = setup_of(*run, files, remarks);
  EXPECT_TRUE(setup) << to_string(setup.error());
  DriveAgain car{*setup};
  while (true) {
    const auto tick = run->next();
    EXPECT_TRUE(tick) << to_string(tick.error());
    if (!tick || !*tick) return out;
    const auto again = car.tick(**tick);
    EXPECT_TRUE(again) << to_string(again.error());
    out.add(**tick, *again, car.measured());
  }
}

// The car file with one text in place of another.
std::string changed_car(const transport::TemporaryFolder& folder, const std::string& from,
                        const std::string& to) {
  std::string text = pipeline::testing::text_of("vehicle/config/cars/av21.yaml");
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::string path = folder.path() + "/car.yaml";
  std::ofstream{path} << text;
  return path;
}

TEST(DriveAgain, TheSameBuildSaysTheSameToTheBit) {
  std::vector<std::string> remarks;
  const Comparison same = compared({}, remarks);
  EXPECT_EQ(same.ticks(), kDrivenTicks);
  EXPECT_GT(same.frames(), kDrivenTicks);
  EXPECT_GT(same.values(), 20'000U);
  EXPECT_TRUE(same.differences().empty()) << same.differences()[0].signal;
  EXPECT_TRUE(remarks.empty()) << remarks[0];
  // Some tens of fields are the process's own, and none of what the car decides.
  EXPECT_GT(same.measured().count(), 20U);
  for (const auto decided : {telemetry::field("ego.vx"), telemetry::field("mode.mode"),
                             telemetry::field("command.brake"), telemetry::field("track.station")})
    EXPECT_FALSE(same.measured().test(decided));
}

TEST(DriveAgain, ACommentIsNoDifferenceAndIsToldAsAnotherFile) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-again-");
  std::vector<std::string> remarks;
  const std::string car = changed_car(folder, "control:", "# a comment\ncontrol:");
  EXPECT_TRUE(compared({.car = car, .track = {}}, remarks).differences().empty());
  EXPECT_EQ(remarks,
            (std::vector<std::string>{car + ": not the file that the run was driven with"}));
}

TEST(DriveAgain, AFileThatTheCarFileIsLikeBelongsToIt) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-again-");
  const std::string base = changed_car(folder, "name: AV-21", "name: AV-21");
  const std::string car = folder.path() + "/race.yaml";
  const std::string like = base.substr(base.rfind('/') + 1);
  ASSERT_TRUE(transport::write_file(car, "schema: 1\nlike: " + like + "\n"));
  {
    RecordedDrive{folder.path() + "/run",
                  {.car = car, .track = RecordedDrive::path_of("tracks/lvms.yaml")}};
  }
  std::vector<std::string> remarks;
  const auto setup_again = [&] {
    return setup_of(*RecordedRun::open(folder.path() + "/run"), {}, remarks);
  };
  EXPECT_TRUE(setup_again());
  EXPECT_TRUE(remarks.empty());
  ASSERT_EQ(changed_car(folder, "control:", "# a comment\ncontrol:"), base);
  EXPECT_TRUE(setup_again());
  EXPECT_EQ(remarks,
            (std::vector<std::string>{car + ": not the file that the run was driven with"}));
}

TEST(DriveAgain, TheBankIsThatOfTheRunOrLiesBesideTheCarFile) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-again-");
  const std::string car =
      changed_car(folder, "    offset_m: 0.0\n", "    bank: lines.json\n    name: inner/apex\n");
  const std::string kept = folder.path() + "/kept.json", beside = folder.path() + "/lines.json";
  const world::TrackDescription& track = pipeline::testing::las_vegas();
  const std::string bank = raceline::to_json(
      *raceline::build_bank(track, *world::TrackMap::build(track),
                            parameters::bank_for(pipeline::testing::av21_file().params)));
  ASSERT_TRUE(transport::write_file(kept, bank));
  {
    RecordedDrive{folder.path() + "/run",
                  {.car = car, .track = RecordedDrive::path_of("tracks/lvms.yaml"), .bank = kept}};
  }
  std::vector<std::string> remarks;
  const auto setup_from = [&](const std::string& recording, const RunFiles& files) {
    return setup_of(*RecordedRun::open(recording), files, remarks);
  };
  EXPECT_EQ(setup_from(folder.path() + "/run", {})->line.number, 4U);
  EXPECT_TRUE(remarks.empty());
  ASSERT_TRUE(transport::write_file(kept, bank + "\n"));
  EXPECT_EQ(setup_from(folder.path() + "/run", {})->line.number, 4U);
  EXPECT_EQ(remarks,
            (std::vector<std::string>{kept + ": not the file that the run was driven with"}));
  // A run that had no bank, with this car file.
  const auto missing = setup_from(recorded_folder(), {.car = car, .track = {}});
  ASSERT_FALSE(missing);
  EXPECT_NE(to_string(missing.error()).find(beside), std::string::npos);
  ASSERT_TRUE(transport::write_file(beside, bank));
  EXPECT_EQ(setup_from(recorded_folder(), {.car = car, .track = {}})->line.number, 4U);
}

TEST(DriveAgain, AParameterThatChangedIsFoundWithSignalAndTick) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-again-");
  std::vector<std::string> remarks;
  const std::string car =
      changed_car(folder, "antenna_m: [0.758, -0.497, 0.109]", "antenna_m: [0.758, -0.447, 0.109]");
  const auto differences = compared({.car = car, .track = {}}, remarks).differences();
  ASSERT_FALSE(differences.empty());
  const auto y = std::ranges::find(differences, "ego.y", &SignalDifference::signal);
  ASSERT_NE(y, differences.end()) << differences[0].signal;
  EXPECT_LT(y->first.tick, kDrivenTicks / 2) << "as soon as both receivers are used";
  EXPECT_GT(y->largest.size(), 0.0);
  EXPECT_LT(y->largest.size(), 0.05) << "the antenna was moved by so much";
}

TEST(DriveAgain, RefusesATickThatNoCarCanHaveHad) {
  DriveAgain car{pipeline::testing::setup()};
  RecordedTick tick;
  tick.now = pipeline::testing::kStart;
  tick.given.stop = 9;
  const auto refused = car.tick(tick);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "stop");
  tick.given = {};
  for (const std::uint8_t byte : {std::uint8_t{1}, std::uint8_t{2}})
    ASSERT_TRUE(tick.given.commands.push(byte));
  EXPECT_EQ(car.tick(tick).error().place, "commands");
}

}  // namespace
}  // namespace pitwall::bench
