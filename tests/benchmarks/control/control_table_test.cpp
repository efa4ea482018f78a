// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/benchmarks/laps/lap_plan.hpp"

namespace pitwall::control_bench {
namespace {

constexpr int kMinute = 6000;

ControlRow row(const std::string& world, const char* law, double error_m) {
  ControlRow r{.track = "OVAL", .world = world, .law = law, .cross_track = {}, .end = {}};
  for (const grading::Bracket& b : grading::kBrackets)
    for (int i = 0; i < kMinute; ++i) grading::add(r.cross_track, b.from_mps + 1.0, error_m);
  return r;
}

std::vector<ControlRow> good() {
  return {row(laps::kNominal, kPaper, 0.04), row(laps::kNominal, kOurs, 0.02),
          row("friction 0.8", kPaper, 0.04), row("friction 0.8", kOurs, 0.04)};
}

// Names of the gates that are missed.
std::vector<std::string> missed(const std::vector<ControlRow>& rows) {
  std::vector<std::string> names;
  for (const Gate& gate : gates_of(rows))
    if (!gate.held)
      names.push_back(gate.name.substr(0, gate.name.find(' ', gate.name.find(' ') + 1)));
  return names;
}

using Names = std::vector<std::string>;

TEST(ControlTable, GatesHoldWithinTheirBounds) {
  EXPECT_EQ(missed(good()), Names{});
  EXPECT_TRUE(all_held(gates_of(good())));
  EXPECT_EQ(gates_of(good()).size(), 5U);
}

TEST(ControlTable, AWorldThatWasNotDrivenIsNotJudged) {
  auto rows = good();
  rows.resize(2);
  EXPECT_EQ(gates_of(rows).size(), 4U);
}

TEST(ControlTable, EachGateIsMissedByItsOwnFault) {
  auto rows = good();
  rows[0].cross_track.by_bracket[3].samples = 5000;
  EXPECT_EQ(missed(rows), Names{"every speed"});

  rows = good();
  rows[1].cross_track.by_bracket[2] = {.samples = kMinute, .sum_m = 0.06 * kMinute, .max_m = 0.06};
  EXPECT_EQ(missed(rows), Names{"at most"}) << "more than 0.05 m, and than half of 0.04 m";
  rows[0].cross_track.by_bracket[2].sum_m = 0.13 * kMinute;
  EXPECT_EQ(missed(rows), Names{}) << "less than half of 0.13 m";

  rows = good();
  rows[1].cross_track.by_bracket[9].sum_m = 0.04 * kMinute;  // slow: not compared with the paper
  EXPECT_EQ(missed(rows), Names{"mean within"});

  rows = good();
  rows[1].cross_track.by_bracket[9].max_m = 0.16;
  EXPECT_EQ(missed(rows), Names{"maximum within"});

  rows = good();
  rows[3].cross_track.by_bracket[0].sum_m = 0.29 * kMinute;
  EXPECT_EQ(missed(rows), Names{"mean within"});
  const Gate worst = gates_of(rows).back();
  EXPECT_EQ(worst.worst, "0.290 of 0.280 m: OVAL friction 0.8 >60 m/s");
}

TEST(ControlTable, ACarThatLeftTheTrackHoldsNothing) {
  auto rows = good();
  rows[3].end = "wall at s = 12 m";
  EXPECT_EQ(missed(rows), Names{"mean within"});
  const auto gates = gates_of(rows);
  EXPECT_NE(to_text(gates).find("worst OVAL friction 0.8: wall at s = 12 m"), std::string::npos);
  EXPECT_NE(to_json(gates).find("\"worst\": \"OVAL friction 0.8: wall at"), std::string::npos);
}

TEST(ControlTable, ADrawnCarIsPrintedAndNotJudged) {
  auto rows = good();
  rows.push_back(row("car 3", kOurs, 5.0));
  EXPECT_FALSE(all_held(gates_of(rows)));
  rows.back().is_judged = false;
  EXPECT_TRUE(all_held(gates_of(rows)));
  EXPECT_NE(to_text(rows).find("car 3"), std::string::npos);
}

// What another law does in another world is printed, and no gate.
TEST(ControlTable, ThePapersLawIsNotJudged) {
  auto rows = good();
  rows[2] = row("friction 0.8", kPaper, 5.0);
  EXPECT_TRUE(all_held(gates_of(rows)));
  EXPECT_NE(to_text(rows).find("5.000"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::control_bench
