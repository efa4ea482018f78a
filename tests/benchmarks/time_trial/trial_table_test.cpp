// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/time_trial/trial_table.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/time_trial/trial_plan.hpp"

namespace pitwall::time_trial {
namespace {

TrialRow row(std::size_t change, double mean_mph) {
  TrialRow r{.name = changes()[change].name};
  r.laps = kLaps;
  r.mean_mps = from_mph(mean_mph);
  return r;
}

TEST(TrialTable, GatesHoldAndAreMissed) {
  const std::vector<TrialRow> good{row(0, 170.0), row(1, 171.0), row(2, 140.0), row(3, 171.0)};
  EXPECT_TRUE(gates_of(good).held());
  EXPECT_NE(to_text(good).find("held"), std::string::npos);
  EXPECT_EQ(to_text(good).find("MISSED"), std::string::npos);
  EXPECT_FALSE(gates_of({}).held());
  for (const std::size_t change : {0u, 1u}) {
    std::vector<TrialRow> slow = good;
    slow[change].mean_mps = from_mph(168.1);
    EXPECT_FALSE(gates_of(slow).fast);
    slow[change].mean_mps = kUnset;
    EXPECT_FALSE(gates_of(slow).fast);
  }
  std::vector<TrialRow> careless = good;
  careless[2].mean_mps = from_mph(170.5);
  EXPECT_FALSE(gates_of(careless).careful);
}

TEST(TrialTable, EveryUncleanRunIsNamedButOneOnASlipperyRoadMissesNoGate) {
  const auto with = [](std::size_t change, auto spoil) {
    std::vector<TrialRow> rows{row(0, 170.0), row(1, 171.0), row(2, 140.0), row(3, 171.0)};
    spoil(rows[change]);
    return rows;
  };
  const auto touches = [](TrialRow& r) { r.contact = true; };
  const auto spins = [](TrialRow& r) { r.slip_max_deg = 30.0; };
  const auto stops = [](TrialRow& r) { r.stopped = true; };
  const auto ends_early = [](TrialRow& r) { r.laps = kLaps - 1; };
  for (std::size_t change = 0; change < changes().size(); ++change) {
    const bool counts = changes()[change].friction == 1.0;
    EXPECT_EQ(gates_of(with(change, touches)).clean, !counts);
    EXPECT_EQ(gates_of(with(change, spins)).clean, !counts);
    EXPECT_EQ(gates_of(with(change, stops)).clean, !counts);
    EXPECT_EQ(gates_of(with(change, ends_early)).clean, !counts);
    EXPECT_NE(to_text(with(change, touches)).find("TOUCHED A WALL"), std::string::npos);
    EXPECT_NE(to_text(with(change, spins)).find("SPUN"), std::string::npos);
  }
  EXPECT_NE(to_json(with(0, touches)).find("\"clean\": false, \"fast\": true"), std::string::npos)
      << to_json(with(0, touches));
}

}  // namespace
}  // namespace pitwall::time_trial
