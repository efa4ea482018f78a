// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/text_view.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>

#include "basestation/publishers/text/link_text.hpp"
#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers {
namespace {

using telemetry::field;
using telemetry::Group;

struct Base : RadioRig {
  explicit Base(const RigOptions& wanted = {}) : RadioRig(wanted) {}

  std::string screen(const ViewOptions& how = {}) { return text_view(*base, now, how); }
  bool shows(const std::string& text, const ViewOptions& how = {}) {
    return screen(how).find(text) != std::string::npos;
  }
  // Three seconds of driving; the tyres were sampled once.
  void drive() {
    set(field("mode.mode"), 2);
    set(field("ego.x"), 123.45);
    set(field("ego.vx"), 70.5);
    snapshot.values[field("tyres.pressure_rear_left")] = 152.5;
    snapshot.at(Group::kTyres) = now;
    run(seconds(3));
  }
};

// The radio's figures and ages are other modules' business: each number is '#'.
std::string without_numbers(const std::string& screen) {
  static const std::regex kNumber{" *[0-9]+(\\.[0-9]+)?"};
  return std::regex_replace(screen, kNumber, " #");
}

TEST(TextView, Golden) {
  Base base({.paths = 2, .real_car = false});
  base.drive();
  ASSERT_TRUE(base.execute("take 1"));
  ASSERT_TRUE(base.execute("command speed_limit 30 because of a test"));
  ASSERT_FALSE(base.execute("command fly 1"));
  base.car->log(telemetry::make_event(telemetry::ModeEvent{.from = 1, .to = 2}, base.now));
  base.run(milliseconds(60));
  const std::string now = without_numbers(base.screen({.all = true}));
  const std::string path = PITWALL_SOURCE_DIR "/tests/golden/basestation/text_view.txt";
  if (std::getenv("PITWALL_WRITE_GOLDEN") != nullptr) std::ofstream{path} << now;
  std::ifstream in{path};
  const std::string golden{std::istreambuf_iterator<char>{in}, {}};
  EXPECT_EQ(now, golden);
}

TEST(TextView, NoLineIsWiderThanTheScreen) {
  Base base({.paths = 2});
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    const telemetry::FieldRow& row = telemetry::kFields[i];
    if (telemetry::row_of(row.group).direction == telemetry::Direction::kDown) {
      base.set(i, row.max);
    }
  }
  base.run(seconds(3));
  std::istringstream lines(base.screen({.all = true}));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), kScreenColumns) << line;
  }
}

TEST(TextView, ASimulationIsNeverTakenForACar) {
  Base simulation({.real_car = false}), car({.real_car = true});
  EXPECT_FALSE(simulation.shows("REAL CAR"));
  simulation.drive();
  EXPECT_TRUE(simulation.shows("*** SIMULATION ***"));
  EXPECT_FALSE(simulation.shows("REAL CAR"));
  car.drive();
  EXPECT_TRUE(car.shows("REAL CAR"));
  EXPECT_FALSE(car.shows("SIMULATION"));
}

TEST(TextView, TheTimeOfABenchIsNeverTakenForTheWallClocks) {
  Base base({.real_car = false});
  base.drive();
  EXPECT_FALSE(base.shows("TIME"));
  const transport::BenchPause goes_on{.now = milliseconds(149), .total = milliseconds(3'420)};
  EXPECT_TRUE(base.shows("no real car\nTIME      of a bench; it has stood 3.4 s in all\n",
                         {.pause = goes_on}));
  const transport::BenchPause waits{.now = milliseconds(1'210), .total = milliseconds(4'480)};
  EXPECT_TRUE(base.shows("TIME      BENCH WAITS, 1.2 s now, 4.5 s in all", {.pause = waits}));
  EXPECT_TRUE(base.shows("car 7\nPITWALL   *** SIMULATION ***   no real car\nTIME      BENCH WAITS",
                         {.title = "car 7", .pause = waits}));
}

TEST(TextView, EveryFieldOfAHeardGroupIsThereWithItsUnitAndItsGroupsAge) {
  Base base;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (row.direction == telemetry::Direction::kDown) base.sampled.add(row.group);
  }
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    base.snapshot.values[i] = telemetry::kFields[i].min;
  }
  base.run(seconds(3));
  const std::string screen = base.screen({.all = true});
  for (const telemetry::FieldRow& row : telemetry::kFields) {
    if (telemetry::row_of(row.group).direction != telemetry::Direction::kDown) continue;
    EXPECT_NE(screen.find(std::string{row.name} + ": "), std::string::npos) << row.name;
    if (row.unit == telemetry::FieldRow::kBitSet) continue;
    EXPECT_NE(screen.find(std::string{row.unit}), std::string::npos) << row.name;
  }
  EXPECT_EQ(screen.find("not received yet"), std::string::npos);
}

