// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/check_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace pitwall::localization {
namespace {

using world::Monitor;

world::MonitorSet only_off(Monitor monitor) {
  world::MonitorSet set;
  set.add(monitor);
  return set;
}

// A position that nothing is wrong with.
Evidence healthy(Source source = Source::kPosition) {
  Evidence e;
  e.source = source;
  e.least_sigma = 0.01;
  e.age_s = 0.03, e.window_s = 0.25;
  e.after_newest_s = e.spacing_s = 0.05;
  e.speed_mps = 60.0;
  e.rank = 3.0;
  e.sigma = 0.01, e.sigma_max = 1.0, e.other_sigma = 0.011;
  e.height_sigma_m = 0.02;
  e.differential_age_s = 1.0, e.solution_age_s = 0.0;
  e.baseline_error_m = 0.001;
  e.residual = 0.01, e.jump_min = 0.08, e.jump_sigma_max = 0.06;
  e.course_error_rad = 0.01;
  e.apart = 0.02, e.apart_max = 0.12;
  e.stray = 0.02, e.other_stray = 0.02;
  return e;
}

struct Case {
  Gate reason;
  std::optional<Monitor> monitor;
  Source source;
  void (*spoil)(Evidence& e);
};

// One for each reason of the table, spoilt in one way.
const std::vector<Case>& cases() {
  using enum Source;
  static const std::vector<Case> all{
      {Gate::kUnknownUnit, {}, kImu, [](Evidence& e) { e.known_unit = false; }},
      {Gate::kNotFinite, {}, kVelocity, [](Evidence& e) { e.finite = false; }},
      {Gate::kNegativeVariance, {}, kHeading, [](Evidence& e) { e.least_sigma = -1e-9; }},
      {Gate::kImplausible, {}, kImu, [](Evidence& e) { e.plausible = false; }},
      {Gate::kNotSolved, Monitor::kSolution, kPosition, [](Evidence& e) { e.solved = false; }},
      {Gate::kNotSolved, Monitor::kSolution, kPosition, [](Evidence& e) { e.rank = 0.0; }},
      {Gate::kTooUncertain, Monitor::kSolution, kPosition, [](Evidence& e) { e.sigma = 1.01; }},
      {Gate::kTooUncertain, Monitor::kSolution, kPosition, [](Evidence& e) { e.sigma = 0.06; }},
      {Gate::kTooUncertain, Monitor::kSolution, kPosition,
       [](Evidence& e) { e.height_sigma_m = 11.0; }},
      {Gate::kOldCorrections, Monitor::kSolution, kPosition,
       [](Evidence& e) { e.differential_age_s = 10.5; }},
      {Gate::kOldCorrections, Monitor::kSolution, kHeading,
       [](Evidence& e) { e.solution_age_s = 1.5; }},
      {Gate::kWrongBaseline, Monitor::kSolution, kHeading,
       [](Evidence& e) { e.baseline_error_m = -0.2; }},
      {Gate::kReceiverError, Monitor::kSolution, kPosition,
       [](Evidence& e) { e.receiver_well = false, e.other_well = true; }},
      {Gate::kFromTheFuture, Monitor::kStamp, kPosition, [](Evidence& e) { e.age_s = -0.02; }},
      {Gate::kRanBack, Monitor::kStamp, kImu, [](Evidence& e) { e.after_newest_s = -0.2; }},
      {Gate::kRepeated, Monitor::kStamp, kVelocity, [](Evidence& e) { e.spacing_s = 0.0; }},
      {Gate::kFrozen, Monitor::kStamp, kPosition, [](Evidence& e) { e.same_content = true; }},
      {Gate::kTooOld, Monitor::kStreamAge, kPosition, [](Evidence& e) { e.age_s = 0.3; }},
      {Gate::kOutlier, Monitor::kInnovation, kPosition, [](Evidence& e) { e.residual = 0.3; }},
      {Gate::kDisagrees, Monitor::kUnitAgreement, kPosition,
       [](Evidence& e) { e.apart = 0.2, e.stray = 0.2; }},
      {Gate::kOffCourse, Monitor::kUnitAgreement, kHeading,
       [](Evidence& e) { e.course_error_rad = 3.1; }}};
  return all;
}

TEST(CheckTable, AHealthySampleOfAnySourcePassesAndNothingIsSeen) {
  for (std::size_t s = 0; s < kSources; ++s) {
    const Judged judged = judge(healthy(static_cast<Source>(s)), {}, {});
    EXPECT_EQ(judged.gate, Gate::kAccepted) << s;
    EXPECT_TRUE(judged.seen.empty()) << s;
  }
}

TEST(CheckTable, WhatNobodySaysIsNoFault) {
  for (std::size_t s = 0; s < kSources; ++s) {
    Evidence e;
    e.source = static_cast<Source>(s);
    e.other_well = true;
    EXPECT_EQ(judge(e, {}, {}).gate, Gate::kAccepted) << s;
  }
}

TEST(CheckTable, EveryFaultHasItsReasonAndItsMonitor) {
  for (const Case& c : cases()) {
    Evidence e = healthy(c.source);
    c.spoil(e);
    const Judged judged = judge(e, {}, {});
    EXPECT_EQ(judged.gate, c.reason) << text_of(c.reason);
    world::MonitorSet expected;
    if (c.monitor) expected.add(*c.monitor);
    EXPECT_EQ(judged.seen, expected) << text_of(c.reason);
  }
}

TEST(CheckTable, EveryReasonOfTheTableIsTried) {
  std::set<Gate> tried, listed;
  for (const Case& c : cases()) tried.insert(c.reason);
  for (const CheckRow& row : kChecks) listed.insert(row.reason);
  EXPECT_EQ(tried, listed);
}

TEST(CheckTable, AMonitorThatIsOffSeesNothingAndRefusesNothing) {
  for (const Case& c : cases()) {
    if (!c.monitor) continue;
    Evidence e = healthy(c.source);
    c.spoil(e);
    const Judged judged = judge(e, {}, only_off(*c.monitor));
    EXPECT_EQ(judged.gate, Gate::kAccepted) << text_of(c.reason);
    EXPECT_TRUE(judged.seen.empty()) << text_of(c.reason);
  }
}

// What cannot be read is refused whatever is switched off.
TEST(CheckTable, TheFormIsAlwaysJudged) {
  world::MonitorSet all;
  for (std::size_t m = 0; m < world::kMonitors; ++m) all.add(static_cast<Monitor>(m));
  for (const Case& c : cases()) {
    if (c.monitor) continue;
    Evidence e = healthy(c.source);
    c.spoil(e);
    EXPECT_EQ(judge(e, {}, all).gate, c.reason);
  }
}

// At its limit a number passes, the next one beyond it does not.
struct Limit {
  Gate reason;
  Source source;
  double Evidence::*number;
  double at, beyond;
  void (*prepare)(Evidence& e) = [](Evidence&) {};
};

const std::vector<Limit>& limits() {
  using enum Source;
  using E = Evidence;
  constexpr double kMore = std::numeric_limits<double>::infinity();
  static const CheckParams p;
  static const std::vector<Limit> all{
      {Gate::kNegativeVariance, kHeading, &E::least_sigma, 0.0, -kMore},
      {Gate::kFromTheFuture, kImu, &E::age_s, -p.future_max_s, -kMore},
      {Gate::kTooOld, kPosition, &E::age_s, healthy().window_s, kMore},
      {Gate::kRanBack, kVelocity, &E::after_newest_s, -p.reorder_max_s, -kMore},
      {Gate::kRepeated, kAttitude, &E::spacing_s, p.spacing_min_s, -kMore},
      {Gate::kFrozen, kPosition, &E::speed_mps, p.frozen_speed_min_mps, kMore,
       [](E& e) { e.same_content = true; }},
      {Gate::kNotSolved, kPosition, &E::rank, p.position_rank_min, -kMore},
      {Gate::kTooUncertain, kVelocity, &E::sigma, healthy().sigma_max, kMore},
      {Gate::kTooUncertain, kPosition, &E::height_sigma_m, p.height_sigma_max_m, kMore},
      {Gate::kTooUncertain, kPosition, &E::sigma, p.sigma_ratio_max * healthy().other_sigma, kMore},
      {Gate::kOldCorrections, kPosition, &E::differential_age_s, p.differential_age_max_s, kMore},
      {Gate::kOldCorrections, kVelocity, &E::solution_age_s, p.solution_age_max_s, kMore},
      {Gate::kWrongBaseline, kHeading, &E::baseline_error_m, p.baseline_tolerance_m, kMore},
      {Gate::kWrongBaseline, kHeading, &E::baseline_error_m, -p.baseline_tolerance_m, -kMore},
      {Gate::kOutlier, kAttitude, &E::residual, healthy().jump_min, kMore},
      {Gate::kOutlier, kPosition, &E::residual, 0.2, kMore, [](E& e) { e.jump_sigma_max = 0.2; }},
      {Gate::kDisagrees, kVelocity, &E::apart, healthy().apart_max, kMore,
       [](E& e) { e.stray = 0.2; }},
      {Gate::kDisagrees, kHeading, &E::stray, p.worse_factor * healthy().other_stray, kMore,
       [](E& e) { e.apart = 0.2; }},
      {Gate::kOffCourse, kHeading, &E::course_error_rad, p.course_max_rad, kMore},
      {Gate::kOffCourse, kAttitude, &E::course_error_rad, -p.course_max_rad, -kMore}};
  return all;
}

TEST(CheckTable, AtItsLimitANumberPassesAndBeyondItNot) {
  for (const Limit& limit : limits()) {
    Evidence e = healthy(limit.source);
    limit.prepare(e);
    e.*limit.number = limit.at;
    EXPECT_EQ(judge(e, {}, {}).gate, Gate::kAccepted) << text_of(limit.reason) << " " << limit.at;
    e.*limit.number = std::nextafter(limit.at, limit.beyond);
    EXPECT_EQ(judge(e, {}, {}).gate, limit.reason) << limit.at;
  }
}

TEST(CheckTable, UnitsThatAreJustNotApartAreNotSeen) {
  Evidence e = healthy();
  e.apart = e.apart_max;
  EXPECT_TRUE(judge(e, {}, {}).seen.empty());
  e.apart = std::nextafter(e.apart_max, 1.0);
  EXPECT_TRUE(judge(e, {}, {}).seen.has(Monitor::kUnitAgreement));
}

// Of what cannot be read no number means anything.
TEST(CheckTable, WhatFailsTheFormIsNotLookedAtAnyFurther) {
  Evidence e = healthy();
  e.finite = false;
  e.residual = 100.0, e.sigma = 100.0, e.age_s = 100.0;
  const Judged judged = judge(e, {}, {});
  EXPECT_EQ(judged.gate, Gate::kNotFinite);
  EXPECT_TRUE(judged.seen.empty());
}

TEST(CheckTable, AFaultOfAnotherSourceIsNone) {
  Evidence position = healthy();
  position.baseline_error_m = 5.0;
  EXPECT_EQ(judge(position, {}, {}).gate, Gate::kAccepted);
  Evidence imu = healthy(Source::kImu);
  imu.residual = 100.0;
  EXPECT_EQ(judge(imu, {}, {}).gate, Gate::kAccepted);
}

// Two units that come apart are seen in both, and only the one that strays is refused.
TEST(CheckTable, TheOneThatStraysIsToBlame) {
  Evidence e = healthy();
  e.apart = 0.2;
  for (const bool strays : {false, true}) {
    e.stray = strays ? 0.2 : 0.01;
    e.other_stray = strays ? 0.01 : 0.2;
    const Judged judged = judge(e, {}, {});
    EXPECT_EQ(judged.gate, strays ? Gate::kDisagrees : Gate::kAccepted);
    EXPECT_TRUE(judged.seen.has(Monitor::kUnitAgreement));
  }
}

TEST(CheckTable, AtRestAContentMayRepeat) {
  Evidence e = healthy();
  e.same_content = true;
  e.speed_mps = 0.5;
  EXPECT_EQ(judge(e, {}, {}).gate, Gate::kAccepted);
}

TEST(CheckTable, AReceiverThatIsAloneIsHeardEvenWhenItComplains) {
  Evidence e = healthy();
  e.receiver_well = false;
  EXPECT_EQ(judge(e, {}, {}).gate, Gate::kAccepted);
}

}  // namespace
}  // namespace pitwall::localization
