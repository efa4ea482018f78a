// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/expect_section.hpp"

#include <gtest/gtest.h>

#include "tests/support/instants.hpp"

namespace pitwall::scenario {
namespace {

using grading::Expectation;
using grading::Kind;
using grading::Op;

// The entry in the second line of a file, in a scenario with two faults.
Result<Expectation, Problem> read_entry(const std::string& entry) {
  const auto document = yaml::load_text("expect:\n  {" + entry + "}\n", "e.yaml");
  if (!document) return Unexpected{document.error()};
  const std::vector<Instant> faults{at_s(5.0), at_s(8.0)};
  return yaml::read(*document, [&faults](yaml::StrictMap& map) {
    yaml::StrictMap own = map.map("expect");
    return read_expectation(own, faults);
  });
}

Expectation good(const std::string& entry) {
  const auto read = read_entry(entry);
  EXPECT_TRUE(read) << entry << ": " << to_string(read.error());
  return read.value_or(Expectation{});
}

const std::string kSlow = "signal: speed_mps, is: \"<\", value: 5";

TEST(ExpectSection, EveryKindReadsItsWindowAndCondition) {
  for (const std::string kind : {"always", "never", "within", "rate"}) {
    const Expectation whole = good("kind: " + kind + ", " + kSlow);
    EXPECT_EQ(grading::name_of(whole.kind), kind);
    EXPECT_EQ(to_string(whole.condition), "speed_mps < 5");
    EXPECT_EQ(whole.name, "e.yaml:2:10");
    EXPECT_FALSE(whole.from || whole.to) << "the whole run";
    const Expectation part = good("kind: " + kind + ", " + kSlow + ", from_s: 1, until_s: 2.5");
    EXPECT_EQ(part.from, at_s(1.0));
    EXPECT_EQ(part.to, at_s(2.5));
  }
}

TEST(ExpectSection, AReactionHasATriggerAndALimit) {
  const Expectation e = good("kind: after, " + kSlow +
                             ", trigger: {signal: brake_kpa, is: \">\", value: 100}, within_s: 4");
  EXPECT_EQ(to_string(e), "after brake_kpa > 100: speed_mps < 5 within 4 s");
}

TEST(ExpectSection, UntilHasAReleaseAndALimitThatEndsItsWindow) {
  const Expectation e =
      good("kind: until, " + kSlow +
           ", release: {signal: gear, is: \"==\", value: 0}, within_s: 4, from_s: 2");
  EXPECT_EQ(to_string(e), "until gear == 0 within 4 s: speed_mps < 5, from 2 s");
}

TEST(ExpectSection, ARateHasASpanAndAQuantileItsShare) {
  EXPECT_EQ(good("kind: rate, " + kSlow).span, Duration{});
  EXPECT_EQ(good("kind: rate, over_s: 0.1, " + kSlow).span, milliseconds(100));
  EXPECT_EQ(good("kind: quantile, quantile: 0.99, " + kSlow).share, 0.99);
}

TEST(ExpectSection, ADetectionCountsFromItsFault) {
  const Expectation seen = good("kind: detects, monitor: counter, within_s: 0.02");
  EXPECT_EQ(to_string(seen.condition), "seen_counter == 1");
  EXPECT_EQ(seen.from, at_s(5.0));
  EXPECT_EQ(seen.to, at_s(5.02));
  EXPECT_EQ(seen.limit, milliseconds(20));
  const Expectation reported =
      good("kind: detects, signal: mode, is: \">=\", value: 3, fault: 2, within_s: 0.5");
  EXPECT_EQ(reported.condition.op, Op::kGreaterEqual);
  EXPECT_EQ(reported.from, at_s(8.0));
}

struct Bad {
  std::string entry;
  std::string key, what;  // where the error is, and what it says
};

TEST(ExpectSection, WhatIsWrongIsToldAtItsPlace) {
  const std::string slow = ", " + kSlow;
  const std::string release = ", release: {signal: gear, is: \"==\", value: 0}";
  const Bad rows[] = {
      {"kind: often" + slow, "often",
       "is not one of: always, never, within, after, detects, until"},
      {"kind: always, signal: mode, is: \"=>\", value: 1", "\"=>\"", "is not one of: <, <=, >"},
      {"kind: always, signal: mode, is: \"<\", value: .nan", ".nan", "value"},
      {"kind: always, monitor: counter", "kind", "signal"},
      {"kind: always, within_s: 1" + slow, "within_s", "unknown key"},
      {"kind: always, from_s: 3, until_s: 2" + slow, "2,", "ends before it begins"},
      {"kind: always, until_s: 0" + slow, "0,", "ends before it begins"},
      {"kind: detects, monitor: counter, within_s: 0", "0", "within_s"},
      {"kind: detects, monitor: counter", "kind", "within_s"},
      {"kind: detects, monitor: counter, fault: 3, within_s: 1", "3", "entry of faults"},
      {"kind: detects, monitor: counter, from_s: 3, within_s: 1", "from_s", "unknown key"},
      {"kind: after, within_s: 1" + slow, "kind", "trigger"},
      {"kind: after, trigger: {signal: mode, is: \"<\"}, within_s: 1" + slow, "{signal", "value"},
      {"kind: after, trigger: {signal: mode, is: \"<\", value: 1, at: 2}, within_s: 1" + slow,
       "at:", "unknown key"},
      {"kind: after, trigger: {signal: mode, is: \"<\", value: 1}" + slow, "kind", "within_s"},
      {"kind: after, within_s: 1" + release + slow, "kind", "trigger"},
      {"kind: until, within_s: 1" + slow, "kind", "release"},
      {"kind: until" + release + slow, "kind", "within_s"},
      {"kind: until, within_s: 1, until_s: 9" + release + slow, "until_s", "unknown key"},
      {"kind: rate, over_s: 0" + slow, "0,", "over_s"},
      {"kind: rate, over_s: 11" + slow, "11", "over_s"},
      {"kind: always, over_s: 1" + slow, "over_s", "unknown key"},
      {"kind: quantile" + slow, "kind", "quantile"},
      {"kind: quantile, quantile: 1.5" + slow, "1.5", "quantile"},
      {"kind: quantile, quantile: 0.5, signal: mode, is: \"==\", value: 1", "\"==\"",
       "of a quantile, expected < <= > or >="},
  };
  for (const Bad& row : rows) {
    const auto read = read_entry(row.entry);
    ASSERT_FALSE(read) << row.entry;
    // The mapping begins in column 3; a missing key is told there.
    const std::size_t at = row.key == "kind" ? 0 : row.entry.find(row.key) + 1;
    const std::string place = "e.yaml:2:" + std::to_string(3 + at);
    EXPECT_EQ(read.error().place, place) << row.entry << ": " << to_string(read.error());
    EXPECT_NE(read.error().what.find(row.what), std::string::npos) << to_string(read.error());
  }
}

}  // namespace
}  // namespace pitwall::scenario
