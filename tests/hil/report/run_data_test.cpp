// SPDX-License-Identifier: Apache-2.0
#include "hil/report/run_data.hpp"

#include <gtest/gtest.h>

#include <array>

#include "hil/can_bus/frame_length.hpp"
#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

TEST(RunData, IsWhatTheLogHolds) {
  const RunData run = run_of({});
  EXPECT_EQ(run.outcome(), Outcome::kPass) << run.infrastructure.size();
  EXPECT_EQ(run.facts.scenario, "some_run");
  EXPECT_EQ(run.facts.duration_s, 10.0);
  ASSERT_EQ(run.truth.size(), 1001u);
  EXPECT_EQ(run.truth[100].t_s, 1.0);
  EXPECT_EQ(run.truth[100].v.vx_mps, 31.0);
  EXPECT_EQ(run.car.size(), 1001u);
  EXPECT_EQ(run.can.size(), 1001u);
  can::Frame frame;
  frame.id = 1300;
  frame.length = 8;
  std::fill_n(frame.data.begin(), 8, std::uint8_t{0xA5});
  EXPECT_EQ(run.can[0].v.bits, can_bus::frame_length(frame).bits);
  ASSERT_EQ(run.faults.size(), 1u);
  EXPECT_EQ(run.faults[0].kind, "steering_stuck");
  EXPECT_EQ(run.faults[0].to_s, 6.0);
  ASSERT_EQ(run.verdicts.size(), 1u);
  EXPECT_EQ(run.verdicts[0].margin, 30.0);
  EXPECT_EQ(run.events.size(), 1u) << "verdicts are no events";
  EXPECT_EQ(run.losses.size(), 1u);
  EXPECT_EQ(run.digest.size(), 64u);
}

TEST(RunData, AViolationKeepsItsMarginAndTime) {
  const RunData run = run_of({.with_failure = true});
  EXPECT_EQ(run.outcome(), Outcome::kFail);
  ASSERT_EQ(run.verdicts.size(), 2u);
  EXPECT_EQ(run.verdicts[1].margin, -0.75);
  EXPECT_EQ(run.verdicts[1].first_violation_s, 6.5);
  EXPECT_EQ(run.verdicts[1].reason, "2.75 at 6.5 s");
}

TEST(RunData, ALogThatWasNeverClosedIsInfrastructure) {
  const RunData run = run_of({.close = false});
  EXPECT_EQ(run.outcome(), Outcome::kInfrastructure);
  EXPECT_EQ(run.truth.size(), 1001u) << "what is there is read";
  ASSERT_EQ(run.infrastructure.size(), 1u);
  EXPECT_NE(run.infrastructure[0].find("truncated at byte"), std::string::npos);
}

TEST(RunData, EveryCutIsInfrastructureAndNothingMoreIsRead) {
  const Bytes whole = log_of({.duration_s = 2.0});
  const RunData all = read_run(whole, "f");
  for (std::size_t length = 0; length < whole.size(); length += 997) {
    const RunData cut = read_run(std::span(whole).first(length), "f");
    EXPECT_EQ(cut.outcome(), Outcome::kInfrastructure) << length;
    EXPECT_LE(cut.truth.size(), all.truth.size());
    EXPECT_EQ(cut.health.bytes, length);
    EXPECT_LE(cut.health.read_bytes, length);
  }
}

TEST(RunData, AChangedByteIsNeverAPass) {
  const Bytes whole = log_of({.duration_s = 1.0});
  for (std::size_t at = 0; at < whole.size(); at += 311) {
    Bytes changed = whole;
    changed[at] ^= 0x10;
    EXPECT_EQ(read_run(changed, "f").outcome(), Outcome::kInfrastructure) << at;
  }
}

TEST(RunData, ASkippedChunkIsCountedMessageByMessage) {
  Bytes file = log_of({.duration_s = 4.0});
  const RunData all = read_run(file, "f");
  file[file.size() / 2] ^= 1;  // inside a chunk: most of the file is chunks
  const RunData damaged = read_run(file, "f");
  EXPECT_EQ(damaged.health.counters.bad_chunk_crc, 1u);
  EXPECT_EQ(damaged.health.missing + damaged.health.counters.messages,
            all.health.counters.messages);
  EXPECT_GT(damaged.health.missing, 100u);
}

