// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/guardian_node.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hil/bench/flying_lap.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;

faults::BenchFault of(BenchFaultKind kind, double from_s, double until_s) {
  return {.kind = kind, .start = at_s(from_s), .duration = from_seconds(until_s - from_s)};
}

GuardianNode node(std::vector<faults::BenchFault> processes, bool present = false) {
  return {lap().setup.params, std::move(processes), present};
}

TEST(GuardianNode, IsThereWhereAProcessIsBrokenOrWhenAskedFor) {
  EXPECT_FALSE(node({}).present());
  EXPECT_TRUE(node({}, true).present());
  EXPECT_TRUE(node({of(BenchFaultKind::kComputerPaused, 1, 2)}).present());
}

TEST(GuardianNode, AComputerThatIsPausedGoesOnAndIsNoNewOne) {
  GuardianNode n = node({of(BenchFaultKind::kComputerPaused, 1, 2)});
  for (const double t : {0.9, 1.0, 1.99, 2.0}) {
    EXPECT_EQ(n.car_runs(at_s(t)), t < 1.0 || t >= 2.0) << t;
    EXPECT_FALSE(n.car_restarts(at_s(t))) << t;
  }
  EXPECT_TRUE(n.armed_from_the_start());
}

TEST(GuardianNode, AComputerThatWasKilledForATimeIsANewOneAndNotArmed) {
  GuardianNode n = node({of(BenchFaultKind::kComputerKilled, 1, 2)});
  int restarts = 0;
  for (double t = 0.0; t < 3.0; t += 0.01) {
    const bool restarted = n.car_restarts(at_s(t));
    restarts += restarted ? 1 : 0;
    EXPECT_TRUE(!restarted || std::abs(t - 2.0) < 0.011) << t;
  }
  EXPECT_EQ(restarts, 1);
  EXPECT_FALSE(n.armed_from_the_start());
}

TEST(GuardianNode, ADeadGuardianLeavesItsLastWordBehind) {
  GuardianNode n = node({of(BenchFaultKind::kGuardianKilled, 1, 9)});
  const world::SensorInput none;
  EXPECT_TRUE(n.step(none, at_s(0.5)).empty());
  EXPECT_EQ(n.status().at, at_s(0.5));
  EXPECT_TRUE(n.step(none, at_s(1.5)).empty());
  EXPECT_FALSE(n.view(at_s(1.5)).drives);
}

}  // namespace
}  // namespace pitwall::bench
