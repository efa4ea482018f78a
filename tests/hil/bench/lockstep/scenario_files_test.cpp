// Every scenario file that is short enough, in lockstep: what it expects must hold.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

constexpr Duration kLongest = seconds(210);  // the flying laps

Result<Loaded, Problem> load_scenario(const std::string& name) {
  return load(kRoot + "/hil/scenarios/" + name + ".yaml", kRoot);
}

// A longer one has a test of its own, and so has one that only the live bench can carry out
// (tests/system/live); one that does not load has to fail in the test.
bool is_for_here(const Result<scenario::Scenario, Problem>& read) {
  return !read || (read->duration <= kLongest && !refused_by(BenchMode::kLockstep, read->faults));
}

// Asked at each start of this program, so without its car.
Result<scenario::Scenario, Problem> read_alone(const std::string& name) {
  const auto text = transport::read_file(kRoot + "/hil/scenarios/" + name + ".yaml");
  return text ? scenario::read_scenario(*text, name) : Unexpected{text.error()};
}

struct LockstepFiles {
  std::vector<std::string> all, with_faults;
};

const LockstepFiles& lockstep_files() {
  static const LockstepFiles found = [] {
    LockstepFiles files;
    for (const auto& entry : std::filesystem::directory_iterator(kRoot + "/hil/scenarios")) {
      if (entry.path().extension() != ".yaml") continue;
      const std::string name = entry.path().stem().string();
      const auto read = read_alone(name);
      if (!is_for_here(read)) continue;
      files.all.push_back(name);
      if (read && !read->faults.empty()) files.with_faults.push_back(name);
    }
    std::ranges::sort(files.all), std::ranges::sort(files.with_faults);
    return files;
  }();
  return found;
}

class ScenarioFile : public ::testing::TestWithParam<std::string> {};

TEST_P(ScenarioFile, Holds) {
  const auto loaded = load_scenario(GetParam());
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->scenario.name, GetParam()) << "a scenario is called as its file";
  EXPECT_FALSE(loaded->scenario.expect.empty()) << "a run that expects nothing shows nothing";
  const auto run = run_lockstep(*loaded, {});
  ASSERT_TRUE(run) << to_string(run.error());
  const auto not_judged = std::ranges::count_if(run->remarks, [](const std::string& remark) {
    return remark.starts_with("not judged, the car hit a wall before: ");
  });
  EXPECT_EQ(run->verdicts.size() + static_cast<std::size_t>(not_judged),
            loaded->scenario.expect.size() + (loaded->scenario.contact ? 1U : 0U) +
                (loaded->scenario.cars.empty() ? 0U : 1U));
  EXPECT_TRUE(loaded->scenario.contact.has_value() == has_contact(run->outcome))
      << "a contact that is named comes, and none comes that is not named";
  for (const grading::Verdict& verdict : run->verdicts)
    EXPECT_TRUE(verdict.pass) << verdict.name << ": " << verdict.text << ": " << verdict.reason;
}

INSTANTIATE_TEST_SUITE_P(All, ScenarioFile, ::testing::ValuesIn(lockstep_files().all),
                         [](const auto& file) { return file.param; });

// What has failed for good stays failed: the rest of the run says nothing more.
RunResult until_it_fails(const Loaded& loaded) {
  const auto failed = [](const RunView& run) {
    return (run.now - Instant{}).ns % seconds(1).ns == 0 &&
           std::ranges::count(run.grader.expectation_states(), grading::ExpectationState::kFailed) >
               0;
  };
  auto run = run_lockstep(loaded, {.over = failed});
  if (!run) ADD_FAILURE() << to_string(run.error());
  return run ? *std::move(run) : RunResult{};
}

// Those of which the car must shrug the fault off: without it they look the same.
const std::set<std::string> kShrugged{
    "base_blink", "base_restarted_commands", "gnss_bytes_damaged",    "gnss_one_unit_bad",
    "grip_low",   "operator_emergency",      "steering_slow_at_speed"};

// Every fault file must fail without its fault, or it would prove nothing about the fault: this is
// the test of the tests.
class FaultFile : public ::testing::TestWithParam<std::string> {};

TEST_P(FaultFile, WithoutItsFaultItFails) {
  auto loaded = load_scenario(GetParam());
  ASSERT_TRUE(loaded);
  loaded->scenario.faults.clear();
  EXPECT_EQ(until_it_fails(*loaded).passed(), kShrugged.contains(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(All, FaultFile, ::testing::ValuesIn(lockstep_files().with_faults),
                         [](const auto& file) { return file.param; });

TEST(ScenarioFiles, FaultFilesAreSeveralAndTheShruggedOnesAmongThem) {
  const std::vector<std::string>& files = lockstep_files().with_faults;
  EXPECT_GE(files.size(), 10u);
  for (const std::string& name : kShrugged) EXPECT_EQ(std::ranges::count(files, name), 1) << name;
}

TEST(ScenarioFiles, AnOperatorWhoSaysNothingIsNoticed) {
  std::size_t with_words = 0;
  for (const std::string& name : lockstep_files().all) {
    auto loaded = load_scenario(name);
    ASSERT_TRUE(loaded);
    if (loaded->scenario.operator_texts.empty()) continue;
    ++with_words;
    loaded->scenario.operator_texts.clear();
    EXPECT_FALSE(until_it_fails(*loaded).passed()) << name;
  }
  EXPECT_GE(with_words, 4u);
}

}  // namespace
}  // namespace pitwall::bench
