// Every scenario file that is short enough, in lockstep: what it expects must hold.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "hil/bench/lockstep.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

constexpr Duration kLongest = seconds(210);  // the flying laps

Result<Loaded, Problem> load_scenario(const std::string& name) {
  return load(kRoot + "/hil/scenarios/" + name + ".yaml", kRoot);
}

// A longer one has a test of its own, and so has one that only the live bench can carry out
// (tests/system/live); one that does not load has to fail in the test. Asked at each start of this
// program, so without its car.
bool is_for_here(const std::string& name) {
  const auto text = transport::read_file(kRoot + "/hil/scenarios/" + name + ".yaml");
  const auto read = text ? scenario::read_scenario(*text, name) : Unexpected{text.error()};
  return !read || (read->duration <= kLongest && !refused_by(BenchMode::kLockstep, read->faults));
}

std::vector<std::string> scenario_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot + "/hil/scenarios"))
    if (entry.path().extension() == ".yaml" && is_for_here(entry.path().stem().string()))
      files.push_back(entry.path().stem().string());
  std::sort(files.begin(), files.end());
  return files;
}

class ScenarioFile : public ::testing::TestWithParam<std::string> {};

TEST_P(ScenarioFile, Holds) {
  const auto loaded = load_scenario(GetParam());
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->scenario.name, GetParam()) << "a scenario is called as its file";
  EXPECT_FALSE(loaded->scenario.expect.empty()) << "a run that expects nothing shows nothing";
  const auto run = run_lockstep(loaded->scenario, loaded->setup, {});
  ASSERT_TRUE(run) << to_string(run.error());
  EXPECT_EQ(run->verdicts.size(), loaded->scenario.expect.size());
  for (const grading::Verdict& verdict : run->verdicts)
    EXPECT_TRUE(verdict.pass) << verdict.name << ": " << verdict.text << ": " << verdict.reason;
}

INSTANTIATE_TEST_SUITE_P(All, ScenarioFile, ::testing::ValuesIn(scenario_files()),
                         [](const auto& file) { return file.param; });

// Every fault file must fail without its fault, or it would prove nothing about the fault: this is
// the test of the tests.
TEST(ScenarioFiles, AFaultThatDoesNotComeIsNoticed) {
  std::size_t with_faults = 0;
  std::set<std::string> blind;
  for (const std::string& name : scenario_files()) {
    auto loaded = load_scenario(name);
    ASSERT_TRUE(loaded);
    if (loaded->scenario.faults.empty()) continue;
    ++with_faults;
    loaded->scenario.faults.clear();
    const auto run = run_lockstep(loaded->scenario, loaded->setup, {});
    ASSERT_TRUE(run);
    if (run->passed()) blind.insert(name);
  }
  EXPECT_GE(with_faults, 10u);
  // What the car must shrug off looks the same without the fault.
  EXPECT_EQ(blind, (std::set<std::string>{"base_blink", "base_restarted_commands",
                                          "gnss_bytes_damaged", "gnss_one_unit_bad", "grip_low",
                                          "operator_emergency", "steering_slow_at_speed"}));
}

TEST(ScenarioFiles, AnOperatorWhoSaysNothingIsNoticed) {
  std::size_t with_words = 0;
  for (const std::string& name : scenario_files()) {
    auto loaded = load_scenario(name);
    ASSERT_TRUE(loaded);
    if (loaded->scenario.operator_words.empty()) continue;
    ++with_words;
    loaded->scenario.operator_words.clear();
    const auto run = run_lockstep(loaded->scenario, loaded->setup, {});
    ASSERT_TRUE(run);
    EXPECT_FALSE(run->passed()) << name;
  }
  EXPECT_GE(with_words, 4u);
}

}  // namespace
}  // namespace pitwall::bench
