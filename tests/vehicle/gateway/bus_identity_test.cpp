// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/bus_identity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/tick.hpp"
#include "tests/vehicle/gateway/traffic.hpp"

namespace pitwall::gateway {
namespace {

using can::av21::kMessages;
using world::BusIdentity;
using world::IdentityDifference;
using world::IdentityVerdict;

struct GridSender {
  std::uint32_t id = 0;
  std::uint8_t length = 0;
  Duration period{}, phase{};
  bool extended = false, remote = false, fd = false;
};

// A bus on which every sender keeps its grid; what the grid says may come late, or not at all.
struct GridBus {
  std::vector<GridSender> senders;
  Random random{1};
  Duration late_most{};     // each frame comes late by up to this
  double loss = 0.0;        // share of frames that never come
  Duration silent_until{};  // nothing comes before: then all of it at once
  std::vector<std::pair<Instant, can::Frame>> waiting;

  std::vector<can::ReceivedFrame> tick(Instant now) {
    for (const GridSender& sender : senders) {
      const std::int64_t first = std::max<std::int64_t>(0, (now - kTick - sender.phase).ns);
      for (std::int64_t i = first / sender.period.ns;; ++i) {
        const Instant due = Instant{} + sender.phase + sender.period * i;
        if (due > now) break;
        if (due <= now - kTick || random.between(0.0, 1.0) < loss) continue;
        const auto late =
            static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(late_most.ns) + 1));
        waiting.emplace_back(due + nanoseconds(late), frame_of(sender));
      }
    }
    if (now - Instant{} < silent_until) return {};
    const auto later = [now](const auto& entry) { return entry.first > now; };
    const auto split = std::stable_partition(waiting.begin(), waiting.end(), later);
    std::vector<can::ReceivedFrame> out;
    for (auto it = split; it != waiting.end(); ++it) {
      const bool held = it->first - Instant{} < silent_until;
      out.push_back({it->second, held ? now : it->first});
    }
    waiting.erase(split, waiting.end());
    std::ranges::sort(out, {}, &can::ReceivedFrame::at);
    return out;
  }

  static can::Frame frame_of(const GridSender& sender) {
    can::Frame frame;
    frame.id = sender.id;
    frame.length = sender.length;
    frame.extended = sender.extended;
    frame.remote = sender.remote;
    frame.fd = sender.fd;
    return frame;
  }
};

// Every message of the car at its period, each with a phase of its own.
GridBus right_bus(std::uint64_t seed) {
  GridBus bus{.senders = {}, .random = {seed}, .waiting = {}};
  for (const can::MessageRow& row : kMessages) {
    if (row.direction != can::Direction::kFromCar || !row.required) continue;
    const auto phase = bus.random.below(static_cast<std::uint64_t>(row.period.ns));
    bus.senders.push_back({.id = row.id,
                           .length = row.length,
                           .period = row.period,
                           .phase = nanoseconds(static_cast<std::int64_t>(phase))});
  }
  for (std::size_t i = bus.senders.size(); i > 1; --i)
    std::swap(bus.senders[i - 1], bus.senders[bus.random.below(i)]);
  return bus;
}

struct Car {
  IdentityParams params;
  IdentityState state;
  bool armed = false;
  Instant now{};
  BusIdentity last;

  void listen(GridBus& bus, Duration time) {
    for (const Instant end = now + time; now < end;) {
      now += kTick;
      last = identify(params, state, bus.tick(now), armed, now);
    }
  }
  // How long until this verdict, at most `limit`.
  std::optional<Duration> until(IdentityVerdict verdict, GridBus& bus, Duration limit) {
    for (const Instant begin = now; now - begin < limit;) {
      listen(bus, kTick);
      if (last.verdict == verdict) return now - begin;
    }
    return std::nullopt;
  }
};

std::vector<const can::MessageRow*> required() {
  std::vector<const can::MessageRow*> out;
  for (const can::MessageRow& row : kMessages)
    if (row.required) out.push_back(&row);
  return out;
}

GridSender& sender_of(GridBus& bus, std::uint32_t id) {
  return *std::ranges::find(bus.senders, id, &GridSender::id);
}

