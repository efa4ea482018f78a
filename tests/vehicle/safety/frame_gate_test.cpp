// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/frame_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "protocol/can/encode.hpp"
#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

namespace av21 = can::av21;
using testing::Random;
using world::Mode;

constexpr std::array kAllModes{Mode::kDisarmed,       Mode::kStandby,       Mode::kDriving,
                               Mode::kControlledStop, Mode::kEmergencyStop, Mode::kHalted};

template <class M>
can::Frame frame_of(const M& message) {
  can::Frame frame;
  can::EncodeCounters counters;
  EXPECT_TRUE(av21::encode(message, frame, counters)) << M::kName;
  return frame;
}
can::Frame steer(double deg, int counter = 0) {
  av21::SteeringCmd m;
  m.steering_motor_ang_cmd = deg;
  m.steering_motor_cmd_counter = counter & 0xFF;
  return frame_of(m);
}
can::Frame brake(double kpa, int counter = 0) {
  av21::BrakePressureCmd m;
  m.brake_pressure_cmd = kpa;
  m.brk_pressure_cmd_counter = counter & 0xFF;
  return frame_of(m);
}
can::Frame throttle(double percent, int counter = 0) {
  av21::AcceleratorCmd m;
  m.acc_pedal_cmd = percent;
  m.acc_pedal_cmd_counter = counter & 0xFF;
  return frame_of(m);
}
can::Frame gear(int number) {
  av21::GearShiftCmd m;
  m.desired_gear = number;
  return frame_of(m);
}
can::Frame report(int ct_state, int counter = 0) {
  av21::CtReport m;
  m.veh_sig_ack = m.track_cond_ack = 0;
  m.ct_state = ct_state;
  m.ct_state_rolling_counter = counter % 10;
  m.veh_num = 1;
  return frame_of(m);
}
can::Frame blank(std::uint32_t id, std::uint8_t length) {
  can::Frame frame;
  frame.id = id;
  frame.length = length;
  return frame;
}

// A gate with a clock: 20 ms after the last frame, the command fresh.
struct Gate {
  GateParams params;
  GateState state;
  GateContext context{.mode = Mode::kDriving,
                      .armed = true,
                      .speed_mps = 30.0,
                      .command_at = Instant{} + seconds(100),
                      .now = Instant{} + seconds(100)};

  void wait(Duration span) { context.command_at = context.now = context.now + span; }
  GateOutput all(const std::vector<can::Frame>& frames) {
    return gate(params, state, context, frames);
  }
  Verdict one(const can::Frame& frame) {
    const GateOutput out = all({frame});
    EXPECT_EQ(out.verdicts.size(), 1u);
    const Verdict verdict = out.verdicts[0].verdict;
    EXPECT_EQ(out.refused_now, verdict != Verdict::kPass);
    EXPECT_EQ(out.first_refusal, verdict);
    EXPECT_EQ(out.frames.size(), verdict == Verdict::kPass ? 1u : 0u);
    if (verdict == Verdict::kPass) {
      EXPECT_EQ(out.frames[0], frame) << "never repaired";
    }
    return verdict;
  }
};

const can::MessageRow* row_of(std::uint32_t id) {
  for (const can::MessageRow& row : av21::kMessages)
    if (row.id == id) return &row;
  return nullptr;
}

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
      for (const std::uint32_t id : {1400u, 1401u, 1402u, 1403u, 1405u, 1406u, 1450u}) {
        Gate g;
        g.context.mode = mode;
        g.context.armed = armed;
        EXPECT_EQ(g.one(blank(id, 8)), id < 1404 ? Verdict::kNotArmed : Verdict::kPass) << id;
      }
      Gate g;
      g.context.mode = mode;
      g.context.armed = armed;
      EXPECT_EQ(g.one(report(10)), Verdict::kPass);
    }
  }
}

TEST(FrameGate, ACommandIsFreshFor50msAndNeverFromTheFuture) {
  for (std::int64_t us = -2000; us <= 60000; us += 250) {
    Gate g;
    g.context.command_at = g.context.now - microseconds(us);
    const bool fresh = us >= 0 && us <= 50000;
    EXPECT_EQ(g.one(brake(100)), fresh ? Verdict::kPass : Verdict::kStale) << us;
    EXPECT_EQ(g.one(report(9, 3)), Verdict::kPass) << "a report needs no command";
  }
}

