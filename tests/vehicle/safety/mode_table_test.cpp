// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/mode_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

using world::Mode;

Events from_bits(unsigned bits) {
  Events events{};
  for (std::size_t e = 0; e < kEvents; ++e) events[e] = (bits >> e & 1u) != 0;
  return events;
}
bool has(const Events& events, Event e) { return events[static_cast<std::size_t>(e)]; }

TEST(ModeTable, EveryCombinationOfEventsInEveryModeKeepsTheLaws) {
  for (std::size_t m = 0; m < world::kModes; ++m) {
    for (unsigned bits = 0; bits < 1u << kEvents; ++bits) {
      const auto from = static_cast<Mode>(m);
      const Events events = from_bits(bits);
      const Mode to = next(from, events);
      if (bits == 0) {
        EXPECT_EQ(to, from);
      }
      if (has(events, Event::kDriveByWireGone)) {
        EXPECT_TRUE(to == Mode::kDisarmed || from == Mode::kDisarmed) << bits;
        continue;
      }
      if (has(events, Event::kEmergency) || has(events, Event::kStop)) {
        EXPECT_FALSE(follows_the_drive(from) && follows_the_drive(to)) << bits;
      }
      if (from == Mode::kDriving && has(events, Event::kCoast)) {
        EXPECT_NE(to, Mode::kDriving) << "what may pass takes the throttle away";
      }
      if (to == Mode::kCoast) {
        EXPECT_TRUE(from == Mode::kCoast || (from == Mode::kDriving && has(events, Event::kCoast)));
      }
      if (has(events, Event::kEmergency) && follows_the_drive(from)) {
        EXPECT_EQ(to, Mode::kEmergencyStop);
      }
      if (stops(from) && has(events, Event::kStandstill) &&
          !(from == Mode::kControlledStop && has(events, Event::kEmergency))) {
        EXPECT_EQ(to, Mode::kHalted) << "a fault that stays must not hide the standstill";
      }
      if (from == Mode::kHalted) {
        EXPECT_EQ(to, has(events, Event::kReset) ? Mode::kDisarmed : Mode::kHalted);
      }
    }
  }
}

TEST(ModeTable, RandomSequencesNeverDriveAfterAFaultWithoutAReset) {
  Random random{42};
  bool faulted = false;  // the shadow: a fault while driving, until a reset at standstill
  std::set<Mode> seen;
  Mode mode = Mode::kDisarmed;
  int drives = 0;
  for (int i = 0; i < 500'000; ++i) {
    unsigned bits = static_cast<unsigned>(random.next()) & static_cast<unsigned>(random.next());
    if (random.below(3) != 0) bits &= ~7u;   // often without faults
    if (random.below(2) != 0) bits &= ~15u;  // and without what coasts
    if (random.below(50) != 0) bits &= ~1u;
    const Events events = from_bits(bits & ((1u << kEvents) - 1u));
    const Mode before = mode;
    mode = next(mode, events);
    if (follows_the_drive(before) && (has(events, Event::kEmergency) || has(events, Event::kStop)))
      faulted = true;
    if (before == Mode::kHalted && has(events, Event::kReset)) faulted = false;
    // Disarmed by itself: the supervisor lets no old request arm again.
    if (has(events, Event::kDriveByWireGone)) faulted = false;
    ASSERT_FALSE(faulted && follows_the_drive(mode)) << "step " << i;
    drives += mode == Mode::kDriving;
    seen.insert(mode);
  }
  EXPECT_EQ(seen.size(), world::kModes);
  EXPECT_GT(drives, 1000);
}

TEST(ModeTable, TheWayThroughADay) {
  Mode mode = Mode::kDisarmed;
  const auto after = [&](Event e) { return mode = next(mode, e); };
  EXPECT_EQ(after(Event::kGo), Mode::kDisarmed);
  EXPECT_EQ(after(Event::kArm), Mode::kStandby);
  EXPECT_EQ(after(Event::kStop), Mode::kStandby);
  EXPECT_EQ(after(Event::kDisarm), Mode::kDisarmed);
  EXPECT_EQ(after(Event::kArm), Mode::kStandby);
  EXPECT_EQ(after(Event::kGo), Mode::kDriving);
  EXPECT_EQ(after(Event::kStandstill), Mode::kDriving) << "a red flag is no fault";
  EXPECT_EQ(after(Event::kDisarm), Mode::kControlledStop);
  EXPECT_EQ(after(Event::kGo), Mode::kControlledStop);
  EXPECT_EQ(after(Event::kEmergency), Mode::kEmergencyStop);
  EXPECT_EQ(after(Event::kReset), Mode::kEmergencyStop);
  EXPECT_EQ(after(Event::kStandstill), Mode::kHalted);
  EXPECT_EQ(after(Event::kReset), Mode::kDisarmed);
}

// The table a second time, by what a race engineer expects of each cell.
TEST(ModeTable, EveryCell) {
  using enum Mode;
  struct Row {
    Mode from;
    std::array<Mode, kEvents> to;  // in the order of Event
  };
  constexpr Mode kC = kControlledStop, kE = kEmergencyStop;
  const std::array<Row, world::kModes> rows{{
      {kDisarmed,
       {kDisarmed, kDisarmed, kDisarmed, kDisarmed, kDisarmed, kDisarmed, kDisarmed, kDisarmed,
        kStandby, kDisarmed}},
      {kStandby,
       {kDisarmed, kE, kStandby, kStandby, kStandby, kDisarmed, kStandby, kStandby, kStandby,
        kDriving}},
      {kDriving, {kDisarmed, kE, kC, kCoast, kDriving, kC, kDriving, kDriving, kDriving, kDriving}},
      {kC, {kDisarmed, kE, kC, kC, kHalted, kC, kC, kC, kC, kC}},
      {kE, {kDisarmed, kE, kE, kE, kHalted, kE, kE, kE, kE, kE}},
      {kHalted,
       {kDisarmed, kHalted, kHalted, kHalted, kHalted, kHalted, kDisarmed, kHalted, kHalted,
        kHalted}},
      {kCoast, {kDisarmed, kE, kC, kCoast, kCoast, kC, kCoast, kDriving, kCoast, kCoast}},
  }};
  for (std::size_t m = 0; m < world::kModes; ++m) {
    EXPECT_EQ(static_cast<std::size_t>(rows[m].from), m);
    for (std::size_t e = 0; e < kEvents; ++e)
      EXPECT_EQ(next(rows[m].from, static_cast<Event>(e)), rows[m].to[e]) << m << ' ' << e;
  }
}

TEST(ModeTable, WhereNobodyObeysEveryModeEndsDisarmed) {
  for (std::size_t m = 0; m < world::kModes; ++m)
    EXPECT_EQ(next(static_cast<Mode>(m), Event::kDriveByWireGone), Mode::kDisarmed) << m;
}

}  // namespace
}  // namespace pitwall::safety
