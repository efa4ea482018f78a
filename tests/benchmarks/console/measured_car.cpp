// SPDX-License-Identifier: Apache-2.0
// A car's end of the radio that tells times: measured_car KEYS ADDRESS SECONDS. All of its fields
// but mode and stop change with each packet. The round's speed is a number in mph that counts from
// 10 to 189 and round again, another one each 60 to 77 ms. Prints, with times of the monotonic
// clock in ns:
//   packet NUMBER TIME   a packet with this number leaves
//   stop LEVEL TIME      a datagram brought another level of stop; 0: the stop was released
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/car_radio.hpp"

namespace pitwall {
namespace {

using telemetry::field;

constexpr Duration kTick = milliseconds(5);
constexpr int kFirstNumber = 10, kNumbers = 180;
constexpr double kMphPerMps = 2.2369362920544;
constexpr std::int64_t kLeastPause_us = 60'000, kMorePause_us = 17'000;
// Room for everything in each slot: the base shall have all that the car can say.
constexpr telemetry::BudgetParams kAmple{.bytes_per_s = 125'000.0};

constexpr double kAllInEachSlot = 1.0;  // also what is not yet due

class Car {
 public:
  explicit Car(testing::CarRadio radio) : radio_(std::move(radio)) {}

  void drive(Duration length) {
    const Instant start = transport::monotonic_now();
    next_ = start;
    for (Instant tick = start; tick < start + length; tick += kTick) {
      radio_.listen(tick, [this](Instant at) { note_stop(at); });
      sample(transport::monotonic_now());
      radio_.end().standstill(true);
      while (const auto due = radio_.end().next_command(tick)) {
        radio_.end().decide(due->id, telemetry::Outcome::kApplied, tick);
      }
      const Instant leaves = transport::monotonic_now();
      if (radio_.send(snapshot_) > 0) {
        say("packet", number_, leaves);
        ++packets_;
      }
      std::fflush(stdout);
    }
  }

 private:
  static void say(const char* what, int value, Instant at) {
    std::printf("%s %d %lld\n", what, value, static_cast<long long>(at.ns));
  }

  void note_stop(Instant at) {
    const auto level = radio_.end().view(at).stop;
    if (level != stop_) say("stop", static_cast<int>(level), at);
    stop_ = level;
  }

  // Another value than in the packet before, of every field that may have one: numbers go up and
  // down about the middle of their range, whole ones between their two least values.
  double value_of(telemetry::FieldIndex i) const {
    const telemetry::FieldRow& row = telemetry::kFields[i];
    if (row.kind() != telemetry::FieldKind::kReal) {
      return row.min + static_cast<double>((packets_ + i) % 2);
    }
    const double wave = 0.05 * std::sin(static_cast<double>(packets_ + 7 * i) * 0.05);
    const double swing = (packets_ + i) % 2 == 0 ? 0.03 : -0.03;
    return row.min + (row.max - row.min) * (0.5 + wave + swing);
  }

  void sample(Instant now) {
    for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
      snapshot_.values[i] = value_of(i);
    }
    if (now >= next_) {
      number_ = kFirstNumber + (number_ - kFirstNumber + 1) % kNumbers;
      next_ =
          now + microseconds(kLeastPause_us + static_cast<std::int64_t>(random_()) % kMorePause_us);
    }
    const auto operators = radio_.end().view(now);
    snapshot_.values[field("flags.round_target_speed")] = number_ / kMphPerMps;
    // It creeps: the base lets no stop go while a car drives.
    snapshot_.values[field("ego.vx")] = packets_ % 2 == 0 ? 0.2 : 0.4;
    snapshot_.values[field("radio.loss_0")] = packets_ % 2 == 0 ? 0.0 : 0.01;
    snapshot_.values[field("mode.mode")] = 2;
    snapshot_.values[field("mode.stop_challenge")] = operators.stop_challenge;
    snapshot_.values[field("mode.stop_latch")] = static_cast<double>(operators.stop);
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) snapshot_.at(row.group) = now;
  }

  testing::CarRadio radio_;
  telemetry::Snapshot snapshot_;
  telemetry::StopLevel stop_ = telemetry::StopLevel::kNone;
  std::mt19937 random_{1};
  std::uint64_t packets_ = 0;
  int number_ = kFirstNumber;
  Instant next_{};
};

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() != 3) return 2;
  auto radio = pitwall::testing::CarRadio::open(words, pitwall::kAmple, pitwall::kAllInEachSlot);
  if (!radio) {
    std::fprintf(stderr, "%s\n", to_string(radio.error()).c_str());
    return 1;
  }
  pitwall::Car(*std::move(radio)).drive(pitwall::from_seconds(std::stod(words[2])));
}
