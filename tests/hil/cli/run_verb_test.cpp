// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/run_verb.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hil/can_bus/bus_options.hpp"
#include "hil/can_bus/line_relay.hpp"
#include "hil/cli/live/clock_place.hpp"
#include "hil/cli/live/programs.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

const std::string kLaunchAndStop = "hil/scenarios/launch_and_stop.yaml";

class RunVerb : public ProgramRun {};

TEST_F(RunVerb, WrongUsageIsTold) {
  expect_refusal({}, "pitwall-hil VERB");
  expect_refusal({"rum", kLaunchAndStop}, "unknown verb \"rum\"");
  expect_refusal({"run"}, "scenario");
  expect_refusal({"run", kLaunchAndStop, "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"run", kLaunchAndStop, "second.yaml"}, "second.yaml");
  expect_refusal({"run", kLaunchAndStop, "--duration", "soon"}, "soon");
  expect_refusal({"run", kLaunchAndStop, "--duration", "-1"}, "--duration");
  expect_refusal({"run", kLaunchAndStop, "--duration"}, "--duration");
  expect_refusal({"run", kLaunchAndStop, "--seed", "-1"}, "--seed");
  expect_refusal({"run", kLaunchAndStop, "--radio-port", "70000"}, "--radio-port");
  expect_refusal({"run", kLaunchAndStop, "--radio-port", "-1"}, "--radio-port");
}

TEST_F(RunVerb, HelpIsNoError) {
  for (const auto& words : {std::vector<std::string>{"--help"}, {"help"}, {"run", "--help"}}) {
    const ProgramOutput output = run(words);
    EXPECT_EQ(output.code, 0);
    EXPECT_NE(output.out.find("run"), std::string::npos);
    EXPECT_EQ(output.err, "");
  }
}

TEST_F(RunVerb, ABadScenarioIsToldWithItsPlaceAndNothingIsStarted) {
  const std::string bad = spoilt("launch_and_stop.yaml", "seed: 11", "seed: eleven");
  for (const bool live : {false, true}) {
    std::vector<std::string> words{"run", bad, "--json", path("r.json"), "--log", path("l.mcap")};
    if (live) words.insert(words.end(), {"--live", "--out", path("live")});
    expect_refusal(words, bad + ":4:7: error: ");
    EXPECT_FALSE(exists("r.json"));
    EXPECT_FALSE(exists("l.mcap"));
    EXPECT_FALSE(exists("live"));
  }
  expect_refusal({"run", path("none.yaml")}, path("none.yaml"));
  expect_refusal({"run", path("none.yaml"), "--live"}, path("none.yaml"));
}

TEST_F(RunVerb, ALiveMatchOfCarsThatCannotSeeIsRefusedBeforeAnythingIsStarted) {
  const std::string match = "hil/scenarios/matches/match_early.yaml";
  expect_refusal({"run", match, "--live", "--out", path("live")}, "--sensors: error: missing");
  EXPECT_FALSE(exists("live"));
}

TEST_F(RunVerb, WhatTheBenchDoesNotKnowIsToldWithItsPlace) {
  const std::string signal = spoilt("red_flag_stop.yaml", "signal: wall_gap_m", "signal: wall_gap");
  expect_refusal({"run", signal}, signal + ":");
  const std::string fault = spoilt("bus_silent.yaml", "kind: bus_silent", "kind: bus_sulks");
  expect_refusal({"run", fault}, "bus_sulks");
}

TEST_F(RunVerb, AFileThatCannotBeWrittenIsAFailureOfTheBench) {
  expect_refusal({"run", kLaunchAndStop, "--log", path("no/such/folder/l.mcap")}, "no/such/folder");
  const ProgramOutput output =
      run({"run", kLaunchAndStop, "--json", path("no/such/folder/r.json")});
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("no/such/folder"), std::string::npos);
}

TEST_F(RunVerb, APassIsZero) {
  const ProgramOutput output =
      run({"run", kLaunchAndStop, "--json", path("r.json"), "--log", path("l.mcap")});
  EXPECT_EQ(output.code, 0) << output.out << output.err;
  EXPECT_NE(output.out.find("verdict: PASS"), std::string::npos);
  EXPECT_NE(output.out.find("SIMULATION"), std::string::npos);
  EXPECT_GT(text_of("l.mcap").size(), 1'000'000u);
  const auto json = yaml::load_file(path("r.json"));
  ASSERT_TRUE(json) << to_string(json.error());
  EXPECT_TRUE(json->root().flag("passed"));
  EXPECT_NE(output.out.find(json->root().text("sha256")), std::string::npos);
}

// The test of the grader: an expectation that cannot hold is neither a pass nor a broken bench.
TEST_F(RunVerb, AFailedExpectationIsOne) {
  const std::string fails =
      spoilt("launch_and_stop.yaml", "expect:\n",
             "expect:\n  - {kind: always, signal: speed_mps, is: \"<\", value: 5}\n");
  const ProgramOutput output = run({"run", fails, "--json", path("r.json")});
  EXPECT_EQ(output.code, 1) << output.out << output.err;
  EXPECT_NE(output.out.find("FAIL  always speed_mps < 5"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("verdict: FAIL"), std::string::npos);
  const auto json = yaml::load_file(path("r.json"));
  ASSERT_TRUE(json);
  EXPECT_FALSE(json->root().flag("passed"));
}

TEST_F(RunVerb, AWallEndsTheRunAndIsFour) {
  const std::string unnamed = spoilt("steering_stuck.yaml", "contact:", "#contact:");
  const ProgramOutput output = run({"run", unnamed, "--report", path("report")});
  EXPECT_EQ(output.code, 4) << output.out << output.err;
  const ProgramOutput again = run({"run", unnamed, "--json", path("r.json")});
  EXPECT_NE(again.out.find("verdict: CONTACT"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("CONTACT: the car hit the wall on the "), std::string::npos);
  EXPECT_NE(again.out.find("not judged, the car hit a wall before: "), std::string::npos);
  const auto json = yaml::load_file(path("r.json"));
  ASSERT_TRUE(json);
  EXPECT_FALSE(json->root().flag("passed"));
  EXPECT_TRUE(json->root().flag("failed_by_contact"));
  EXPECT_LT(json->root().number("simulated_s", 0, 100), 60.0);
  EXPECT_NE(text_of("report/report.html").find("CONTACT"), std::string::npos);
  EXPECT_NE(text_of("report/junit.xml").find("<failure message=\"CONTACT: "), std::string::npos);
  EXPECT_EQ(run({"run", spoilt("steering_stuck.yaml", "at_most_mps: 64", "at_most_mps: 5")}).code,
            4);
}

// A car that stands on our line: nothing avoids it yet.
TEST_F(RunVerb, AContactWithACarThatOursCausesIsFourAndOnThePageOfTheReport) {
  const std::string parked =
      spoilt("five_ghosts.yaml", "cars:\n",
             "cars:\n  - {name: parked, number: 9, kind: ghost, start: {s_m: 150, speed_mps: 0}, "
             "offset_m: 0, speed: {mps: 0}}\n");
  const ProgramOutput output = run({"run", parked, "--report", path("report")});
  EXPECT_EQ(output.code, 4) << output.out << output.err;
  const std::string html = text_of("report/report.html");
  for (const char* part :
       {"<title>five_ghosts CONTACT</title>", "Contact with another car",
        "<dt>caused by</dt><dd>this car</dd>", "rule 1: a car that stood causes nothing",
        "parked (number 9)", "data-plot=\"contact\""})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("data-absent=\"contact\""), std::string::npos);
}

TEST_F(RunVerb, ARunThatEndsTooEarlyToShowAnythingDoesNotPass) {
  const ProgramOutput output = run({"run", kLaunchAndStop, "--duration", "5"});
  EXPECT_NE(output.code, 0);
  EXPECT_EQ(output.out.find("verdict: PASS"), std::string::npos);
}

TEST_F(RunVerb, OfARunThatIsCutTheRestIsNotJudgedAndTold) {
  const ProgramOutput output = run({"run", kLaunchAndStop, "--duration", "5", "--cut"});
  EXPECT_EQ(output.code, 0) << output.out << output.err;
  EXPECT_NE(output.out.find("not judged, the run is cut at 5.0 s: " + std::string(kLaunchAndStop)),
            std::string::npos);
  EXPECT_NE(output.out.find("verdict: PASS"), std::string::npos);
  expect_refusal({"run", kLaunchAndStop, "--cut"}, "--duration");
}

TEST_F(RunVerb, AReactionThatMightStillComeIsNotJudgedUnlessTheRunIsWhole) {
  const auto judged = [&](const char* duration_s) {
    const ProgramOutput output =
        run({"run", "hil/scenarios/operator_stop.yaml", "--duration", duration_s, "--cut"});
    EXPECT_EQ(output.code, 0) << output.out << output.err;
    return output.out.find("PASS  after mode == 3") != std::string::npos;
  };
  EXPECT_FALSE(judged("40"));
  EXPECT_TRUE(judged("70")) << "it has 70 s";
}

TEST_F(RunVerb, SeedAndDurationAreThoseOfTheLine) {
  const auto digest = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"run", "hil/scenarios/lvms_flying_lap.yaml", "--cut", "--json",
                                   path("r.json")};
    words.insert(words.end(), more.begin(), more.end());
    (void)run(words);
    const auto json = yaml::load_file(path("r.json"));
    return json ? json->root().text("sha256") : "none";
  };
  const std::string plain = digest({"--duration", "12"});
  EXPECT_EQ(digest({"--duration", "12"}), plain) << "the same run gives the same bytes";
  EXPECT_EQ(digest({"--duration", "12", "--seed", "7"}), plain);
  EXPECT_NE(digest({"--duration", "12", "--seed", "8"}), plain);
  EXPECT_NE(digest({"--duration", "13"}), plain);
}