TEST(FrameGate, SteeringLimitOfTheTableAtEverySpeed) {
  const GateParams p;
  for (double v = 0.0; v <= 90.0; v += 2.5) {
    double limit = p.steer.back().motor_deg;
    for (std::size_t i = 1; i < kSteerRows; ++i) {
      const SteerRow &a = p.steer[i - 1], &b = p.steer[i];
      if (v < a.speed_mps || v > b.speed_mps) continue;
      limit = std::lerp(a.motor_deg, b.motor_deg, (v - a.speed_mps) / (b.speed_mps - a.speed_mps));
    }
    ASSERT_NEAR(steer_limit_deg(p, v), limit, 1e-9);
    for (double deg = -300.0; deg <= 300.0;
         deg += std::abs(std::abs(deg) - limit) < 4 ? 0.5 : 7.5) {
      Gate g;
      g.context.speed_mps = v;
      EXPECT_EQ(g.one(steer(deg)), std::abs(deg) <= limit ? Verdict::kPass : Verdict::kOutOfRange)
          << v << ' ' << deg;
    }
  }
  EXPECT_EQ(steer_limit_deg(p, -5.0), p.steer.front().motor_deg);
  EXPECT_EQ(steer_limit_deg(p, 500.0), p.steer.back().motor_deg);
  EXPECT_EQ(steer_limit_deg(p, kUnset), p.steer.back().motor_deg) << "unknown is the fastest";
  for (std::size_t i = 1; i < kSteerRows; ++i) {
    EXPECT_GT(p.steer[i].speed_mps, p.steer[i - 1].speed_mps);
    EXPECT_LE(p.steer[i].motor_deg, p.steer[i - 1].motor_deg);
  }
}

TEST(FrameGate, SteeringSlewInRealTimeBothWays) {
  for (const std::int64_t ms : {1, 5, 10, 20, 37, 100}) {
    const double allowed = 720.0 * 0.001 * static_cast<double>(ms) + 0.5;
    for (double change = -120.0; change <= 120.0;
         change += std::abs(std::abs(change) - allowed) < 3 ? 0.5 : 4.5) {
      Gate g;
      g.context.speed_mps = 10.0;
      ASSERT_EQ(g.one(steer(10.0, 0)), Verdict::kPass);
      g.wait(milliseconds(ms));
      EXPECT_EQ(g.one(steer(10.0 + change, 1)),
                std::abs(change) <= allowed ? Verdict::kPass : Verdict::kTooFast)
          << ms << ' ' << change;
    }
  }
}

TEST(FrameGate, ARefusedFrameIsNoReferenceForTheNext) {
  Gate g;
  ASSERT_EQ(g.one(steer(0.0, 0)), Verdict::kPass);
  for (int i = 1; i <= 5; ++i) {
    g.wait(milliseconds(1));
    ASSERT_EQ(g.one(steer(60.0, i)), Verdict::kTooFast);
  }
  EXPECT_EQ(g.state.steer_deg.value, 0.0);
  EXPECT_EQ(g.state.verdicts[static_cast<std::size_t>(Verdict::kTooFast)], 5u);
}

TEST(FrameGate, BrakeRangeAndSlewWithASlowerRiseThanFall) {
  for (double kpa = 0; kpa <= 8191; kpa += std::abs(kpa - 6000) < 6 ? 1 : 173) {
    Gate g;
    EXPECT_EQ(g.one(brake(kpa)), kpa <= 6000 ? Verdict::kPass : Verdict::kOutOfRange) << kpa;
  }
  for (int change = -1500; change <= 1500; ++change) {
    if (std::abs(std::abs(change) - 301) > 5 && std::abs(std::abs(change) - 601) > 5 &&
        change % 97 != 0)
      continue;
    Gate g;
    ASSERT_EQ(g.one(brake(3000, 0)), Verdict::kPass);
    g.wait(milliseconds(10));
    const bool passes = change <= 301 && change >= -601;
    EXPECT_EQ(g.one(brake(3000 + change, 1)), passes ? Verdict::kPass : Verdict::kTooFast)
        << change;
  }
}