// Law 1: a right bus is known within two of its slowest periods, whatever the phases.
TEST(BusIdentity, ARightBusIsKnownAsSoonAsItsSlowestPeriodAllows) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    GridBus bus = right_bus(seed);
    Car car;
    const auto time = car.until(IdentityVerdict::kRight, bus, seconds(5));
    ASSERT_TRUE(time) << seed << ": " << sentence(car.last);
    EXPECT_LE(*time, seconds(2) + kTick) << seed;
    EXPECT_GE(*time, seconds(1)) << "one frame of 1 s has no period";
    car.listen(bus, seconds(10));
    EXPECT_EQ(car.last.verdict, IdentityVerdict::kRight) << seed << ": " << sentence(car.last);
    EXPECT_EQ(car.last.database, can::av21::kFingerprint);
  }
}

// Law 2: late and lost frames delay the verdict; they never turn it round.
TEST(BusIdentity, ARightBusThatIsLateOrLossyIsNeverWrong) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    GridBus bus = right_bus(seed);
    bus.late_most = milliseconds(static_cast<std::int64_t>(bus.random.below(150)));
    bus.loss = bus.random.between(0.0, 0.02);
    Car car;
    bool ever_wrong = false;
    while (car.now - Instant{} < seconds(20)) {
      car.listen(bus, kTick);
      ever_wrong = ever_wrong || car.last.verdict == IdentityVerdict::kWrong;
      if (ever_wrong) break;
    }
    EXPECT_FALSE(ever_wrong) << seed << ": " << sentence(car.last);
    EXPECT_EQ(car.last.verdict, IdentityVerdict::kRight) << seed;
  }
}

TEST(BusIdentity, AStallOfTwoSecondsIsNoOtherBus) {
  GridBus bus = right_bus(3);
  bus.silent_until = seconds(2);
  Car car;
  ASSERT_TRUE(car.until(IdentityVerdict::kRight, bus, seconds(6))) << sentence(car.last);
  bus.silent_until = car.now - Instant{} + seconds(2);
  for (int i = 0; i < 800; ++i) {
    car.listen(bus, kTick);
    ASSERT_EQ(car.last.verdict, IdentityVerdict::kRight) << sentence(car.last);
  }
}

// Race control sends its flags also when they change.
TEST(BusIdentity, ExtraFramesOfAChangeAreNoOtherPeriod) {
  GridBus bus = right_bus(4);
  for (const std::uint32_t id : {1200u, 1250u})
    bus.senders.push_back({.id = id, .length = 8, .period = seconds(1), .phase = milliseconds(3)});
  Car car;
  ASSERT_TRUE(car.until(IdentityVerdict::kRight, bus, seconds(3)));
  car.listen(bus, seconds(10));
  EXPECT_EQ(car.last.verdict, IdentityVerdict::kRight) << sentence(car.last);
}

// Law 3: one message that differs is named, whichever it is and however it differs.
struct Mutation {
  const char* name;
  IdentityDifference difference;
  void (*apply)(GridSender&);
};
const Mutation kMutations[] = {
    {"longer", IdentityDifference::kWrongLength, [](GridSender& s) { ++s.length; }},
    {"shorter", IdentityDifference::kWrongLength, [](GridSender& s) { --s.length; }},
    {"remote", IdentityDifference::kWrongFormat, [](GridSender& s) { s.remote = true; }},
    {"extended", IdentityDifference::kWrongFormat, [](GridSender& s) { s.extended = true; }},
    {"fd", IdentityDifference::kWrongFormat, [](GridSender& s) { s.fd = true; }},
    {"missing", IdentityDifference::kNotReceived,
     [](GridSender& s) { s.period = seconds(1'000'000); }},
    {"slower", IdentityDifference::kWrongPeriod, [](GridSender& s) { s.period = s.period * 3; }},
    {"faster", IdentityDifference::kWrongPeriod, [](GridSender& s) { s.period = s.period / 3; }},
};

TEST(BusIdentity, EveryMutationOfOneMessageIsNamed) {
  for (const can::MessageRow* row : required()) {
    for (const Mutation& mutation : kMutations) {
      GridBus bus = right_bus(row->id);
      GridSender& sender = sender_of(bus, row->id);
      mutation.apply(sender);
      if (sender.period > seconds(100)) sender.phase = sender.period - seconds(1);
      Car car;
      const auto time = car.until(IdentityVerdict::kWrong, bus, seconds(15));
      ASSERT_TRUE(time) << row->name << " " << mutation.name;
      EXPECT_EQ(car.last.id, row->id) << mutation.name << ": " << sentence(car.last);
      EXPECT_EQ(car.last.difference, mutation.difference) << sentence(car.last);
      car.listen(bus, seconds(15));
      EXPECT_EQ(car.last.verdict, IdentityVerdict::kWrong) << row->name << " " << mutation.name;
      EXPECT_EQ(car.last.id, row->id) << mutation.name << ": " << sentence(car.last);
    }
  }
}

