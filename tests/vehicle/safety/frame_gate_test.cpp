// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/frame_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/vehicle/safety/frame_gate_bench.hpp"

namespace pitwall::safety {
namespace {

namespace av21 = can::av21;
using namespace testing;
using world::Mode;

TEST(FrameGate, DefaultDenyOverEveryIdAndLength) {
  for (std::uint32_t id = 0; id <= can::kMaxStandardId; ++id) {
    const can::MessageRow* row = row_of(id);
    for (std::uint8_t length = 0; length <= 8; ++length) {
      Gate g;
      Verdict expected = Verdict::kPass;
      if (row == nullptr) {
        expected = Verdict::kUnknownId;
      } else if (row->direction == can::Direction::kFromCar) {
        expected = Verdict::kWrongDirection;
      } else if (length != row->length) {
        expected = Verdict::kWrongLength;
      } else if (id == 1403 || id == 1404) {
        expected = Verdict::kOutOfRange;  // gear 0 at speed, CT state 0
      }
      ASSERT_EQ(g.one(blank(id, length)), expected) << id << ' ' << +length;
    }
  }
}

TEST(FrameGate, AnIdOfMoreBitsIsNotTheOneOfItsLowBits) {
  for (const std::uint32_t id : kOurIds) {
    for (unsigned bit = 11; bit < 32; ++bit)
      EXPECT_EQ(Gate{}.one(blank(id | 1u << bit, 8)), Verdict::kUnknownId) << id << ' ' << bit;
  }
}

TEST(FrameGate, RemoteFdAndExtendedNeverPass) {
  for (int kind = 0; kind < 3; ++kind) {
    Gate g;
    can::Frame frame = brake(100);
    frame.extended = kind == 0;
    frame.remote = kind == 1;
    frame.fd = kind == 2;
    EXPECT_EQ(g.one(frame), Verdict::kNotClassic);
  }
}

TEST(FrameGate, DisarmedOnlyReportsPass) {
  for (const Mode mode : kAllModes) {
    for (const bool armed : {false, true}) {
      if (armed && mode != Mode::kDisarmed) continue;
      for (const std::uint32_t id : kOurIds) {
        Gate g;
        g.context.mode = mode;
        g.context.armed = armed;
        EXPECT_EQ(g.one(harmless(id, 1)), id < 1404 ? Verdict::kNotArmed : Verdict::kPass) << id;
      }
    }
  }
}

TEST(FrameGate, ACommandIsFreshFor50msAndNeverFromTheFuture) {
  for (std::int64_t us = -2000; us <= 60000; us += 250) {
    Gate g;
    g.context.command_at = g.context.now - microseconds(us);
    const bool fresh = us >= 0 && us <= 50000;
    for (const std::uint32_t id : {1400u, 1401u, 1402u, 1403u})
      EXPECT_EQ(g.one(harmless(id, 1)), fresh ? Verdict::kPass : Verdict::kStale) << id << us;
    EXPECT_EQ(g.one(report(9, 3)), Verdict::kPass) << "a report needs no command";
  }
}

TEST(FrameGate, AStuckCounterIsRefusedAndAnyChangePasses) {
  for (const std::uint32_t id : {1400u, 1401u, 1402u}) {
    for (int before : {0, 1, 255}) {
      for (int counter = 0; counter < 256; ++counter) {
        Gate g;
        ASSERT_EQ(g.one(harmless(id, before)), Verdict::kPass);
        g.wait(milliseconds(10));
        const Verdict expected = counter == before ? Verdict::kStuckCounter : Verdict::kPass;
        ASSERT_EQ(g.one(harmless(id, counter)), expected) << id << ' ' << before << ' ' << counter;
      }
    }
  }
  for (int counter = 0; counter < 10; ++counter) {
    Gate g;
    ASSERT_EQ(g.one(report(9, 4)), Verdict::kPass);
    EXPECT_EQ(g.one(report(9, counter)), counter == 4 ? Verdict::kStuckCounter : Verdict::kPass);
  }
  for (const std::uint32_t id : {1403u, 1405u, 1406u, 1450u}) {
    Gate g;
    EXPECT_EQ(g.one(harmless(id, 0)), Verdict::kPass);
    EXPECT_EQ(g.one(harmless(id, 0)), Verdict::kPass) << id << " has no counter";
  }
}

TEST(FrameGate, EveryMessageHasItsOwnCounterAndARefusedFrameLeavesNone) {
  Gate g;
  for (const std::uint32_t id : {1400u, 1401u, 1402u, 1404u})
    EXPECT_EQ(g.one(harmless(id, 7)), Verdict::kPass) << id;
  EXPECT_EQ(g.one(brake(6001, 8)), Verdict::kOutOfRange);
  EXPECT_EQ(g.one(brake(0, 8)), Verdict::kPass);
  EXPECT_EQ(g.one(brake(0, 8)), Verdict::kStuckCounter);
}

TEST(FrameGate, SixteenFramesMayBeProposedInOneTick) {
  for (int proposed = 0; proposed <= 40; ++proposed) {
    Gate g;
    std::vector<can::Frame> frames;
    for (int i = 0; i < proposed; ++i) frames.push_back(brake(10, i));
    const GateOutput out = g.all(frames);
    const auto judged = static_cast<std::size_t>(std::min(proposed, 16));
    const std::uint64_t beyond = frames.size() - judged;
    ASSERT_EQ(out.frames.size(), judged);
    ASSERT_EQ(out.verdicts.size(), judged);
    for (std::size_t i = 0; i < judged; ++i) EXPECT_EQ(out.frames[i], frames[i]);
    EXPECT_EQ(out.refused_now, beyond > 0);
    EXPECT_EQ(out.first_refusal, beyond > 0 ? Verdict::kTooMany : Verdict::kPass);
    EXPECT_EQ(out.refused_total, beyond);
    EXPECT_EQ(g.count(Verdict::kTooMany), beyond);
    EXPECT_EQ(g.count(Verdict::kPass), judged);
  }
}

TEST(FrameGate, TheSixteenThatAreJudgedAreTheFirst) {
  Gate g;
  std::vector<can::Frame> frames(20, blank(7, 8));
  for (std::size_t i = 16; i < frames.size(); ++i) frames[i] = gear(3);
  const GateOutput out = g.all(frames);
  EXPECT_EQ(out.frames.size(), 0u);
  EXPECT_EQ(g.count(Verdict::kUnknownId), 16u);
  EXPECT_EQ(g.count(Verdict::kTooMany), 4u);
}

TEST(FrameGate, TheFirstRefusalIsTheFirstInTheOrderProposed) {
  Gate g;
  can::Frame remote = brake(0, 1);
  remote.remote = true;
  const GateOutput out = g.all({steer(0, 1), blank(1300, 8), blank(7, 8), brake(7000, 1), remote});
  ASSERT_EQ(out.verdicts.size(), 5u);
  constexpr std::array kExpected{Verdict::kPass, Verdict::kWrongDirection, Verdict::kUnknownId,
                                 Verdict::kOutOfRange, Verdict::kNotClassic};
  constexpr std::array kIds{1402u, 1300u, 7u, 1400u, 1400u};
  for (std::size_t i = 0; i < kExpected.size(); ++i) {
    EXPECT_EQ(out.verdicts[i].verdict, kExpected[i]);
    EXPECT_EQ(out.verdicts[i].id, kIds[i]);
  }
  EXPECT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.first_refusal, Verdict::kWrongDirection);
  EXPECT_EQ(out.refused_total, 4u);
  EXPECT_FALSE(g.all({steer(0, 2)}).refused_now) << "of this tick only";
  EXPECT_EQ(g.all({steer(0, 3)}).refused_total, 4u) << "since the start";
}

// One frame of each kind that is refused, the last reason included.
TEST(FrameGate, EveryRefusalIsCountedUnderItsOwnReason) {
  Gate g;
  can::Frame remote = brake(0);
  remote.remote = true;
  ASSERT_FALSE(g.all({brake(200, 0), throttle(2, 0), gear(3), report(9, 1)}).refused_now);
  g.wait(milliseconds(1));
  g.all({blank(7, 8), blank(1300, 8), remote, blank(1405, 7), brake(200, 0), report(99, 2),
         brake(900, 1), gear(5), throttle(2.2, 1)});
  g.context.mode = Mode::kHalted;
  g.all({throttle(1, 2), brake(100, 1)});
  g.context.mode = Mode::kControlledStop;
  g.all({throttle(3, 2), report(11, 3)});
  g.context.command_at = g.context.now + nanoseconds(1);
  g.all({steer(0, 0)});
  g.context.armed = false;
  g.all({steer(0, 0)});
  for (std::size_t i = 0; i < 31; ++i) g.all({blank(1450, 8)});
  EXPECT_EQ(g.all({blank(1450, 8)}).first_refusal, Verdict::kTooOften);
  const GateOutput last = g.all(std::vector<can::Frame>(17, blank(1406, 7)));
  EXPECT_EQ(g.count(Verdict::kWrongLength), 1u + 16u);
  for (std::size_t v = 1; v < kVerdicts; ++v) {
    const auto verdict = static_cast<Verdict>(v);
    if (verdict == Verdict::kWrongLength) continue;
    EXPECT_EQ(g.count(verdict), 1u) << text_of(verdict);
  }
  EXPECT_EQ(g.count(Verdict::kPass), 4u + 31u);
  EXPECT_EQ(last.refused_total, kVerdicts - 2 + 17);
}

TEST(FrameGate, DisarmingForgets) {
  Gate g;
  ASSERT_FALSE(g.all({steer(0.0, 0), brake(3000, 0), gear(3)}).refused_now);
  g.wait(milliseconds(10));
  g.context.armed = false;
  EXPECT_EQ(g.one(steer(1.0, 1)), Verdict::kNotArmed);
  g.context.armed = true;
  g.wait(milliseconds(10));
  EXPECT_FALSE(g.all({steer(100.0, 2), brake(0, 1), gear(6)}).refused_now)
      << "the first after arming has no reference";
  g.wait(milliseconds(10));
  EXPECT_EQ(g.one(throttle(3, 0)), Verdict::kPass) << "no brake is remembered";
}

TEST(FrameGate, WhileDisarmedThePedalCountsAsReleased) {
  for (const std::int64_t ms : {0, 1, 10, 40}) {
    for (int hundredths = 1; hundredths < 2000; hundredths += 19) {
      Gate g;
      ASSERT_EQ(g.one(throttle(80.0, 0)), Verdict::kPass);
      g.context.mode = Mode::kDisarmed;
      g.all({});
      g.context.mode = Mode::kDriving;
      g.wait(milliseconds(ms));
      const bool passes = hundredths <= 40 * ms + 1;
      EXPECT_EQ(g.one(throttle(hundredths / 100.0, 1)), passes ? Verdict::kPass : Verdict::kTooFast)
          << ms << ' ' << hundredths;
    }
    Gate g;
    ASSERT_EQ(g.one(throttle(80.0, 0)), Verdict::kPass);
    g.context.armed = false;
    g.all({});
    g.context.armed = true;
    g.context.mode = Mode::kEmergencyStop;
    EXPECT_EQ(g.one(throttle(0.01, 1)), Verdict::kThrottleRises);
  }
}

TEST(FrameGate, NothingIsArmedUnlessSomebodySaysSo) {
  const GateContext context;
  EXPECT_EQ(context.mode, Mode::kDisarmed);
  EXPECT_FALSE(context.armed);
  EXPECT_TRUE(std::isnan(context.speed_mps));
}

TEST(FrameGate, EveryVerdictHasItsOwnText) {
  std::vector<std::string> texts;
  for (std::size_t v = 0; v < kVerdicts; ++v) texts.emplace_back(text_of(static_cast<Verdict>(v)));
  EXPECT_EQ(texts.front(), "pass");
  EXPECT_EQ(texts.back(), "engine off while moving");
  for (const std::string& text : texts) EXPECT_FALSE(text.empty());
  std::sort(texts.begin(), texts.end());
  EXPECT_EQ(std::unique(texts.begin(), texts.end()), texts.end());
}

}  // namespace
}  // namespace pitwall::safety
