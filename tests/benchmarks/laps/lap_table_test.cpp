// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/lap_table.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::laps {
namespace {

LapRow row(const std::string& track, const std::string& perturbation, double error_m,
           Outcome outcome = Outcome::kLapped) {
  LapRow r;
  r.track = track;
  r.perturbation = perturbation;
  r.outcome = outcome;
  r.laps = 3, r.flying = 2;
  r.flying_mean_mps = 61.5, r.speed_max_mps = 65.4;
  grading::add(r.cross_track, 62.0, error_m);
  grading::add(r.cross_track, 12.0, 0.5 * error_m);
  return r;
}

std::vector<LapRow> good() {
  return {row("OVAL", kNominal, 0.2), row("OVAL", "friction 0.8", 0.3)};
}

TEST(LapTable, GatesHoldWhereEveryRunSaysHowItEnded) {
  EXPECT_TRUE(gates_of(good()).held());
  // Leaving the track under a perturbation is a finding, not a failure of the bench.
  auto rows = good();
  rows[1].outcome = Outcome::kContact;
  EXPECT_TRUE(gates_of(rows).held());
  rows[1].outcome = Outcome::kStopped;
  EXPECT_TRUE(gates_of(rows).held());
}

TEST(LapTable, EachGateIsMissedByItsOwnFault) {
  for (const Outcome bad : {Outcome::kContact, Outcome::kStopped, Outcome::kUnfinished}) {
    auto rows = good();
    rows[0].outcome = bad;
    EXPECT_FALSE(gates_of(rows).nominal_laps);
    EXPECT_TRUE(gates_of(rows).every_perturbation);
  }
  auto rows = good();
  rows[1].outcome = Outcome::kUnfinished;
  EXPECT_FALSE(gates_of(rows).every_verdict);
  EXPECT_TRUE(gates_of(rows).nominal_laps);

  rows = good();
  rows[1] = row("OVAL", "friction 0.8", 0.2);  // to the last bit what nominal drove
  EXPECT_FALSE(gates_of(rows).every_perturbation);
  EXPECT_TRUE(gates_of(rows).nominal_laps && gates_of(rows).every_verdict);
  EXPECT_NE(to_text(rows).find("it was not applied"), std::string::npos);
  rows[1].track = "OTHER";  // the same figures on another track say nothing
  EXPECT_TRUE(gates_of(rows).every_perturbation);
}

TEST(LapTable, SaysWhereTheCarLeftTheTrack) {
  auto rows = good();
  rows[1].outcome = Outcome::kContact;
  rows[1].station_m = 512.4, rows[1].speed_mps = 63.12, rows[1].at_s = 48.26;
  const std::string text = to_text(rows);
  EXPECT_NE(text.find("LEFT THE TRACK: wall at s = 512 m at 63.1 m/s, 48.3 s"), std::string::npos)
      << text;
  rows[1].outcome = Outcome::kStopped;
  rows[1].cause = "both GNSS units lost";
  EXPECT_NE(end_of(rows[1]).find("(both GNSS units lost) at s = 512 m"), std::string::npos);
}

TEST(LapTable, HoldsThePaperBesideItAndDoesNotClaimIt) {
  const std::string text = to_text(good());
  EXPECT_NE(text.find("SIMULATION"), std::string::npos);
  for (const char* figure : {"0.689", "0.832", "0.079", "0.372", "0.540", "0.048", "0.244"})
    EXPECT_NE(text.find(figure), std::string::npos) << figure;
  EXPECT_NE(text.find("not a claim"), std::string::npos);
  EXPECT_NE(text.find("0.200"), std::string::npos) << "mean above 60 m/s";
  EXPECT_NE(text.find("0.100"), std::string::npos) << "mean from 10 to 20 m/s";
  EXPECT_NE(text.find("     - "), std::string::npos) << "a bracket without a sample is no zero";
}

// YAML reads JSON: the object is one, whatever a track is called.
TEST(LapTable, JsonCanBeRead) {
  auto rows = good();
  rows[0].track = "a \"b\\\n";
  rows[1].flying_mean_mps = kUnset;
  const auto read = yaml::load_text(to_json(rows), "laps.json");
  ASSERT_TRUE(read) << to_string(read.error());
  yaml::StrictMap root = read->root();
  EXPECT_EQ(root.text("bench"), "laps");
  EXPECT_TRUE(root.flag("held"));
  auto list = root.maps("rows");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1].text("end"), "lapped");
  EXPECT_NEAR(list[0].number("cross_track_mean_m", 0.0, 1.0), 0.15, 1e-9);
}

}  // namespace
}  // namespace pitwall::laps
