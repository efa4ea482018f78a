// SPDX-License-Identifier: Apache-2.0
// What an attacker on the mesh can do with what he hears: nothing of it is accepted, and nothing of
// it keeps the real packets out. PITWALL_MUTATIONS sets how many of each kind are tried.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "protocol/vocabulary/bytes.hpp"
#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

int mutations() {
  const char* const wanted = std::getenv("PITWALL_MUTATIONS");
  return wanted != nullptr ? std::stoi(wanted) : 100'000;
}

class Attacks : public ::testing::TestWithParam<bool> {
 protected:
  Attacks() : rig({.signed_only = GetParam(), .paths = 2}) { rig.establish(); }

  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random() % bound); }
  bool accepted(const Datagram& datagram, PathId path = 0) {
    return rig.base->feed(datagram, kElsewhere, rig.now, path).has_value();
  }
  Datagram next() { return rig.car->seal(static_cast<std::uint32_t>(random()), rig.now); }
  // Whatever happened, the car still gets through.
  void expect_service() {
    EXPECT_TRUE(rig.base->feed(next(), kCarAddress, rig.now));
    EXPECT_TRUE(rig.car->feed(rig.base->seal(1, rig.now), kBaseAddress, rig.now));
  }

  Rig rig;
  std::mt19937_64 random{2'024};
};
INSTANTIATE_TEST_SUITE_P(SealedAndSigned, Attacks, ::testing::Values(false, true),
                         [](const auto& mode) { return mode.param ? "Signed" : "Sealed"; });

TEST_P(Attacks, AFlippedBit) {
  for (int i = 0; i < mutations(); ++i) {
    Datagram datagram = next();
    const std::size_t bit = below(8 * datagram.size());
    datagram[bit / 8] = static_cast<std::uint8_t>(datagram[bit / 8] ^ 1U << bit % 8);
    ASSERT_FALSE(accepted(datagram)) << "bit " << bit;
  }
  expect_service();
}

TEST_P(Attacks, ATruncatedPacket) {
  for (int i = 0; i < mutations(); ++i) {
    Datagram datagram = next();
    datagram.resize(below(datagram.size()));
    ASSERT_FALSE(accepted(datagram)) << datagram.size();
  }
  expect_service();
}

TEST_P(Attacks, AnExtendedPacket) {
  for (int i = 0; i < mutations(); ++i) {
    Datagram datagram = next();
    for (std::size_t n = 1 + below(64); n > 0; --n) {
      datagram.push_back(static_cast<std::uint8_t>(random()));
    }
    ASSERT_FALSE(accepted(datagram));
  }
  expect_service();
}

TEST_P(Attacks, TwoPacketsSpliced) {
  for (int i = 0; i < mutations(); ++i) {
    const Datagram head = next(), tail = next();
    Datagram datagram = head;
    const std::size_t cut = 1 + below(head.size() - 1);
    std::copy(tail.begin() + static_cast<std::ptrdiff_t>(cut), tail.end(),
              datagram.begin() + static_cast<std::ptrdiff_t>(cut));
    if (datagram == head || datagram == tail) continue;
    ASSERT_FALSE(accepted(datagram)) << "cut " << cut;
  }
  expect_service();
}

TEST_P(Attacks, ThePacketOfOnePathOnTheOther) {
  for (int i = 0; i < mutations(); ++i) {
    const Datagram datagram = next();
    const auto first = static_cast<PathId>(below(2));
    ASSERT_TRUE(accepted(datagram, first));
    ASSERT_FALSE(accepted(datagram, first == 0 ? 1 : 0));
  }
  expect_service();
}

TEST_P(Attacks, AnOldKeyPhase) {
  for (int i = 0; i < mutations() / 100; ++i) {
    std::vector<Datagram> old;
    for (int k = 0; k < 100; ++k) old.push_back(next());
    rig.now += kPhaseTime;
    ASSERT_TRUE(accepted(next()));
    rig.now += kOldPhaseKept;
    for (Datagram& datagram : old) {
      ASSERT_FALSE(accepted(datagram));
      datagram[0] = static_cast<std::uint8_t>(datagram[0] ^ 2U);  // says it is of the new phase
      ASSERT_FALSE(accepted(datagram));
    }
  }
  EXPECT_GT((*rig.base)->counters().phases, 0U);
}

