// SPDX-License-Identifier: Apache-2.0
// What many frames together may do: rates, slews over any span, random traffic.
#include "vehicle/safety/frame_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/vehicle/safety/frame_gate_bench.hpp"
#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

namespace av21 = can::av21;
using namespace testing;
using world::Mode;

TEST(FrameGateTraffic, ARefusedFrameIsNoReferenceForTheNext) {
  Gate g;
  ASSERT_EQ(g.one(steer(0.0, 0)), Verdict::kPass);
  for (int i = 1; i <= 5; ++i) {
    g.wait(milliseconds(1));
    ASSERT_EQ(g.one(steer(60.0, i)), Verdict::kTooFast);
  }
  EXPECT_EQ(g.state.memory.steer_deg.value, 0.0);
  EXPECT_EQ(g.state.verdicts[static_cast<std::size_t>(Verdict::kTooFast)], 5u);
}

// A step of rounding is granted once, not once a frame: what panda's limit over 250 ms guards.
TEST(FrameGateTraffic, ManyFramesMayNotDoWhatOneMayNot) {
  for (const double sign : {1.0, -1.0}) {
    for (const std::int64_t gap_us : {0, 500, 1000, 8065, 10000}) {
      Gate g;
      g.context.speed_mps = 10.0;
      double deg = 0.0, kpa = 3000.0;
      ASSERT_FALSE(g.all({steer(deg, 0), brake(kpa, 0)}).refused_now);
      const Instant start = g.context.now;
      for (int i = 1; i <= 30; ++i) {  // as greedy as the gate allows
        g.wait(microseconds(gap_us));
        while (std::abs(deg) < 200.0 && g.one(steer(deg + 0.5 * sign, i)) == Verdict::kPass) {
          deg += 0.5 * sign;
          ++i;
        }
        if (g.one(brake(kpa + sign, i)) == Verdict::kPass) kpa += sign;
        const double elapsed_s = (g.context.now - start).seconds();
        ASSERT_LE(std::abs(deg), 720.0 * elapsed_s + 0.5 + 1e-9) << gap_us;
        ASSERT_LE(std::abs(kpa - 3000.0), 60000.0 * elapsed_s + 1.0 + 1e-9) << gap_us;
      }
    }
  }
}

TEST(FrameGateTraffic, SilenceIsNoReasonToRefuseForEver) {
  Gate g;
  g.context.speed_mps = 0.0;
  ASSERT_FALSE(g.all({steer(-200, 0), brake(0, 0), throttle(0, 0)}).refused_now);
  g.wait(seconds(1));
  EXPECT_FALSE(g.all({steer(200, 1), throttle(100, 1)}).refused_now);
  g.wait(seconds(1));
  EXPECT_EQ(g.one(brake(6000, 1)), Verdict::kPass);
}

TEST(FrameGateTraffic, TheRateCapHoldsInEveryWindow) {
  for (const std::uint32_t id : kOurIds) {
    const double period_s = row_of(id)->period.seconds();
    const auto cap = static_cast<std::size_t>(0.25 / period_s * 1.2 + 1.0);
    Gate g;
    std::vector<Instant> passed;
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
      g.wait(microseconds(500));
      const int counter = static_cast<int>(passed.size());  // a refused frame is sent again
      const Verdict verdict = g.one(harmless(id, counter));
      if (verdict == Verdict::kPass) passed.push_back(g.context.now);
      if (verdict == Verdict::kTooOften) ++refused;
      ASSERT_TRUE(verdict == Verdict::kPass || verdict == Verdict::kTooOften) << id;
    }
    EXPECT_GT(refused, 0) << id;
    ASSERT_GE(passed.size(), 3 * cap) << id;
    for (std::size_t i = 0; i + cap < passed.size(); ++i)
      ASSERT_GE(passed[i + cap] - passed[i], milliseconds(250)) << id;
    // Not less than the cap either: the first window is full, and its end lets the next frame in.
    EXPECT_LT(passed[cap - 1] - passed[0], milliseconds(250)) << id;
    EXPECT_EQ(passed[cap] - passed[0], milliseconds(250)) << id;
  }
}

