// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/scenario_verb.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class ScenarioVerb : public ProgramRun {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    EXPECT_TRUE(transport::write_file(path(name), text));
    return path(name);
  }
};

TEST_F(ScenarioVerb, WrongUsageIsTold) {
  expect_refusal({"scenario"}, "subcommand");
  expect_refusal({"scenario", "forget", "x.yaml"}, "subcommand");
  expect_refusal({"scenario", "check"}, "FILE");
  expect_refusal({"scenario", "new"}, "FILE");
  expect_refusal({"scenario", "new", path("n.yaml"), "--duration", "3"}, "--duration");
  expect_refusal({"scenario", "list", path("nowhere")}, path("nowhere"));
}

TEST_F(ScenarioVerb, ANewScenarioIsAcceptedAndPasses) {
  const std::string made = path("my_run.yaml");
  const ProgramOutput written = run({"scenario", "new", made, "--duration", "30"});
  EXPECT_EQ(written.code, 0) << written.err;
  EXPECT_NE(written.out.find(made + " written"), std::string::npos);
  EXPECT_NE(text_of("my_run.yaml").find("name: \"my_run\"\n"), std::string::npos);
  const ProgramOutput checked = run({"scenario", "check", made});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_EQ(checked.out, made + ": ok\n");
  const ProgramOutput ran = run({"run", made});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_NE(ran.out.find("verdict: PASS"), std::string::npos) << ran.out;
}

TEST_F(ScenarioVerb, ANewScenarioNamesTheSchemaFromItsFolder) {
  const ProgramOutput written = run({"scenario", "new", path("n.yaml")});
  ASSERT_EQ(written.code, 0) << written.err;
  const std::string text = text_of("n.yaml"), key = "$schema=";
  const std::size_t at = text.find(key) + key.size();
  const std::string schema = text.substr(at, text.find('\n', at) - at);
  EXPECT_TRUE(std::filesystem::exists(path(schema))) << schema;
}

TEST_F(ScenarioVerb, WhatExistsIsNeverReplaced) {
  const std::string mine = file("mine.yaml", "my work\n");
  expect_refusal({"scenario", "new", mine}, "exists already");
  EXPECT_EQ(text_of("mine.yaml"), "my work\n");
  std::filesystem::create_symlink(path("nothing"), path("link.yaml"));
  expect_refusal({"scenario", "new", path("link.yaml")}, "exists already");
}

TEST_F(ScenarioVerb, WhatANewScenarioCannotNameIsToldAndNothingIsWritten) {
  expect_refusal({"scenario", "new", path("n.yaml"), "--track", "monza.yaml"}, "monza.yaml");
  EXPECT_FALSE(exists("n.yaml"));
  expect_refusal({"scenario", "new", "/nowhere/n.yaml"}, "/nowhere/n.yaml");
}

TEST_F(ScenarioVerb, EveryFileIsCheckedAndEachProblemHasItsPlace) {
  const std::string wrong = spoilt("yellow_flag.yaml", "kind: until", "kind: still");
  const std::string blind = spoilt("red_flag_stop.yaml", "signal: wall_gap_m", "signal: wall_gap");
  const std::string good = "hil/scenarios/launch.yaml";
  const ProgramOutput checked = run({"scenario", "check", wrong, good, blind});
  EXPECT_EQ(checked.code, 2);
  EXPECT_EQ(checked.out, good + ": ok\n");
  EXPECT_NE(checked.err.find(wrong + ":22:12: error: kind: \"still\" is not one of"),
            std::string::npos)
      << checked.err;
  EXPECT_NE(checked.err.find(blind + ":18:12: error: unknown signal \"wall_gap\""),
            std::string::npos)
      << checked.err;
}

TEST_F(ScenarioVerb, EveryShippedScenarioIsAccepted) {
  std::vector<std::string> words{"scenario", "check"};
  const std::string root = PITWALL_SOURCE_DIR;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root + "/hil/scenarios"))
    if (entry.path().extension() == ".yaml") words.push_back(entry.path().string());
  const ProgramOutput checked = run(words);
  EXPECT_EQ(checked.code, 0);
  EXPECT_EQ(checked.err, "");
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(checked.out, '\n')), words.size() - 2);
}

TEST_F(ScenarioVerb, AListNamesWhatItCannotRead) {
  const ProgramOutput ours = run({"scenario", "list"});
  EXPECT_EQ(ours.code, 0) << ours.err;
  EXPECT_NE(ours.out.find("hil/scenarios/faults/"), std::string::npos) << "in subfolders too";
  std::filesystem::create_directory(path("folder"));
  file("folder/good.yaml",
       transport::read_file(std::string{PITWALL_SOURCE_DIR} + "/hil/scenarios/launch.yaml")
           .value_or(""));
  file("folder/bad.yaml", "schema: 2\n");
  const ProgramOutput listed = run({"scenario", "list", path("folder")});
  EXPECT_EQ(listed.code, 2);
  EXPECT_NE(listed.out.find("launch"), std::string::npos);
  EXPECT_EQ(std::ranges::count(listed.out, '\n'), 2);
  EXPECT_NE(listed.err.find(path("folder/bad.yaml") + ":1:9"), std::string::npos) << listed.err;
}

}  // namespace
}  // namespace pitwall::cli
