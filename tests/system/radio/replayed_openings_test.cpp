// Recorded openings of a key exchange, replayed at the base from one address and from many, before
// and after restarts of either end: the stop of an operator is as fast as without them, and a car
// that starts in the flood has its link.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <ostream>
#include <vector>

#include "protocol/telemetry/packet/header.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::PathId;
using telemetry::StopLevel;
using Bytes = std::vector<std::uint8_t>;

enum class Restarts { kNone, kBase, kCar };

struct Flood {
  std::size_t distinct = 1;
  int per_second = 100;
  bool many_addresses = false;
  Restarts restarts = Restarts::kNone;
  bool stamps_kept = true;
};
std::ostream& operator<<(std::ostream& out, const Flood& flood) {
  constexpr const char* kNames[] = {"nobody", "the base", "the car"};
  return out << flood.distinct << " openings, " << flood.per_second << "/s from "
             << (flood.many_addresses ? "many addresses" : "one address") << ", "
             << kNames[static_cast<int>(flood.restarts)] << " restarts"
             << (flood.stamps_kept ? "" : ", the base remembers nothing");
}

std::vector<Flood> floods() {
  std::vector<Flood> all;
  for (const std::size_t distinct : {1U, 64U, 1'000U})
    for (const int per_second : {100, 1'000, 10'000})
      for (const bool many : {false, true})
        for (const auto restarts : {Restarts::kNone, Restarts::kBase, Restarts::kCar})
          for (const bool kept : {true, false})
            all.push_back({distinct, per_second, many, restarts, kept});
  return all;
}

// A day after what was recorded, with the same keys.
RadioSetup today(bool stamps_kept = true) {
  RadioSetup setup = setup_of(clean_link());
  setup.to_utc = seconds(86'400);
  setup.stamps_kept = stamps_kept;
  return setup;
}

// What a car sent that was started again and again while there was no base, heard by somebody
// beside the path.
const std::vector<Bytes>& recorded() {
  static const std::vector<Bytes> kOpenings = [] {
    std::vector<Bytes> openings;
    RadioSetup yesterday = setup_of(clean_link());
    yesterday.chance = 1;
    VirtualRadio radio(yesterday);
    radio.restart_base(seconds(1'000));
    radio.tap([&](bool down, PathId, std::span<const std::uint8_t> bytes) {
      const auto header = telemetry::parse_header(bytes);
      if (down && header && header->kind == telemetry::Kind::kOpening) {
        openings.emplace_back(bytes.begin(), bytes.end());
      }
      return true;
    });
    while (openings.size() < 1'000) {
      const std::size_t before = openings.size();
      radio.step();
      if (openings.size() > before) radio.restart_car();
    }
    return openings;
  }();
  return kOpenings;
}

class Flooded {
 public:
  explicit Flooded(const std::optional<Flood>& flood, bool stamps_kept)
      : radio(today(stamps_kept)), flood_(flood) {}

  void run(Duration length, bool floods) {
    for (const Instant end = radio.now() + length; radio.now() < end;) {
      if (floods && flood_) flood();
      radio.step();
    }
  }
  // Until the car has it latched.
  Duration press() {
    const Instant pressed = radio.now();
    radio.station().stop().demand(StopLevel::kEmergency, telemetry::StopReason::kOperator);
    while (radio.car().view(radio.car_now()).stop != StopLevel::kEmergency &&
           radio.now() - pressed < seconds(20)) {
      run(kStep, true);
    }
    return radio.now() - pressed;
  }
  // Until the base shows a sample that is younger than now.
  Duration link_time() {
    const Instant begin = radio.now();
    while (radio.now() - begin < seconds(20)) {
      run(kStep, true);
      const auto sample = radio.sample_at_base(telemetry::Group::kMode);
      if (sample && *sample >= begin) break;
    }
    return radio.now() - begin;
  }

  VirtualRadio radio;

 private:
  void flood() {
    due_ += flood_->per_second * 1e-3;
    for (; due_ >= 1.0; due_ -= 1.0, ++sent_) {
      const auto n = static_cast<std::uint32_t>(sent_);
      const UdpAddress from{0x0A010000U + (flood_->many_addresses ? n % 50'000U : 0U), 7'000};
      radio.inject(true, 0, from, recorded()[n % flood_->distinct]);
    }
  }

  std::optional<Flood> flood_;
  double due_ = 0.0;
  std::uint64_t sent_ = 0;
};

// A link of three seconds, the restart, and the press some time after it.
Duration stop_delay(const std::optional<Flood>& flood, Restarts restarts, bool kept,
                    Duration after) {
  Flooded scene(flood, kept);
  scene.run(seconds(3), false);
  if (restarts == Restarts::kBase) scene.radio.restart_base();
  if (restarts == Restarts::kCar) scene.radio.restart_car();
  scene.run(after, true);
  return scene.press();
}

TEST(ReplayedOpenings, DelayAStopByNoMoreThanATenthOfASecond) {
  Duration worst{};
  for (const Duration after : {milliseconds(0), milliseconds(70), milliseconds(900)}) {
    for (const Flood& flood : floods()) {
      const Duration quiet = stop_delay({}, flood.restarts, flood.stamps_kept, after);
      const Duration late = stop_delay(flood, flood.restarts, flood.stamps_kept, after) - quiet;
      EXPECT_LE(late, milliseconds(100)) << flood << ": " << late.milliseconds() << " ms";
      worst = std::max(worst, late);
    }
  }
  std::cout << "a stop came at most " << worst.milliseconds() << " ms later\n";
}

TEST(ReplayedOpenings, KeepNoCarOutThatStartsAmongThem) {
  const auto start = [](const std::optional<Flood>& flood, bool kept) {
    Flooded scene(flood, kept);
    if (kept) {
      scene.run(seconds(3), false);
      scene.radio.restart_base();
    }
    scene.radio.restart_car(seconds(2));
    scene.run(seconds(2), true);
    return scene.link_time();
  };
  Duration worst{};
  for (const Flood& flood : floods()) {
    if (flood.restarts != Restarts::kNone) continue;
    const Duration quiet = start({}, flood.stamps_kept);
    const Duration late = start(flood, flood.stamps_kept) - quiet;
    EXPECT_LE(late, seconds(2)) << flood << ": " << late.milliseconds() << " ms";
    worst = std::max(worst, late);
  }
  std::cout << "the link came at most " << worst.milliseconds() << " ms later\n";
}

// Its clock lost a day: the base proves which stamp it must exceed.
TEST(ReplayedOpenings, ACarWhoseClockWentBackHasItsLinkInTheirMidst) {
  for (const bool flooded : {false, true}) {
    const Flood flood{.distinct = 1'000, .per_second = 10'000, .many_addresses = true};
    Flooded scene(flooded ? std::optional{flood} : std::nullopt, true);
    scene.run(seconds(3), false);
    scene.radio.set_clock_of_car(seconds(-3'600));
    scene.radio.restart_car();
    const Duration taken = scene.link_time();
    EXPECT_LE(taken, seconds(5)) << flooded;
    std::cout << "link after " << taken.milliseconds() << " ms\n";
  }
}

// Who hears the present openings and sends each on from his own address before it arrives.
TEST(ReplayedOpenings, FasterCopiesOfTheOpeningsUnderWayKeepNoCarOut) {
  Flooded scene({}, true);
  Bytes newest;
  scene.radio.tap([&](bool down, PathId, std::span<const std::uint8_t> bytes) {
    const auto header = telemetry::parse_header(bytes);
    if (down && header && header->kind == telemetry::Kind::kOpening) {
      newest.assign(bytes.begin(), bytes.end());
    }
    return true;
  });
  const Instant begin = scene.radio.now();
  while (!scene.radio.base_report().established && scene.radio.now() - begin < seconds(20)) {
    for (int i = 0; i < 10 && !newest.empty(); ++i) {
      scene.radio.inject(true, 0, {0x0A010000U, 7'000}, newest);
    }
    scene.radio.step();
  }
  EXPECT_LE(scene.radio.now() - begin, seconds(2));
}

}  // namespace
}  // namespace pitwall::radio