// Commands around the last that passed, and now and then noise.
std::vector<can::Frame> proposal(Random& random, int i, double last_throttle, double last_steer) {
  std::vector<can::Frame> frames;
  frames.push_back(brake(random.between(0, 7000) * (random.one_in(2) ? 1 : 0), i));
  frames.push_back(throttle(last_throttle + random.between(-20, 6), i));
  frames.push_back(steer(last_steer + random.between(-9, 9), i));
  if (random.one_in(3)) {
    can::Frame noise = blank(1400u + static_cast<std::uint32_t>(random.below(8)), 8);
    for (std::size_t b = 0; b < 8; ++b) noise.data[b] = static_cast<std::uint8_t>(random.next());
    frames.push_back(noise);
  }
  return frames;
}

TEST(FrameGateTraffic, RandomFramesThatPassKeepEveryLimit) {
  Random random{77};
  Gate g;
  double last_steer = 0.0, last_throttle = 0.0, last_brake = 0.0;
  Instant steer_at{}, throttle_at{};
  bool steered = false, throttled = false, braked = false;
  std::uint64_t passed = 0, proposed = 0;
  for (int i = 0; i < 100'000; ++i) {
    g.wait(microseconds(static_cast<std::int64_t>(1000 + random.below(9000))));
    g.context.mode = kAllModes[random.below(kAllModes.size())];
    if (random.below(4) != 0) g.context.mode = Mode::kDriving;
    g.context.armed = random.below(200) != 0;
    g.context.speed_mps = random.one_in(20) ? kUnset : random.between(0, 85);
    const auto frames = proposal(random, i, last_throttle, last_steer);
    if (!g.context.armed || g.context.mode == Mode::kDisarmed) {
      steered = throttled = braked = false;
      last_throttle = 0.0;
    }
    const GateOutput out = g.all(frames);
    proposed += frames.size();
    passed += out.frames.size();
    ASSERT_EQ(out.verdicts.size(), frames.size());
    for (const can::Frame& frame : out.frames) {  // the brake is judged first
      av21::BrakePressureCmd b;
      if (!av21::decode(frame, b)) continue;
      ASSERT_TRUE(g.context.armed && g.context.mode != Mode::kDisarmed);
      ASSERT_LE(b.brake_pressure_cmd, 6000.0);
      last_brake = b.brake_pressure_cmd;
      braked = true;
    }
    for (const can::Frame& frame : out.frames) {
      av21::SteeringCmd s;
      if (av21::decode(frame, s)) {
        const double deg = s.steering_motor_ang_cmd;
        ASSERT_LE(std::abs(deg), steer_limit_deg(g.params, g.context.speed_mps));
        if (steered) {
          ASSERT_LE(std::abs(deg - last_steer),
                    720.0 * (g.context.now - steer_at).seconds() + 0.5 + 1e-9);
        }
        last_steer = deg;
        steer_at = g.context.now;
        steered = true;
      }
      av21::AcceleratorCmd t;
      if (av21::decode(frame, t)) {
        const double percent = t.acc_pedal_cmd;
        ASSERT_TRUE(percent >= 0.0 && percent <= 100.0);
        ASSERT_FALSE(braked && percent > 2.0 && last_brake > 100.0);
        const Mode mode = g.context.mode;
        if (mode == Mode::kStandby || mode == Mode::kHalted) {
          ASSERT_EQ(percent, 0.0);
        } else if (mode != Mode::kDriving && percent > 0.0) {
          ASSERT_TRUE(throttled && percent <= last_throttle);
        }
        if (throttled) {
          ASSERT_LE(percent - last_throttle,
                    400.0 * (g.context.now - throttle_at).seconds() + 0.01 + 1e-9);
        }
        last_throttle = percent;
        throttle_at = g.context.now;
        throttled = true;
      }
    }
  }
  EXPECT_GT(passed, 50'000u);
  EXPECT_LT(passed, proposed);
}

}  // namespace
}  // namespace pitwall::safety