TEST_P(Attacks, AnOldSession) {
  std::vector<Datagram> old;
  for (int i = 0; i < mutations(); ++i) old.push_back(next());
  End restarted(rig.keys.car, 77, {.signed_only = GetParam(), .paths = 2});
  exchange(restarted, *rig.base, rig.now);
  rig.now += kTakeOver;
  const Datagram fresh = restarted.seal(1, rig.now);
  ASSERT_TRUE(rig.base->feed(fresh, kCarAddress, rig.now));
  const auto number = load<std::uint16_t>(fresh, 1);
  for (Datagram& datagram : old) {
    ASSERT_FALSE(accepted(datagram));
    store<std::uint16_t>(datagram, 1, number);  // says it is of this session
    ASSERT_FALSE(accepted(datagram));
  }
  EXPECT_TRUE(rig.base->feed(restarted.seal(2, rig.now), kCarAddress, rig.now));
}

TEST_P(Attacks, AReflectedPacket) {
  const auto own_number = load<std::uint16_t>(next(), 1);
  for (int i = 0; i < mutations(); ++i) {
    Datagram datagram = rig.base->seal(1, rig.now);
    ASSERT_FALSE(accepted(datagram));
    store<std::uint16_t>(datagram, 1, own_number);
    ASSERT_FALSE(accepted(datagram));
  }
  expect_service();
}

TEST_P(Attacks, ThePacketOfAnotherCar) {
  const KeyPair others = make_pair(2);
  End car(others.car, 21, {.signed_only = GetParam()}),
      base(others.base, 22, {.signed_only = GetParam()});
  establish(car, base, rig.now);
  const auto own_number = load<std::uint16_t>(next(), 1);
  for (int i = 0; i < mutations(); ++i) {
    Datagram datagram = car.seal(1, rig.now);
    ASSERT_FALSE(accepted(datagram));
    store<std::uint16_t>(datagram, 1, own_number);
    ASSERT_FALSE(accepted(datagram));
  }
  expect_service();
}

// A host on the mesh without any key (in the peers' links each such host can drive the car).
TEST_P(Attacks, AnyHostOnTheMeshSaysWhatItLikes) {
  for (int i = 0; i < mutations(); ++i) {
    Datagram datagram(below(200));
    for (std::uint8_t& byte : datagram) byte = static_cast<std::uint8_t>(random());
    if (datagram.size() >= kHeaderSize) {  // well formed, of any kind
      write_header({.kind = static_cast<Kind>(below(kKinds)),
                    .key_phase = below(2) != 0,
                    .receiver = load<std::uint16_t>(datagram, 1),
                    .sequence_low = static_cast<std::uint32_t>(random())},
                   datagram);
    }
    ASSERT_FALSE(accepted(datagram));
    ASSERT_FALSE(rig.car->feed(datagram, kElsewhere, rig.now));
    const auto reply = rig.base->poll(rig.now);
    ASSERT_LE(reply ? reply->first.size() : 0, datagram.size()) << "amplifies";
    ASSERT_FALSE(rig.car->poll(rig.now));
  }
  expect_service();
}

TEST_P(Attacks, NumbersThatLookIntoTheFutureLockNobodyOut) {
  for (const std::uint32_t number : {0x0000'0000U, 0x7FFF'FFFFU, 0x8000'0000U, 0xFFFF'FFFFU}) {
    Datagram datagram = next();
    store<std::uint32_t>(datagram, 3, number);
    ASSERT_FALSE(accepted(datagram));
    expect_service();
  }
}

TEST_P(Attacks, TheNewestPacketReplayedFromElsewhereRedirectsNothing) {
  for (int i = 0; i < 1'000; ++i) {
    const Datagram datagram = next();
    ASSERT_TRUE(rig.base->feed(datagram, kCarAddress, rig.now));
    ASSERT_FALSE(rig.base->feed(datagram, kElsewhere, rig.now));
    ASSERT_FALSE((*rig.base)->addresses(0).token());
    const auto targets = (*rig.base)->addresses(0).targets(100);
    ASSERT_EQ(targets.size(), 1U);
    ASSERT_EQ(targets[0], kCarAddress);
  }
}