TEST(RunData, TheResultMustBelongToTheLog) {
  RunData run = run_of({});
  const std::string good = result_of(run);
  add_result(run, good, "run.json");
  EXPECT_EQ(run.outcome(), Outcome::kPass);
  ASSERT_TRUE(run.result);
  EXPECT_EQ(run.result->to_car, 1001.0);

  RunData other = run_of({.scenario = "other"});
  add_result(other, good, "run.json");
  EXPECT_EQ(other.outcome(), Outcome::kInfrastructure);
  EXPECT_FALSE(other.result);

  RunData broken = run_of({});
  add_result(broken, good.substr(0, good.size() / 2), "run.json");
  EXPECT_EQ(broken.outcome(), Outcome::kInfrastructure);
}

TEST(RunData, TheResultMustSayTheSameAsTheLog) {
  RunData run = run_of({.with_failure = true});
  RunData says_otherwise = run;
  says_otherwise.verdicts[1].pass = true;
  add_result(run, result_of(says_otherwise), "run.json");
  EXPECT_EQ(run.outcome(), Outcome::kInfrastructure);
}

TEST(RunData, WhatFailedOnAMachineThatDidNotKeepUpWasNotJudged) {
  for (const bool fails : {false, true}) {
    for (const bool late : {false, true}) {
      RunData run = run_of({.with_failure = fails});
      add_result(run, result_of(run, milliseconds(late ? 60 : 10)), "run.json");
      const Outcome expected = !fails ? Outcome::kPass
                               : late ? Outcome::kInfrastructure
                                      : Outcome::kFail;
      EXPECT_EQ(run.outcome(), expected) << fails << late;
    }
  }
}

TEST(RunData, ACarThatMissedTicksMakesEvenAPassInfrastructure) {
  RunData run = run_of({});
  std::string result = result_of(run);
  const std::string none = "\"not_judged\": []";
  ASSERT_NE(result.find(none), std::string::npos);
  result.replace(result.find(none), none.size(), "\"not_judged\": [\"the car missed 3 %\"]");
  add_result(run, result, "run.json");
  EXPECT_EQ(run.outcome(), Outcome::kInfrastructure);
  EXPECT_EQ(run.infrastructure,
            (std::vector<std::string>{"run.json: not judged: the car missed 3 %"}));
}

TEST(RunData, TheVerdictsOfOtherCarsCount) {
  for (const bool passes : {true, false}) {
    RunData run = run_of({});
    const std::size_t own = run.verdicts.size();
    bench::RunResult result, other;
    result.digest = run.digest;
    for (std::size_t i = 0; i < own; ++i) result.verdicts.push_back(some_verdict(true));
    other.verdicts.push_back(some_verdict(passes));
    other.remarks = {"was noted"};
    const std::array<std::string, 1> names{"rival"};
    add_result(run, to_json(bench::with_others({result, other}, names)), "run.json");
    EXPECT_EQ(run.infrastructure, std::vector<std::string>{});
    EXPECT_EQ(run.outcome(), passes ? Outcome::kPass : Outcome::kFail);
    ASSERT_EQ(run.verdicts.size(), own + 1);
    EXPECT_EQ(run.verdicts.back().text, "rival: " + some_verdict(passes).text);
    EXPECT_EQ(run.verdicts.back().reason, some_verdict(passes).reason);
    EXPECT_EQ(run.result->remarks.back(), "rival: was noted");
  }
}

TEST(RunData, SaysWhereTheCarEnded) {
  RunData run = run_of({});
  add_result(run, result_of(run), "run.json");
  ASSERT_TRUE(run.result);
  EXPECT_NE(run.result->ending.find("stands, 0.50 m from its line"), std::string::npos)
      << run.result->ending;
}

TEST(RunData, BytesThatAreNoLogAreInfrastructure) {
  for (const std::string text : {"", "no log", "\x89MCAP0\r\n"}) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    const RunData run = read_run({bytes, text.size()}, "f");
    EXPECT_EQ(run.outcome(), Outcome::kInfrastructure);
    EXPECT_GT(run.end_s(), 0.0);
  }
}

}  // namespace
}  // namespace pitwall::report