TEST(FrameGate, EveryLimitItselfPassesAndTheNextStepDoesNot) {
  EXPECT_EQ(Gate{}.one(brake(6000)), Verdict::kPass);
  EXPECT_EQ(Gate{}.one(brake(6001)), Verdict::kOutOfRange);
  EXPECT_EQ(Gate{}.one(throttle(100.0)), Verdict::kPass);
  EXPECT_EQ(Gate{}.one(throttle(100.01)), Verdict::kOutOfRange);
  EXPECT_EQ(Gate{}.one(throttle(0.0)), Verdict::kPass);
  EXPECT_EQ(Gate{}.one(throttle(-0.01)), Verdict::kOutOfRange);
}

TEST(FrameGate, ThrottleRangeAndSlewWhereLiftingIsFree) {
  for (double percent = -100; percent <= 327; percent += 0.37) {
    Gate g;
    const can::Frame frame = throttle(percent);
    av21::AcceleratorCmd sent;
    ASSERT_TRUE(av21::decode(frame, sent));
    const bool in = sent.acc_pedal_cmd >= 0.0 && sent.acc_pedal_cmd <= 100.0;
    EXPECT_EQ(g.one(frame), in ? Verdict::kPass : Verdict::kOutOfRange) << percent;
  }
  for (int change = -5000; change <= 4900; change += 25) {  // hundredths
    Gate g;
    ASSERT_EQ(g.one(throttle(50, 0)), Verdict::kPass);
    g.wait(milliseconds(10));
    EXPECT_EQ(g.one(throttle(50 + change / 100.0, 1)),
              change <= 400 ? Verdict::kPass : Verdict::kTooFast)
        << change;
  }
}

TEST(FrameGate, ThrottleNeedsAModeThatDrivesAndNeverRisesInAStop) {
  for (const Mode mode : kAllModes) {
    if (mode == Mode::kDisarmed) continue;
    const bool stops = mode == Mode::kControlledStop || mode == Mode::kEmergencyStop;
    for (const double before : {0.0, 10.0, 40.0}) {
      for (const double percent : {0.0, 0.01, 9.99, 10.0, 10.01, 30.0}) {
        Gate g;
        ASSERT_EQ(g.one(throttle(before, 0)), Verdict::kPass);
        g.wait(seconds(1));
        g.context.mode = mode;
        Verdict expected = Verdict::kPass;
        if (mode != Mode::kDriving && percent > 0.0)
          expected = !stops             ? Verdict::kThrottleForbidden
                     : percent > before ? Verdict::kThrottleRises
                                        : Verdict::kPass;
        EXPECT_EQ(g.one(throttle(percent, 1)), expected) << static_cast<int>(mode) << percent;
      }
    }
    Gate fresh;
    fresh.context.mode = mode;
    const Verdict first = fresh.one(throttle(5));
    EXPECT_EQ(first == Verdict::kPass, mode == Mode::kDriving) << "no memory is no permission";
  }
}

TEST(FrameGate, ThrottleYieldsToBrakeWhicheverComesFirst) {
  for (const double percent : {0.0, 1.99, 2.0, 2.01, 50.0}) {
    for (const double kpa : {0.0, 99.0, 100.0, 101.0, 2000.0}) {
      for (const bool brake_first : {true, false}) {
        Gate g;
        const std::vector<can::Frame> frames = brake_first
                                                   ? std::vector{brake(kpa), throttle(percent)}
                                                   : std::vector{throttle(percent), brake(kpa)};
        const GateOutput out = g.all(frames);
        const bool contradiction = percent > 2.0 && kpa > 100.0;
        ASSERT_EQ(out.verdicts.size(), 2u);
        EXPECT_EQ(out.verdicts[brake_first ? 0 : 1].verdict, Verdict::kPass);
        EXPECT_EQ(out.verdicts[brake_first ? 1 : 0].verdict,
                  contradiction ? Verdict::kThrottleWithBrake : Verdict::kPass);
        EXPECT_EQ(out.refused_now, contradiction);
      }
    }
  }
}

