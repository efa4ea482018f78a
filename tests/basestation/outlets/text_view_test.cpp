// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/text_view.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include "tests/basestation/sender.hpp"

namespace pitwall::outlets {
namespace {

using telemetry::field;
using telemetry::Group;

struct Base {
  std::unique_ptr<intake::Station> station = std::make_unique<intake::Station>(1);
  Sender car;

  void hear(std::uint32_t sequence, Instant at) {
    ASSERT_TRUE(station->take(car.bytes(sequence), at));
  }
  std::string screen(Instant now, bool ansi = false) {
    station->advance(now);
    return text_view(*station, now, {.ansi = ansi});
  }
};

// A second of driving at 50 Hz with one packet lost; the tyres were sampled 0.7 s before.
void drive(Base& base) {
  auto& p = base.car.packet;
  p.source = telemetry::Source::kSimulation;
  p.age_of(Group::kMode) = p.age_of(Group::kEgo) = milliseconds(4);
  p.age_of(Group::kTyres) = milliseconds(700);
  p.values[field("mode.mode")] = 2;
  p.values[field("ego.x")] = 123.45;
  p.values[field("ego.vx")] = 70.5;
  p.values[field("tyres.pressure_rear_left")] = 152.5;
  for (std::uint32_t i = 0; i < 50; ++i) {
    if (i != 20) base.hear(i, {milliseconds(20 * i).ns});
  }
}

TEST(TextView, SaysWhetherTheBusIsThatOfTheDatabase) {
  Base base;
  drive(base);
  EXPECT_EQ(base.screen({milliseconds(1'000).ns}).find("CAN bus "), std::string::npos)
      << "not said";
  auto& p = base.car.packet;
  p.age_of(Group::kBus) = milliseconds(4);
  p.values[field("bus.database")] = 0x01234567;
  const std::pair<int, const char*> lines[] = {
      {0, "CAN bus   listening, the car's database is 01234567"},
      {1, "CAN bus   as in the car's database 01234567"},
      {2, "CAN bus   WRONG: id 1250 is not as in the car's database 01234567; will not arm"}};
  std::uint32_t sequence = 50;
  for (const auto& [identity, text] : lines) {
    p.values[field("bus.identity")] = identity;
    p.values[field("bus.differing_id")] = 1250;
    const Instant now{milliseconds(20 * sequence).ns};
    base.hear(sequence++, now);
    EXPECT_NE(base.screen(now).find(text), std::string::npos) << base.screen(now);
    const bool red = base.screen(now, true).find("\x1b[1;31mCAN bus") != std::string::npos;
    EXPECT_EQ(red, identity == 2);
  }
}

TEST(TextView, Golden) {
  Base base;
  drive(base);
  const std::string now = base.screen({milliseconds(1'200).ns});
  const std::string path = PITWALL_SOURCE_DIR "/tests/golden/basestation/text_view.txt";
  if (std::getenv("PITWALL_WRITE_GOLDEN") != nullptr) std::ofstream{path} << now;
  std::ifstream in{path};
  const std::string golden{std::istreambuf_iterator<char>{in}, {}};
  EXPECT_EQ(now, golden);
}

TEST(TextView, ASimulationIsNeverTakenForACar) {
  Base base;
  EXPECT_EQ(base.screen({}).find("REAL CAR"), std::string::npos);
  drive(base);
  EXPECT_NE(base.screen({}).find("*** SIMULATION ***"), std::string::npos);
  EXPECT_EQ(base.screen({}).find("REAL CAR"), std::string::npos);
  base.car.packet.source = telemetry::Source::kCar;
  base.hear(60, {seconds(2).ns});
  EXPECT_EQ(base.screen({seconds(2).ns}).find("SIMULATION"), std::string::npos);
  EXPECT_NE(base.screen({seconds(2).ns}).find("REAL CAR"), std::string::npos);
}

TEST(TextView, EveryFieldIsOnTheScreenWithItsUnit) {
  Base base;
  const std::string screen = base.screen({});
  for (const telemetry::FieldRow& row : telemetry::kFields) {
    EXPECT_NE(screen.find(std::string{row.name}), std::string::npos) << row.name;
    EXPECT_NE(screen.find(std::string{row.unit}), std::string::npos) << row.name;
  }
}

TEST(TextView, ALostCarIsNamedAndAHeardOneIsNot) {
  Base base;
  drive(base);
  const Instant last{milliseconds(980).ns};
  EXPECT_EQ(base.screen(last + seconds(1)).find("LOST"), std::string::npos);
  const Instant later = last + milliseconds(1'100);
  EXPECT_NE(base.screen(later).find("CAR LOST: not heard for 1.1 s"), std::string::npos);
  EXPECT_NE(base.screen(later, true).find("\x1b[1;31mPITWALL   CAR LOST"), std::string::npos);
  base.hear(51, later);
  EXPECT_EQ(base.screen(later).find("LOST"), std::string::npos);
}

TEST(TextView, ShowsWhatGoesUpAndHowLongItTakes) {
  Base base;
  drive(base);
  EXPECT_NE(base.screen({}).find("heartbeats sent 0   not sent 0   round trip not known"),
            std::string::npos);
  base.station->uplink().note(true);
  base.station->uplink().note(true);
  base.station->uplink().note(false);
  base.car.packet.age_of(Group::kRadio) = milliseconds(1);
  base.car.packet.values[field("radio.round_trip")] = 12.5;
  base.hear(60, {seconds(2).ns});
  EXPECT_NE(base.screen({milliseconds(2'003).ns})
                .find("heartbeats sent 2   not sent 1   round trip 12.5 ms, 4 ms ago"),
            std::string::npos);
}

TEST(TextView, StaleIsMarkedAndDimmed) {
  Base base;
  drive(base);
  EXPECT_NE(base.screen({seconds(1).ns}).find("  mode                "), std::string::npos);
  EXPECT_NE(base.screen({seconds(30).ns}).find("! mode                "), std::string::npos);
  EXPECT_NE(base.screen({seconds(30).ns}, true).find("\x1b[2m! mode "), std::string::npos);
}

TEST(TextView, PlainHasNoEscapes) {
  Base base;
  drive(base);
  EXPECT_EQ(base.screen({seconds(1).ns}).find('\x1b'), std::string::npos);
  EXPECT_EQ(base.screen({seconds(1).ns}, true).substr(0, 3), "\x1b[H");
}

TEST(TextView, RefusalsAreShownByKind) {
  Base base;
  base.station->take({}, {});
  auto damaged = base.car.bytes(1);
  damaged[40] ^= 1U;
  base.station->take(damaged, {});
  const std::string screen = base.screen({});
  EXPECT_NE(screen.find("refused   2"), std::string::npos);
  EXPECT_NE(screen.find("too short 1"), std::string::npos);
  EXPECT_NE(screen.find("damaged 1"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::outlets
