// Gate: every order of issue, press, release, handover, expiry, loss, doubling, reordering, moves
// of the base, a relay and restarts of both ends, within the budgets below, keeps the laws of
// commands, stop, authority and addresses.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <iostream>

#include "tests/system/radio_explorer/explorer.hpp"

namespace pitwall::explorer {
namespace {

constexpr std::size_t kAll = 39;  // deeper than any budget below leads
constexpr std::size_t kWorldsMax = 6'000'000;

// Each budget is visited to its end: no world has an action left that is not in it.
constexpr Budget kCommands{.issues = 2, .up = 2, .down = 1, .doubles = 1, .waits = 2};
constexpr Budget kRestarts{.issues = 2,
                           .up = 2,
                           .down = 1,
                           .doubles = 1,
                           .waits = 1,
                           .base_restarts = 1,
                           .car_restarts = 1};
constexpr Budget kStops{.presses = 2, .releases = 1, .up = 3, .down = 2, .doubles = 1};
constexpr Budget kStopsAndRestarts{
    .presses = 2, .releases = 1, .up = 3, .down = 2, .base_restarts = 1, .car_restarts = 1};
constexpr Budget kAuthority{.issues = 1, .changes = 2, .up = 2, .doubles = 1, .waits = 3};

constexpr Budget kRoaming{.up = 4, .down = 2, .waits = 1, .moves = 2, .relays = 2};
constexpr Budget kReturns{
    .presses = 1, .up = 2, .down = 1, .waits = 2, .base_restarts = 1, .moves = 1, .relays = 1};
constexpr Budget kCommandsRoaming{.issues = 1, .up = 2, .down = 2, .waits = 2, .moves = 1};

constexpr Budget kTogether{.issues = 1,
                           .presses = 1,
                           .releases = 1,
                           .changes = 1,
                           .up = 2,
                           .down = 1,
                           .waits = 1,
                           .base_restarts = 1};

void expect_lawful(const Budget& budget, std::size_t depth_least) {
  const Explored all = explore(budget, Planted::kNone, kAll, kWorldsMax);
  std::cout << all.worlds << " worlds, " << all.transitions << " transitions, depth " << all.depth
            << '\n';
  EXPECT_FALSE(all.breach) << text_of(*all.breach);
  EXPECT_TRUE(all.exhausted);
  EXPECT_GE(all.depth, depth_least);
}

TEST(RadioExplorer, CommandsHaveOneFateInEveryOrder) { expect_lawful(kCommands, 12); }
TEST(RadioExplorer, RestartsOfEitherEndApplyNothingTwice) { expect_lawful(kRestarts, 12); }
TEST(RadioExplorer, AStopEndsByItsReleaseOnly) { expect_lawful(kStops, 12); }
TEST(RadioExplorer, AStopOutlivesRestarts) { expect_lawful(kStopsAndRestarts, 12); }
TEST(RadioExplorer, OneHolderAndNoEffectAfterItsExpiry) { expect_lawful(kAuthority, 12); }
TEST(RadioExplorer, ABaseThatMovesIsFollowedAndARelayIsNot) { expect_lawful(kRoaming, 12); }
TEST(RadioExplorer, AStopOutlivesMovesAndASpareBase) { expect_lawful(kReturns, 12); }
TEST(RadioExplorer, CommandsHaveOneFateWhereverTheBaseIs) { expect_lawful(kCommandsRoaming, 12); }
TEST(RadioExplorer, AllOfItTogether) { expect_lawful(kTogether, 12); }

// The explorer itself: faults that it must find.
void expect_found(Planted planted, const Budget& budget, Broken broken,
                  PlantedRoam roam = PlantedRoam::kNone) {
  const Explored found = explore(budget, planted, kAll, kWorldsMax, roam);
  ASSERT_TRUE(found.breach) << found.worlds << " worlds";
  EXPECT_EQ(found.breach->what, broken) << text_of(*found.breach);
}

TEST(RadioExplorer, FindsALedgerThatForgets) {
  expect_found(Planted::kForgetfulLedger, kCommands, Broken::kAppliedTwice);
}
TEST(RadioExplorer, FindsACommandTakenForYoungerThanItIs) {
  expect_found(Planted::kAgeFromReception, kCommands, Broken::kAppliedLate);
}
TEST(RadioExplorer, FindsAnAuthorityThatLatePacketsRenew) {
  expect_found(Planted::kRenewalAtReception, kAuthority, Broken::kHolderIsOld);
}
TEST(RadioExplorer, FindsAStopThatFollowsTheBase) {
  expect_found(Planted::kLatchFollows, kStopsAndRestarts, Broken::kStopWentByItself);
}
TEST(RadioExplorer, FindsAReleaseThatUndoesALaterPress) {
  expect_found(Planted::kReleaseAfterPress, kStops, Broken::kPressForgottenAtBase);
}
TEST(RadioExplorer, FindsALedgerThatAsksNobodysAuthority) {
  expect_found(Planted::kAnyConsole, kAuthority, Broken::kAppliedWithoutAuthority);
}
TEST(RadioExplorer, FindsACarThatNeverLooksWhereItWasTold) {
  expect_found(Planted::kNone, kReturns, Broken::kBaseNotFound, PlantedRoam::kNoReturn);
}
TEST(RadioExplorer, FindsACarThatBelievesTheNewestPacket) {
  expect_found(Planted::kNone, kRoaming, Broken::kWrongAddressBelieved,
               PlantedRoam::kNewestProvesAddress);
}

}  // namespace
}  // namespace pitwall::explorer
