// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/frame_fault.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <vector>

#include "tests/hil/faults/av21_frames.hpp"

namespace pitwall::faults {
namespace {

namespace av21 = can::av21;

constexpr Instant kStart = Instant{} + seconds(1);

can::Frame steering(double deg, double counter) {
  return frame_of(av21::SteeringReport{.steering_motor_ang_avg_fdbk = deg,
                                       .steering_motor_fdbk_counter = counter});
}

FrameFault fault_of(FrameFaultKind kind) {
  return {.kind = kind, .id = av21::SteeringReport::kId, .start = kStart, .duration = seconds(1)};
}

// One steering report every 10 ms for 3 s, value and counter running; what comes out, by tick.
std::vector<TimedFrames> run(const std::vector<FrameFault>& faults, FrameFaultState& state) {
  std::vector<TimedFrames> out;
  for (int i = 0; i < 300; ++i)
    out.push_back(
        apply(faults, state, steering(0.5 * (i % 200), i % 256), Instant{} + milliseconds(10) * i));
  return out;
}
std::vector<TimedFrames> run(const FrameFault& fault) {
  FrameFaultState state;
  return run(std::vector{fault}, state);
}

bool in_fault(int i) { return i >= 100 && i < 200; }

TEST(FrameFault, OutsideItsTimeEveryKindChangesNothing) {
  for (std::size_t k = 0; k < kFrameFaultKinds; ++k) {
    FrameFault fault = fault_of(static_cast<FrameFaultKind>(k));
    fault.delay = milliseconds(3);
    fault.value = 50.0;
    const auto out = run(fault);
    int changed = 0;
    for (int i = 0; i < 300; ++i) {
      const auto& frames = out[static_cast<std::size_t>(i)];
      const Instant at = Instant{} + milliseconds(10) * i;
      const bool same = frames.size() == 1 && frames[0].at == at &&
                        frames[0].frame == steering(0.5 * (i % 200), i % 256);
      ASSERT_TRUE(same || in_fault(i)) << name_of(fault.kind) << " at " << i;
      changed += same ? 0 : 1;
    }
    // The report has no checksum, and is not the one that a masquerade speaks beside.
    if (fault.kind == FrameFaultKind::kWrongChecksum || fault.kind == FrameFaultKind::kMasquerade) {
      EXPECT_EQ(changed, 0) << name_of(fault.kind);
      continue;
    }
    // A frozen value begins as it was, noise may be nothing.
    const int least = fault.kind == FrameFaultKind::kSignalNoise ? 95 : 99;
    EXPECT_GE(changed, least) << name_of(fault.kind);
  }
}

TEST(FrameFault, OtherIdentifiersPass) {
  for (std::size_t k = 0; k < kFrameFaultKinds; ++k) {
    FrameFaultState state;
    const std::vector<FrameFault> faults{fault_of(static_cast<FrameFaultKind>(k))};
    can::Frame other;
    other.id = 1340;
    other.length = 8;
    const auto out = apply(faults, state, other, kStart);
    ASSERT_EQ(out.size(), 1U);
    EXPECT_EQ(out[0].frame, other);
  }
}

TEST(FrameFault, OneSeedOneSequence) {
  for (const FrameFaultKind kind :
       {FrameFaultKind::kDrop, FrameFaultKind::kDropBurst, FrameFaultKind::kBitFlip,
        FrameFaultKind::kDuplicate, FrameFaultKind::kUnknownId, FrameFaultKind::kDelay}) {
    FrameFault fault = fault_of(kind);
    fault.probability = 0.5;
    fault.jitter = milliseconds(5);
    fault.count = 2;
    const auto bytes = [&](std::uint64_t seed) {
      fault.seed = seed;
      std::vector<std::uint8_t> all;
      for (const TimedFrames& frames : run(fault))
        for (const TimedFrame& t : frames) {
          all.push_back(static_cast<std::uint8_t>(t.at.ns));
          for (const std::uint8_t b : t.frame.payload()) all.push_back(b);
        }
      return all;
    };
    EXPECT_EQ(bytes(7), bytes(7)) << name_of(kind);
    EXPECT_NE(bytes(7), bytes(8)) << name_of(kind);
  }
}

TEST(FrameFault, DropsAtItsProbability) {
  FrameFault fault{.kind = FrameFaultKind::kDrop, .probability = 0.3};
  FrameFaultState state;
  int lost = 0;
  constexpr int kFrames = 20'000;
  for (int i = 0; i < kFrames; ++i)
    lost += apply(std::vector{fault}, state, steering(1.0, 0), Instant{}).empty() ? 1 : 0;
  EXPECT_NEAR(lost, 0.3 * kFrames, 5.0 * 65.0);  // 5 sigma
  EXPECT_EQ(state.faults[0].acted, static_cast<std::uint64_t>(lost));
}

TEST(FrameFault, ABurstIsSoManyFramesLong) {
  FrameFault fault = fault_of(FrameFaultKind::kDropBurst);
  fault.probability = 0.02;
  fault.count = 5;
  fault.duration.reset();
  FrameFaultState state;
  int run_length = 0, bursts = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (apply(std::vector{fault}, state, steering(1.0, 0), kStart).empty()) {
      ++run_length;
      continue;
    }
    ASSERT_EQ(run_length % 5, 0);  // bursts may follow one another
    bursts += run_length / 5;
    run_length = 0;
  }
  EXPECT_GT(bursts, 200);
}

TEST(FrameFault, DropAllWithoutAnIdentifierSilencesTheBus) {
  FrameFault fault{.kind = FrameFaultKind::kDropAll};
  FrameFaultState state;
  for (const std::uint32_t id : {0U, 1200U, 1343U, 2047U}) {
    can::Frame f;
    f.id = id;
    EXPECT_TRUE(apply(std::vector{fault}, state, f, Instant{}).empty());
  }
}

TEST(FrameFault, DelayLiesBetweenDelayAndDelayPlusJitter) {
  FrameFault fault = fault_of(FrameFaultKind::kDelay);
  fault.delay = milliseconds(20);
  fault.jitter = milliseconds(5);
  const auto out = run(fault);
  std::set<std::int64_t> seen;
  for (int i = 100; i < 200; ++i) {
    const Duration late =
        out[static_cast<std::size_t>(i)][0].at - (Instant{} + milliseconds(10) * i);
    ASSERT_GE(late, fault.delay);
    ASSERT_LE(late, fault.delay + fault.jitter);
    seen.insert(late.ns);
  }
  EXPECT_GT(seen.size(), 90U);
}

TEST(FrameFault, DuplicatesAreEqualToTheOriginal) {
  FrameFault fault = fault_of(FrameFaultKind::kDuplicate);
  fault.count = 3;
  const auto out = run(fault);
  for (std::size_t i = 100; i < 200; ++i) {
    ASSERT_EQ(out[i].size(), 4U);
    for (const TimedFrame& t : out[i]) ASSERT_EQ(t.frame, out[i][0].frame);
  }
}

TEST(FrameFault, FlipsExactlySoManyBitsOfThePayload) {
  for (const std::uint32_t bits : {1U, 2U, 7U, 24U, 99U}) {
    FrameFault fault = fault_of(FrameFaultKind::kBitFlip);
    fault.count = bits;
    const auto out = run(fault);
    for (int i = 100; i < 200; ++i) {
      const can::Frame before = steering(0.5 * (i % 200), i % 256);
      const can::Frame& after = out[static_cast<std::size_t>(i)][0].frame;
      ASSERT_EQ(after.id, before.id);
      ASSERT_EQ(after.length, before.length);
      std::uint32_t flipped = 0;
      for (std::size_t b = 0; b < can::kMaxDataBytes; ++b)
        flipped += static_cast<std::uint32_t>(
            std::popcount(static_cast<std::uint8_t>(before.data[b] ^ after.data[b])));
      ASSERT_EQ(flipped, std::min(bits, 24U));  // 3 bytes
    }
  }
}

TEST(FrameFault, AStuckCounterKeepsTheValueLive) {
  const auto out = run(fault_of(FrameFaultKind::kStuckCounter));
  for (int i = 100; i < 200; ++i) {
    const auto m = decoded<av21::SteeringReport>(out[static_cast<std::size_t>(i)][0].frame);
    ASSERT_EQ(m.steering_motor_fdbk_counter, 100.0);
    ASSERT_EQ(m.steering_motor_ang_avg_fdbk, 0.5 * (i % 200));
  }
}

TEST(FrameFault, ACounterJumpIsAheadByItsCountModuloTheField) {
  FrameFault fault = fault_of(FrameFaultKind::kCounterJump);
  fault.count = 200;
  const auto out = run(fault);
  for (int i = 100; i < 200; ++i) {
    const auto m = decoded<av21::SteeringReport>(out[static_cast<std::size_t>(i)][0].frame);
    ASSERT_EQ(m.steering_motor_fdbk_counter, (i + 200) % 256);
    ASSERT_EQ(m.steering_motor_ang_avg_fdbk, 0.5 * (i % 200));
  }
}

TEST(FrameFault, AFrozenValueHasALiveCounter) {
  const auto out = run(fault_of(FrameFaultKind::kFrozenValue));
  for (int i = 100; i < 200; ++i) {
    const auto m = decoded<av21::SteeringReport>(out[static_cast<std::size_t>(i)][0].frame);
    ASSERT_EQ(m.steering_motor_fdbk_counter, i);
    ASSERT_EQ(m.steering_motor_ang_avg_fdbk, 50.0);
  }
}

// The counter that crosses a byte: bits 19..26 of misc_report.
TEST(FrameFault, CountersThatCrossAByteAreRewrittenToo) {
  FrameFault fault{.kind = FrameFaultKind::kCounterJump, .count = 3};
  FrameFaultState state;
  for (int c = 0; c < 256; ++c) {
    can::Frame f;
    can::EncodeCounters ignored;
    const av21::MiscReport in{.battery_voltage = 12.5,
                              .sys_state = 9.0,
                              .mode_switch_state = 1.0,
                              .raptor_rolling_counter = static_cast<double>(c),
                              .safety_switch_state = 5.0};
    ASSERT_TRUE(av21::encode(in, f, ignored));
    const auto out = apply(std::vector{fault}, state, f, Instant{});
    av21::MiscReport m;
    ASSERT_TRUE(av21::decode(out[0].frame, m));
    ASSERT_EQ(m.raptor_rolling_counter, (c + 3) % 256);
    ASSERT_EQ(m.battery_voltage, 12.5);
    ASSERT_EQ(m.sys_state, 9.0);
    ASSERT_EQ(m.mode_switch_state, 1.0);
    ASSERT_EQ(m.safety_switch_state, 5.0);
  }
}

TEST(FrameFault, AWrongLengthIsNeverTheRightOne) {
  FrameFault fault{.kind = FrameFaultKind::kWrongLength};
  FrameFaultState state;
  for (std::uint8_t length = 0; length <= 8; ++length) {
    can::Frame f;
    f.length = length;
    const auto out = apply(std::vector{fault}, state, f, Instant{});
    EXPECT_NE(out[0].frame.length, length);
    EXPECT_LE(out[0].frame.length, 8);
  }
}

TEST(FrameFault, AnUnknownIdentifierComesBesideTheFrame) {
  const auto out = run(fault_of(FrameFaultKind::kUnknownId));
  for (std::size_t i = 100; i < 200; ++i) {
    ASSERT_EQ(out[i].size(), 2U);
    EXPECT_EQ(out[i][0].frame.id, av21::SteeringReport::kId);
    EXPECT_EQ(out[i][1].frame.id, 0x7A0U);
  }
  for (const can::MessageRow& row : av21::kMessages) EXPECT_NE(row.id, FrameFault{}.other_id);
}

TEST(FrameFault, FaultsActInTheOrderOfTheList) {
  FrameFaultState a, b;
  FrameFault twice = fault_of(FrameFaultKind::kDuplicate);
  FrameFault gone = fault_of(FrameFaultKind::kDropAll);
  EXPECT_TRUE(run({twice, gone}, a)[150].empty());
  FrameFault freeze = fault_of(FrameFaultKind::kStuckCounter);
  const auto out = run({twice, freeze}, b);
  EXPECT_EQ(out[150].size(), 2U);
  for (const TimedFrame& t : out[150])
    EXPECT_EQ(decoded<av21::SteeringReport>(t.frame).steering_motor_fdbk_counter, 100.0);
}

TEST(FrameFault, CopiesBeyondTheBoundAreCounted) {
  FrameFault many = fault_of(FrameFaultKind::kDuplicate);
  many.count = 20;
  FrameFaultState state;
  const auto out = run({many}, state);
  EXPECT_EQ(out[150].size(), kMaxCopies);
  EXPECT_EQ(state.overflow, 100U * (21U - kMaxCopies));
}

TEST(FrameFault, NamesAreUniqueAndReadBack) {
  std::set<std::string_view> names;
  for (std::size_t k = 0; k < kFrameFaultKinds; ++k) {
    const auto kind = static_cast<FrameFaultKind>(k);
    names.insert(name_of(kind));
    EXPECT_EQ(frame_fault_kind(name_of(kind)), kind);
  }
  EXPECT_EQ(names.size(), kFrameFaultKinds);
  EXPECT_FALSE(frame_fault_kind("drop_some").has_value());
}

}  // namespace
}  // namespace pitwall::faults
