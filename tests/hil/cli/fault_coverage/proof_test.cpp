// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/proof.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace pitwall::fault_coverage {
namespace {

using grading::Kind, grading::Op;
using world::Monitor;

grading::Expectation expectation(Kind kind, const std::string& signal, Op op, double value) {
  return {.name = "here:1", .kind = kind, .condition = {signal, op, value}};
}

TEST(Proof, WhatMonitorsSeeIsNoConsequence) {
  EXPECT_FALSE(is_consequence(expectation(Kind::kDetects, "seen_counter", Op::kEqual, 1)));
  EXPECT_FALSE(is_consequence(expectation(Kind::kNever, "seen_clock", Op::kEqual, 1)));
  EXPECT_TRUE(is_consequence(expectation(Kind::kNever, "mode", Op::kEqual, 3)));
  EXPECT_TRUE(is_consequence(expectation(Kind::kDetects, "ct_state", Op::kEqual, 10)));
  grading::Expectation after = expectation(Kind::kAfter, "mode", Op::kEqual, 3);
  EXPECT_TRUE(is_consequence(after));
  after.trigger = {"seen_counter", Op::kEqual, 1};
  EXPECT_FALSE(is_consequence(after)) << "what is asked for once a monitor sees something";
}

TEST(Proof, AScenarioAsksWithADetectionOnly) {
  scenario::Scenario scenario;
  scenario.expect = {expectation(Kind::kDetects, "seen_counter", Op::kEqual, 1),
                     expectation(Kind::kNever, "seen_clock", Op::kEqual, 1)};
  EXPECT_TRUE(asks(scenario, Monitor::kCounter));
  EXPECT_FALSE(asks(scenario, Monitor::kClock));
}

Proof proof_of(Monitor monitor, bool asked, bool failed) {
  Proof proof{.monitor = monitor, .asked = {}};
  if (asked) proof.asked = {"f06_x"};
  if (failed) proof.failed = {{"f06_x", "never mode == 3", "violated at 26.500 s"}};
  return proof;
}

TEST(Proof, AMonitorIsProvenOrInformsOnly) {
  EXPECT_EQ(open_point(proof_of(Monitor::kCounter, true, true)), "");
  EXPECT_EQ(open_point(proof_of(Monitor::kBusLoad, true, false)), "");
  EXPECT_NE(open_point(proof_of(Monitor::kCounter, true, false)).find("unproven"),
            std::string::npos);
  EXPECT_NE(open_point(proof_of(Monitor::kBusLoad, true, true)).find("is proven"),
            std::string::npos);
  for (const Monitor monitor : {Monitor::kCounter, Monitor::kBusLoad})
    EXPECT_NE(open_point(proof_of(monitor, false, false)).find("by no scenario"),
              std::string::npos);
}

TEST(Proof, TheTableNamesMonitorScenarioAndExpectation) {
  const std::string text = to_text(std::vector{proof_of(Monitor::kCounter, true, true),
                                               proof_of(Monitor::kBusLoad, true, false),
                                               proof_of(Monitor::kModule, true, false)});
  for (const char* words : {"counter           f06_x", "never mode == 3: violated at 26.500 s",
                            "bus_load          informs only", "UNPROVEN: module changes nothing"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

TEST(Proof, JsonHasTheSame) {
  EXPECT_EQ(json_of(proof_of(Monitor::kCounter, true, true)),
            R"({"monitor": "counter", "asked": ["f06_x"], "failed": [{"scenario": "f06_x", )"
            R"("expectation": "never mode == 3", "reason": "violated at 26.500 s"}], )"
            R"("informs_only": null})");
}

// Frames twice: nothing but the report is lost without the counter's monitor. A counter that stands
// still: without it the car drives on by a report of before.
TEST(Proof, AFaultThatIsOnlyReportedProvesNothing) {
  const std::string root = PITWALL_SOURCE_DIR;
  for (const auto& [name, proves] :
       {std::pair{"f06_frames_twice", false}, std::pair{"f08_counter_stuck", true}}) {
    const auto loaded = bench::load(root + "/hil/scenarios/faults/" + name + ".yaml", root);
    ASSERT_TRUE(loaded) << name;
    const auto found = consequence_without(Monitor::kCounter, *loaded);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->has_value(), proves) << name;
    if (proves) {
      EXPECT_NE((*found)->expectation.find("mode"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace pitwall::fault_coverage
