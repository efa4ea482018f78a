// Matches of our car against a ghost, in lockstep with the full stack: every scenario of the folder
// holds what it expects, the same seed gives the same sheet, and race control shows our car what
// the judge calls.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/match_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

const std::string kMatches = kRoot + "/hil/scenarios/matches";

std::vector<std::string> match_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kMatches))
    files.push_back(entry.path().stem().string());
  std::ranges::sort(files);
  return files;
}

Result<Loaded, Problem> match_named(const std::string& name) {
  return load(kMatches + "/" + name + ".yaml", kRoot);
}

class MatchFile : public ::testing::TestWithParam<std::string> {};

TEST_P(MatchFile, EndsAsItExpects) {
  const auto loaded = match_named(GetParam());
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->scenario.name, GetParam()) << "a scenario is called as its file";
  ASSERT_TRUE(loaded->scenario.match);
  EXPECT_FALSE(loaded->scenario.match->expect.empty()) << "a match that expects nothing";
  const auto run = run_lockstep(*loaded, {});
  ASSERT_TRUE(run) << to_string(run.error());
  ASSERT_TRUE(run->match);
  for (std::size_t i = 0; i < run->match->attempts.size(); ++i)
    std::printf("%s\n", to_text(*run->match, i).c_str());
  EXPECT_GE(run->verdicts.size(), loaded->scenario.match->expect.size() + 1);
  for (const grading::Verdict& verdict : run->verdicts)
    EXPECT_TRUE(verdict.pass) << verdict.name << ": " << verdict.text << ": " << verdict.reason;
}

INSTANTIATE_TEST_SUITE_P(All, MatchFile, ::testing::ValuesIn(match_files()),
                         [](const auto& file) { return file.param; });

// Of the calls our car's bus carries each in both encodings, and its computer reads them.
TEST(MatchRun, ShowsOurCarItsRoleItsRoundSpeedAndWavingGreen) {
  const auto loaded = match_named("match_cut_in");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  std::vector<std::pair<world::TrackFlag, world::VehicleFlag>> read;
  const auto run = run_lockstep(
      *loaded, {.watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
        if (now < Instant{} + loaded->scenario.match->begins + seconds(1)) return;
        const auto& race = out.race_control;
        if (read.empty() || read.back() != std::pair{race.track, race.vehicle})
          read.emplace_back(race.track, race.vehicle);
        if (rig.flags().vehicle == world::VehicleFlag::kDefender) {
          EXPECT_EQ(rig.round_target_speed_mph(), 115.0);
        }
      }});
  ASSERT_TRUE(run) << to_string(run.error());
  using world::TrackFlag;
  using world::VehicleFlag;
  ASSERT_GE(read.size(), 2U);
  EXPECT_EQ(read[0], std::pair(TrackFlag::kGreen, VehicleFlag::kDefender));
  EXPECT_EQ(read[1], std::pair(TrackFlag::kWavingGreen, VehicleFlag::kDefender));
}

TEST(MatchRun, TheSameSeedGivesTheSameSheet) {
  std::string first;
  for (int i = 0; i < 2; ++i) {
    const auto loaded = match_named("match_early");
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    const auto run = run_lockstep(*loaded, {});
    ASSERT_TRUE(run) << to_string(run.error());
    const std::string sheet = to_json(*run->match);
    if (i == 1) {
      EXPECT_EQ(sheet, first);
    }
    first = sheet;
  }
}

TEST(MatchRun, AnExpectationThatTheMatchDoesNotMeetFails) {
  scenario::MatchPlan plan;
  plan.rival = "rival", plan.place = "m.yaml:3:1";
  plan.expect = {rules::Ending::kPassed, rules::Ending::kEarly};
  plan.result = "rival";
  RunResult result;
  result.match = race::MatchSheet{.names = {"own", "rival"}, .attempts = {}, .match = {}};
  race::AttemptRecord passed;
  passed.ending = rules::Ending::kPassed;
  result.match->attempts = {passed};
  judge_match(plan, result);
  ASSERT_EQ(result.verdicts.size(), 3U);
  EXPECT_TRUE(result.verdicts[0].pass);
  EXPECT_FALSE(result.verdicts[1].pass);
  EXPECT_NE(result.verdicts[1].reason.find("not made"), std::string::npos);
  EXPECT_FALSE(result.verdicts[2].pass);
  EXPECT_EQ(result.verdicts[2].name, "m.yaml:3:1");
}

}  // namespace
}  // namespace pitwall::bench
