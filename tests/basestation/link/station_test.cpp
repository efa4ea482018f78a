// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/station.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <variant>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::link {
namespace {

using telemetry::field;
using telemetry::Group;

constexpr auto kX = field("ego.x");

TEST(Station, ShowsWhatTheCarSaysWithItsTrueAge) {
  RadioRig rig;
  rig.set(kX, 321.0);
  rig.run(seconds(3));
  ASSERT_TRUE(rig.station->endpoint().clock_known());
  const state::FieldView view = rig.base->vehicle().view(kX, rig.now);
  EXPECT_EQ(view.value, 321.0);
  EXPECT_GE(view.age, RadioRig::kDelay) << "the time on the way is in it";
  EXPECT_LE(view.age, RadioRig::kDelay + telemetry::kSlot + milliseconds(25));
  const AgeHistogram& ages = rig.station->ages().of(Group::kEgo);
  EXPECT_GE(ages.quantile(0.5), RadioRig::kDelay);
  EXPECT_LE(ages.quantile(0.99), milliseconds(60));
}

TEST(Station, ASilenceAfterTheLastPacketIsInNoAge) {
  RadioRig rig;
  rig.set(kX, 321.0);
  rig.run(seconds(3));
  rig.loses = [](bool to_base, telemetry::PathId) { return to_base; };
  rig.run(seconds(60));
  EXPECT_LE(rig.station->ages().of(Group::kEgo).largest(), milliseconds(500));
  rig.loses = [](bool, telemetry::PathId) { return false; };
  rig.run(seconds(3));
  EXPECT_GE(rig.station->ages().of(Group::kEgo).largest(), seconds(59)) << "it was not the last";
}

TEST(Station, IsOverheardInBothDirectionsWhateverComes) {
  RadioRig rig;
  std::uint64_t down = 0, up = 0, noise = 0;
  const std::array<std::uint8_t, 3> nonsense{1, 2, 3};
  rig.station->observe([&](bool from_car, telemetry::PathId, UdpAddress other, Instant at,
                           std::span<const std::uint8_t> bytes) {
    EXPECT_LE(at, rig.now);
    if (from_car && std::ranges::equal(bytes, nonsense)) {
      EXPECT_EQ(other.port, 9);
      ++noise;
      return;
    }
    ++(from_car ? down : up);
  });
  rig.set(kX, 1.0);
  rig.run(seconds(1));
  EXPECT_GE(down, rig.station->rate().packets());
  EXPECT_GT(up, 3u);
  rig.station->take(nonsense, 0, {.ip = 1, .port = 9}, rig.now);
  EXPECT_EQ(noise, 1u) << "what is not authentic, too";
}

// Without a session, so without a word of the car.
TEST(Station, ACarWithAnotherKeyIsAnEventOfTheBase) {
  RadioRig rig;
  const KeyPair others = make_key_pair(rig.randomness);
  rig.keys.car = others.car;
  rig.restart_car();
  rig.set(kX, 1.0);
  rig.run(seconds(2));
  EXPECT_EQ(rig.station->source(), Station::Source::kNone);
  EXPECT_TRUE(rig.station->report(rig.now).threats.has(telemetry::Threat::kWrongKey));
  rig.run(seconds(60));
  ASSERT_EQ(rig.station->events().size(), 1U) << "however long it knocks";
  EXPECT_EQ(rig.station->events_received(), 1U);
  const auto content = telemetry::content_of(rig.station->events().front());
  ASSERT_TRUE(content);
  const auto& event = std::get<telemetry::ThreatEvent>(*content);
  EXPECT_EQ(event.threat, static_cast<std::uint8_t>(telemetry::Threat::kWrongKey));
  EXPECT_TRUE(event.begins && event.seen_by_base);
}

TEST(Station, TellsASimulationFromACar) {
  for (const bool real : {true, false}) {
    RadioRig rig({.real_car = real});
    EXPECT_EQ(rig.station->source(), Station::Source::kNone);
    rig.set(kX, 1.0);
    rig.run(seconds(1));
    EXPECT_EQ(rig.station->source(), real ? Station::Source::kCar : Station::Source::kSimulation);
  }
}

TEST(Station, CountsWhatWasLostAndWhere) {
  RadioRig rig;
  rig.set(kX, 1.0);
  rig.set(field("track.station"), 0.0);
  int sent = 0;
  // Each fourth packet between 1000 and 1400 m is lost.
  rig.loses = [&](bool to_base, telemetry::PathId) {
    const double at_m = rig.snapshot.values[field("track.station")];
    return to_base && at_m >= 1'000.0 && at_m < 1'400.0 && ++sent % 4 == 0;
  };
  for (int i = 0; i < 4'000; ++i) {
    rig.set(field("track.station"), 0.5 * i);
    rig.run(milliseconds(5));
  }
  EXPECT_GT(rig.station->lost_packets(), 40U);
  EXPECT_LT(rig.station->loss(), 0.10);
  const auto bin = [](double at_m) { return static_cast<std::size_t>(at_m / Station::kSection_m); };
  EXPECT_NEAR(rig.station->endpoint().loss_at(bin(1'200.0)), 0.25, 0.10);
  EXPECT_LT(rig.station->endpoint().loss_at(bin(400.0)), 0.01);
}

TEST(Station, ARestartOfTheCarIsASessionMoreAndNoLoss) {
  RadioRig rig;
  rig.set(kX, 1.0);
  rig.run(seconds(2));
  rig.restart_car();
  rig.run(seconds(2));
  EXPECT_EQ(rig.station->report(rig.now).sessions, 2U);
  EXPECT_LE(rig.station->lost_packets(), 2U);
  EXPECT_EQ(rig.base->vehicle().view(kX, rig.now).quality, state::Quality::kFresh);
}

TEST(Station, KeepsEventsInOrderAndTheirOwnTime) {
  RadioRig rig;
  rig.set(kX, 1.0);
  rig.run(seconds(2));
  const Instant first = rig.now;
  for (const char* text : {"one", "two", "three"}) {
    ASSERT_TRUE(rig.car->log(telemetry::make_event(telemetry::TextEvent{text}, rig.now)));
    rig.run(milliseconds(100));
  }
  ASSERT_EQ(rig.station->events_received(), 3U);
  EXPECT_LE(rig.station->events()[0].at, first + milliseconds(1));
  EXPECT_GE(rig.station->events()[0].at, first - milliseconds(30));
  const auto last = telemetry::content_of(rig.station->events()[2]);
  ASSERT_TRUE(last);
  EXPECT_EQ(std::get<telemetry::TextEvent>(*last).text, "three");
}

// A 1-byte packet that makes a peer's base publish its last values again.
TEST(Station, ADatagramIsNoNewValue) {
  RadioRig rig;
  rig.set(kX, 1.0);
  rig.run(seconds(1));
  const Instant silent = rig.now;
  for (int i = 0; i < 1'000; ++i) {
    rig.now += milliseconds(1);
    EXPECT_FALSE(rig.base->receive(std::array<std::uint8_t, 1>{0}, 0, RadioRig::kCarAt, rig.now));
    EXPECT_FALSE(rig.base->receive({}, 0, RadioRig::kCarAt, rig.now));
  }
  EXPECT_GE(rig.base->vehicle().view(kX, rig.now).age, rig.now - silent);
  EXPECT_EQ(rig.station->report(rig.now)
                .association.refused[static_cast<std::size_t>(telemetry::Refusal::kHeader)],
            2'000U);
}

}  // namespace
}  // namespace pitwall::link