TEST(FrameGate, GearsOneStepAtATimeAndNeutralOnlyStanding) {
  for (int number = 0; number < 256; ++number) {
    for (const double v : {0.0, 0.99, 1.0, 30.0, kUnset}) {
      Gate g;
      g.context.speed_mps = v;
      const bool in = (number >= 1 && number <= 6) || (number == 0 && v < 1.0);
      EXPECT_EQ(g.one(gear(number)), in ? Verdict::kPass : Verdict::kOutOfRange) << number << v;
    }
  }
  for (int from = 1; from <= 6; ++from) {
    for (int to = 1; to <= 6; ++to) {
      for (const std::int64_t ms : {99, 100}) {
        Gate g;
        ASSERT_EQ(g.one(gear(from)), Verdict::kPass);
        g.wait(milliseconds(50));
        ASSERT_EQ(g.one(gear(from)), Verdict::kPass) << "holding is no shift";
        g.wait(milliseconds(ms - 50));
        const bool passes = to == from || (std::abs(to - from) == 1 && ms >= 100);
        EXPECT_EQ(g.one(gear(to)), passes ? Verdict::kPass : Verdict::kGearStep)
            << from << to << ms;
      }
    }
  }
}

TEST(FrameGate, OnlyListedCtStates) {
  for (int ct = 0; ct < 1000; ++ct) {
    Gate g;
    const bool listed = (ct >= 1 && ct <= 12) || ct == 255;
    EXPECT_EQ(g.one(report(ct)), listed ? Verdict::kPass : Verdict::kOutOfRange) << ct;
  }
}

TEST(FrameGate, AStuckCounterIsRefusedAndAnyChangePasses) {
  for (int counter = 1; counter < 256; ++counter) {
    Gate g;
    ASSERT_EQ(g.one(brake(100, 0)), Verdict::kPass);
    g.wait(milliseconds(10));
    EXPECT_EQ(g.one(brake(100, 0)), Verdict::kStuckCounter);
    EXPECT_EQ(g.one(brake(100, counter)), Verdict::kPass);
  }
}

TEST(FrameGate, TheRateCapHoldsInEveryWindow) {
  for (const std::uint32_t id : {1400u, 1401u, 1402u, 1403u, 1404u, 1405u, 1406u, 1450u}) {
    const double period_s = row_of(id)->period.seconds();
    const auto cap = static_cast<std::size_t>(0.25 / period_s * 1.2 + 1.0);
    Gate g;
    std::vector<Instant> passed;
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
      g.wait(microseconds(500));
      const int counter = static_cast<int>(passed.size());  // a refused frame is sent again
      can::Frame frame = blank(id, 8);
      if (id == 1400) frame = brake(0, counter);
      if (id == 1401) frame = throttle(0, counter);
      if (id == 1402) frame = steer(0, counter);
      if (id == 1403) frame = gear(3);
      if (id == 1404) frame = report(9, counter);
      const Verdict verdict = g.one(frame);
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

TEST(FrameGate, MoreFramesThanOneTickMayHaveAreRefusedAndCounted) {
  Gate g;
  std::vector<can::Frame> frames;
  for (int i = 0; i < 20; ++i) frames.push_back(brake(10, i));
  const GateOutput out = g.all(frames);
  EXPECT_EQ(out.frames.size(), kMaxFrames);
  EXPECT_TRUE(out.refused_now);
  EXPECT_EQ(out.first_refusal, Verdict::kTooMany);
  EXPECT_EQ(out.refused_total, 4u);
  EXPECT_EQ(g.state.verdicts[static_cast<std::size_t>(Verdict::kTooMany)], 4u);
}

TEST(FrameGate, DisarmingForgets) {
  Gate g;
  ASSERT_EQ(g.one(steer(0.0, 0)), Verdict::kPass);
  g.context.armed = false;
  g.wait(milliseconds(10));
  EXPECT_EQ(g.one(steer(1.0, 1)), Verdict::kNotArmed);
  g.context.armed = true;
  g.wait(milliseconds(10));
  EXPECT_EQ(g.one(steer(100.0, 2)), Verdict::kPass) << "the first after arming has no reference";
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

TEST(FrameGate, RandomFramesThatPassKeepEveryLimit) {
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

TEST(FrameGate, EveryVerdictHasItsOwnText) {
  std::vector<std::string> texts;
  for (std::size_t v = 0; v < kVerdicts; ++v) texts.emplace_back(text_of(static_cast<Verdict>(v)));
  std::sort(texts.begin(), texts.end());
  EXPECT_EQ(std::unique(texts.begin(), texts.end()), texts.end());
}

}  // namespace
}  // namespace pitwall::safety