TEST(TextView, ALostCarIsNamedAndAHeardOneIsNot) {
  Base base;
  base.drive();
  EXPECT_FALSE(base.shows("LOST"));
  base.now += milliseconds(1'300);
  EXPECT_TRUE(base.shows("CAR LOST: not heard for 1.3 s"));
  EXPECT_TRUE(base.shows("\x1b[1;31mPITWALL   CAR LOST", {.ansi = true}));
  base.run(milliseconds(100));
  EXPECT_FALSE(base.shows("LOST"));
}

TEST(TextView, StaleIsMarkedAndDimmed) {
  Base base;
  base.drive();
  EXPECT_TRUE(base.shows("\n  mode "));
  base.now += seconds(30);
  EXPECT_TRUE(base.shows("\n! mode               30 s"));
  EXPECT_TRUE(base.shows("\x1b[2m! mode ", {.ansi = true}));
}

TEST(TextView, AValueOlderThanItsGroupSaysItsOwnAge) {
  Base base;
  base.drive();
  base.snapshot.values[field("ego.x")] = kUnset;
  base.run(seconds(2));
  EXPECT_TRUE(base.shows("x: 123.4")) << base.screen();
  EXPECT_TRUE(base.shows("(20")) << base.screen();
}

TEST(TextView, GroupsThatWereNeverHeardAreNamedAndShowNoValue) {
  Base base;
  base.drive();
  const std::string screen = base.screen({.all = true});
  const std::size_t never = screen.find("not received yet:");
  ASSERT_NE(never, std::string::npos);
  EXPECT_NE(screen.find(" gnss0", never), std::string::npos);
  EXPECT_EQ(screen.find(" tyres", never), std::string::npos);
}

TEST(TextView, SaysWhetherTheBusIsThatOfTheDatabase) {
  Base base;
  base.drive();
  EXPECT_FALSE(base.shows("CAN bus "));
  base.set(field("bus.database"), 0x01234567);
  base.set(field("bus.differing_id"), 1250);
  const std::pair<int, const char*> lines[] = {
      {0, "CAN bus   listening, the car's database is 01234567"},
      {1, "CAN bus   as in the car's database 01234567"},
      {2, "CAN bus   WRONG: id 1250 is not as in the car's database 01234567; will not arm"}};
  for (const auto& [identity, text] : lines) {
    base.set(field("bus.identity"), identity);
    base.run(seconds(1));
    EXPECT_TRUE(base.shows(text)) << base.screen();
    EXPECT_EQ(base.shows("\x1b[1;31mCAN bus", {.ansi = true}), identity == 2);
  }
}

TEST(TextView, AStopIsSeenUntilTheCarHasLetItGo) {
  Base base;
  base.drive();
  EXPECT_FALSE(base.shows("\x1b[1;31moperator", {.ansi = true}));
  ASSERT_TRUE(base.execute("stop controlled"));
  EXPECT_TRUE(base.shows("stop asked: controlled stop   latched by the car: "));
  EXPECT_TRUE(base.shows("\x1b[1;31moperator", {.ansi = true}));
}

TEST(TextView, PlainHasNoEscapes) {
  Base base;
  base.drive();
  EXPECT_FALSE(base.shows("\x1b"));
  EXPECT_EQ(base.screen({.ansi = true}).substr(0, 3), "\x1b[H");
}

TEST(TextView, RefusalsAreShownByKind) {
  Base base;
  base.station->take({}, 0, RadioRig::kCarAt, base.now);
  base.station->take(std::array<std::uint8_t, 4>{}, 0, RadioRig::kCarAt, base.now);
  EXPECT_TRUE(base.shows("refused   2   not a datagram of this protocol 2")) << base.screen();
}

}  // namespace
}  // namespace pitwall::publishers