TEST(BusIdentity, AnUnknownIdIsNamedAndOfSeveralTheSmallest) {
  Random random{5};
  for (int i = 0; i < 100; ++i) {
    const auto id = static_cast<std::uint32_t>(random.below(2048));
    if (std::ranges::find(kMessages, id, &can::MessageRow::id) != kMessages.end()) continue;
    GridBus bus = right_bus(random.next());
    bus.senders.push_back({.id = 2047, .length = 8, .period = milliseconds(10), .phase = {}});
    bus.senders.push_back({.id = id, .length = 3, .period = milliseconds(700), .phase = {}});
    Car car;
    car.listen(bus, seconds(1));
    EXPECT_EQ(car.last.difference, IdentityDifference::kUnknownId);
    EXPECT_EQ(car.last.id, id) << sentence(car.last);
    EXPECT_EQ(car.last.received, id == 2047 ? car.last.received : 3.0);
  }
}

TEST(BusIdentity, ProofIsNamedBeforeAbsenceAndSmallerIdsFirst) {
  GridBus bus = right_bus(6);
  sender_of(bus, 1250).period = seconds(1'000'000);
  sender_of(bus, 1250).phase = seconds(900'000);
  ++sender_of(bus, 1312).length;
  ++sender_of(bus, 1303).length;
  Car car;
  car.listen(bus, seconds(8));
  EXPECT_EQ(car.last.id, 1303u) << sentence(car.last);
  --sender_of(bus, 1303).length;
  car.listen(bus, seconds(8));
  EXPECT_EQ(car.last.id, 1312u) << sentence(car.last);
  --sender_of(bus, 1312).length;
  car.listen(bus, seconds(8));
  EXPECT_EQ(car.last.id, 1250u) << sentence(car.last);
  EXPECT_EQ(car.last.difference, IdentityDifference::kNotReceived);
}

// What is optional may be absent, but not different.
TEST(BusIdentity, AnOptionalMessageMayBeSilentButNotWrong) {
  GridBus bus = right_bus(7);
  bus.senders.push_back({.id = 226, .length = 8, .period = milliseconds(200), .phase = {}});
  Car car;
  ASSERT_TRUE(car.until(IdentityVerdict::kRight, bus, seconds(3)));
  bus.senders.pop_back();
  car.listen(bus, seconds(10));
  EXPECT_EQ(car.last.verdict, IdentityVerdict::kRight);
  bus.senders.push_back({.id = 228, .length = 7, .period = milliseconds(200), .phase = {}});
  car.listen(bus, seconds(1));
  EXPECT_EQ(car.last.id, 228u);
}

// Our own ids are no evidence: gateway/inbound latches them.
TEST(BusIdentity, OurOwnIdsAreNotOfTheBus) {
  GridBus bus = right_bus(8);
  bus.senders.push_back({.id = 1402, .length = 2, .period = milliseconds(10), .phase = {}});
  Car car;
  EXPECT_TRUE(car.until(IdentityVerdict::kRight, bus, seconds(3)));
}

// Law 4: while armed the verdict stands, whatever comes or does not come.
TEST(BusIdentity, WhileArmedTheVerdictStands) {
  GridBus bus = right_bus(9);
  Car car;
  ASSERT_TRUE(car.until(IdentityVerdict::kRight, bus, seconds(3)));
  car.armed = true;
  GridBus noise = right_bus(10);
  for (GridSender& sender : noise.senders) sender.length = static_cast<std::uint8_t>(sender.id % 9);
  noise.senders.push_back({.id = 999, .length = 8, .period = milliseconds(20), .phase = {}});
  GridBus silence;
  for (GridBus* other : {&noise, &silence}) {
    for (int i = 0; i < 2000; ++i) {
      car.listen(*other, kTick);
      ASSERT_EQ(car.last.verdict, IdentityVerdict::kRight);
    }
  }
  // Disarmed again, an hour of driving is no silence.
  car.armed = false;
  GridBus again = right_bus(11);
  for (int i = 0; i < 1000; ++i) {
    car.listen(again, kTick);
    ASSERT_EQ(car.last.verdict, IdentityVerdict::kRight) << sentence(car.last);
  }
}

// Law 5: a disarmed car hears a wrong frame at once and forgives it after a whole clean window.
TEST(BusIdentity, ADisarmedCarHearsAWrongFrameAndHeals) {
  GridBus bus = right_bus(12);
  Car car;
  ASSERT_TRUE(car.until(IdentityVerdict::kRight, bus, seconds(3)));
  can::ReceivedFrame stray{GridBus::frame_of({.id = 1000, .length = 8}), car.now};
  car.last = identify(car.params, car.state, {&stray, 1}, false, car.now);
  EXPECT_EQ(car.last.verdict, IdentityVerdict::kWrong);
  EXPECT_EQ(car.last.id, 1000u);
  const auto healed = car.until(IdentityVerdict::kRight, bus, seconds(6));
  ASSERT_TRUE(healed);
  EXPECT_GE(*healed, car.params.listen);
  EXPECT_LE(*healed, car.params.listen + kTick);
}

TEST(BusIdentity, ABusThatSpeaksLaterIsKnownThen) {
  GridBus silence, bus = right_bus(13);
  Car car;
  car.listen(silence, seconds(5));
  EXPECT_EQ(car.last.verdict, IdentityVerdict::kWrong);
  EXPECT_EQ(car.last.id, required().front()->id);
  EXPECT_EQ(car.last.difference, IdentityDifference::kNotReceived);
  ASSERT_TRUE(car.until(IdentityVerdict::kRight, bus, seconds(6)));
}

TEST(BusIdentity, EverySentenceSaysWhatDiffers) {
  const auto text = [](IdentityDifference difference, std::uint32_t id, double expected,
                       double received) {
    return sentence({.verdict = IdentityVerdict::kWrong,
                     .difference = difference,
                     .id = id,
                     .expected = expected,
                     .received = received});
  };
  using enum IdentityDifference;
  EXPECT_EQ(text(kWrongLength, 1312, 6, 8),
            "CAN id 1312 steering_report_extd: 8 bytes on the bus, 6 in database CAN1-INDY-V14");
  EXPECT_EQ(text(kUnknownId, 1000, 0, 8),
            "CAN id 1000: 8 bytes on the bus, no such message in database CAN1-INDY-V14");
  EXPECT_EQ(text(kWrongFormat, 1300, 8, 8),
            "CAN id 1300 wheel_speed_report: a remote, FD or extended frame on the bus, a classic "
            "one in database CAN1-INDY-V14");
  EXPECT_EQ(text(kNotReceived, 1250, 0.5, 3.5),
            "CAN id 1250 marelli_report_1: not heard for 3.5 s, every 500 ms in database "
            "CAN1-INDY-V14");
  EXPECT_EQ(text(kWrongPeriod, 1303, 0.01, 0.03),
            "CAN id 1303 steering_report: every 30 ms on the bus, every 10 ms in database "
            "CAN1-INDY-V14");
  EXPECT_EQ(sentence({.verdict = IdentityVerdict::kRight}),
            "the CAN bus is that of database CAN1-INDY-V14");
  EXPECT_EQ(sentence({}), "the CAN bus is not yet known to be that of database CAN1-INDY-V14");
  EXPECT_EQ(database_text().substr(0, 37), "av21.dbc, CAN1-INDY-V14, fingerprint ");
}

TEST(BusIdentity, AllocatesNothing) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  GridBus bus = right_bus(14);
  ++sender_of(bus, 1303).length;
  bus.senders.push_back({.id = 5, .length = 8, .period = milliseconds(10), .phase = {}});
  Car car;
  for (Instant now{}; now - Instant{} < seconds(5); now += kTick) {
    const auto frames = bus.tick(now);
    const auto taken = pitwall::testing::allocations_of(
        [&] { car.last = identify(car.params, car.state, frames, false, now); });
    ASSERT_EQ(taken, 0u);
  }
  EXPECT_GT(pitwall::testing::allocations_of([&] { sentence(car.last); }), 0u) << "not counted";
}

}  // namespace
}  // namespace pitwall::gateway