TEST_F(RunVerb, SeveralStacksNeedABusEachAndLeaveALogEach) {
  const std::string two = "hil/scenarios/two_stacks.yaml";
  expect_refusal({"run", two, "--live", "--interface", "can"}, "--interface");
  const ProgramOutput output = run(
      {"run", two, "--duration", "5", "--cut", "--log", path("l.mcap"), "--json", path("r.json")});
  EXPECT_EQ(output.code, 0) << output.out << output.err;
  const auto json = yaml::load_file(path("r.json"));
  ASSERT_TRUE(json);
  auto others = json->root().maps("others");
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(others[0].text("car"), "compliant");
  EXPECT_NE(output.out.find("event log SHA-256 " + others[0].text("sha256")), std::string::npos);
  EXPECT_GT(text_of("l.compliant.mcap").size(), 100'000u);
}

TEST_F(RunVerb, ProgressIsLinesFromThePlanToTheResult) {
  const ProgramOutput output = run({"run", kLaunchAndStop, "--progress", path("p.jsonl")});
  EXPECT_EQ(output.code, 0);
  const std::string lines = text_of("p.jsonl");
  EXPECT_TRUE(lines.starts_with("{\"type\": \"plan\"")) << lines.substr(0, 80);
  EXPECT_TRUE(lines.ends_with("\n"));
  const std::string last = lines.substr(lines.rfind('\n', lines.size() - 2) + 1);
  EXPECT_TRUE(last.starts_with("{\"type\": \"result\", \"passed\": true")) << last.substr(0, 80);
  expect_refusal({"run", kLaunchAndStop, "--progress", path("no/such/p.jsonl")}, "no/such");
  expect_refusal({"run", kLaunchAndStop, "--progress", path("p.jsonl"), "--hours", "1"}, "--hours");
}

TEST(LiveCommand, SaysAllThatTheRunWasTold) {
  RunOptions options;
  options.scenario = "s.yaml";
  options.interface = "vcan7";
  options.folder = "out";
  options.log_file = "l.mcap";
  options.json_file = "r.json";
  options.duration = milliseconds(1500);
  options.seed = 42;
  options.candump = true;
  options.radio_port = 999;
  const std::vector<std::string> command = live_command(options);
  EXPECT_EQ(command[0], own_program());
  EXPECT_EQ(command[1], "run");
  EXPECT_EQ(command[2], "s.yaml");
  const auto has = [&](const std::string& word) {
    return std::find(command.begin(), command.end(), word) != command.end();
  };
  const auto value = [&](const std::string& flag) {
    const auto at = std::find(command.begin(), command.end(), flag);
    return at == command.end() || at + 1 == command.end() ? "" : *(at + 1);
  };
  EXPECT_TRUE(has("--live"));
  EXPECT_TRUE(has("--here")) << "or the guest would boot a guest";
  EXPECT_TRUE(has("--candump"));
  EXPECT_EQ(value("--interface"), "vcan7");
  EXPECT_EQ(value("--out"), "out");
  EXPECT_EQ(value("--log"), "l.mcap");
  EXPECT_EQ(value("--json"), "r.json");
  EXPECT_EQ(std::stod(value("--duration")), 1.5);
  EXPECT_EQ(value("--seed"), "42");
  EXPECT_EQ(value("--radio-port"), "999");
  EXPECT_FALSE(has("--progress"));
  options.progress_file = "p.jsonl";
  const std::vector<std::string> reported = live_command(options);
  const auto progress = std::find(reported.begin(), reported.end(), "--progress");
  ASSERT_NE(progress, reported.end());
  EXPECT_EQ(*(progress + 1), "p.jsonl");
}

TEST(LiveCommand, ATimeThatIsSharedIsKeptOnBothSidesOfTheLine) {
  RunOptions options;
  options.scenario = "s.yaml";
  for (const char* const clock : {"", "bench", "wall", "/dev/shm/t"}) {
    options.clock = clock;
    const bool is_file = clock[0] == '/';
    const auto words = exec_arguments(options);
    ASSERT_TRUE(words);
    const auto command = std::ranges::find(*words, "--");
    const auto outside = std::find(words->begin(), command, "--clock");
    EXPECT_EQ(outside != command, is_file) << clock;
    const auto inside = std::find(command, words->end(), "--clock");
    ASSERT_EQ(inside != words->end(), clock[0] != 0) << clock;
    if (clock[0] != 0) {
      EXPECT_EQ(*(inside + 1), on_host(clock));
    }
  }
}

// Behind the line the bench has ports of its own; on this machine they are those of the base.
TEST(ExecWords, LeadTheRadioOutOfTheGuest) {
  RunOptions options;
  options.scenario = "s.yaml";
  options.interface = "vcan7";
  const auto without = exec_arguments(options);
  ASSERT_TRUE(without);
  EXPECT_EQ(std::ranges::count(*without, "--line-udp"), 0);
  options.radio_port = 23'431;
  options.uplink_port = 23'500;
  const auto with = exec_arguments(options);
  ASSERT_TRUE(with);
  const auto after = [&](const std::string& flag) {
    const auto at = std::ranges::find(*with, flag);
    return at == with->end() ? "" : *(at + 1);
  };
  const auto line = can_bus::parse_line_ports(after("--line-udp"));
  ASSERT_TRUE(line);
  EXPECT_EQ(line->host_listen, 23'500);
  EXPECT_EQ(line->host_destination, 23'431);
  EXPECT_EQ(after("--radio-port"), std::to_string(line->guest_listen));
  EXPECT_EQ(after("--uplink-port"), std::to_string(line->guest_destination));
  EXPECT_EQ(after("--interface"), "vcan7");
  EXPECT_EQ(after("--"), own_program());
  options.uplink_port = 0;  // any
  const auto any = exec_arguments(options);
  ASSERT_TRUE(any);
  EXPECT_NE((*any)[5].substr(0, 2), "0:");
}

// Cars lock their memory: two in the guest of one end by its kernel.
TEST(ExecWords, GiveEveryCarWithAStackItsMemory) {
  RunOptions options;
  options.scenario = "s.yaml";
  options.interface = "vcan0";
  EXPECT_EQ(std::ranges::count(exec_arguments(options).value(), "--memory"), 0) << "the default";
  const std::vector<std::string> others{"vcan1"};
  const std::vector<std::string> words = exec_arguments(options, others).value();
  const auto memory = std::ranges::find(words, "--memory");
  ASSERT_NE(memory, words.end());
  EXPECT_EQ(*(memory + 1), std::to_string(2 * can_bus::BusExecOptions{}.memory_mib));
}

}  // namespace
}  // namespace pitwall::cli