// A late packet from the address before does not send the stream back there.
TEST_P(Attacks, AHeldBackPacketReplayedFromElsewhereRedirectsNothing) {
  const Datagram held_back = next();
  ASSERT_TRUE(rig.base->feed(next(), kCarAddress, rig.now));
  ASSERT_TRUE(rig.base->feed(held_back, kElsewhere, rig.now)) << "late, but it is the car's";
  EXPECT_FALSE((*rig.base)->addresses(0).token());
  EXPECT_EQ((*rig.base)->addresses(0).targets(100).size(), 1U);
}

// ---- a whole capture again

enum class After { kNothing, kCarRestart, kBaseRestart, kRekey };

class Replay : public ::testing::TestWithParam<After> {
 protected:
  struct Captured {
    Datagram datagram;
    bool to_base;
  };

  void pass(End& car, End& base, const Datagram& datagram, bool to_base) {
    capture.push_back({datagram, to_base});
    if (to_base)
      base.feed(datagram, kCarAddress, now);
    else
      car.feed(datagram, kBaseAddress, now);
  }
  // One slot of both ends, with whatever of the exchange is due.
  void slot(End& car, End& base) {
    if (const auto due = car.poll(now)) pass(car, base, due->first, true);
    if (const auto due = base.poll(now)) pass(car, base, due->first, false);
    if (const Datagram d = car.seal(1, now); !d.empty()) pass(car, base, d, true);
    if (const Datagram d = base.seal(1, now); !d.empty()) pass(car, base, d, false);
    now += milliseconds(20);
  }

  KeyPair keys = make_pair(1);
  std::vector<Captured> capture;
  Instant now{seconds(100).ns};
};
INSTANTIATE_TEST_SUITE_P(Capture, Replay,
                         ::testing::Values(After::kNothing, After::kCarRestart, After::kBaseRestart,
                                           After::kRekey));

TEST_P(Replay, OfTenMinutesIsNeverAcceptedAndStopsNothing) {
  constexpr int kSlots = 30'000;  // ten minutes
  auto car = std::make_unique<End>(keys.car, 1), base = std::make_unique<End>(keys.base, 2);
  for (int i = 0; i < kSlots; ++i) slot(*car, *base);
  const std::vector<Captured> old = capture;
  ASSERT_GT(old.size(), 2U * kSlots);
  if (GetParam() == After::kCarRestart) car = std::make_unique<End>(keys.car, 3);
  if (GetParam() == After::kBaseRestart) base = std::make_unique<End>(keys.base, 4);
  if (GetParam() == After::kRekey) now += kPhaseTime;
  for (int i = 0; i < 10; ++i) slot(*car, *base);
  ASSERT_TRUE((*car)->ready() && (*base)->ready());

  for (int round = 0; round < 2; ++round) {  // again at once, and after the old phase is over
    const std::uint64_t opened_before = (*car)->counters().opened + (*base)->counters().opened;
    for (const Captured& c : old) {
      ASSERT_FALSE(base->feed(c.datagram, kElsewhere, now));
      ASSERT_FALSE(car->feed(c.datagram, kElsewhere, now));
      while (base->poll(now)) continue;
    }
    EXPECT_EQ((*car)->counters().opened + (*base)->counters().opened, opened_before);
    now += kOldPhaseKept;
    slot(*car, *base);
    const auto session = (*base)->session();
    EXPECT_TRUE(base->feed(car->seal(2, now), kCarAddress, now));
    EXPECT_TRUE(car->feed(base->seal(2, now), kBaseAddress, now));
    EXPECT_EQ((*base)->session(), session);
    EXPECT_EQ((*base)->addresses(0).targets(50)[0], kCarAddress);
  }
}

}  // namespace
}  // namespace pitwall::telemetry::testing
