// SPDX-License-Identifier: Apache-2.0
// A car's end of the radio as a process, with recognisable values: radio_car KEYS ADDRESS SECONDS
// [ADDRESS2]. Prints what the base wanted of it: "stop LEVEL", "command NAME ARGUMENT", and at the
// end "sessions N". PITWALL_CAR_SPEED_MPS: its speed, where two are to be told apart.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/support/car_radio.hpp"
#include "tests/support/test_clock.hpp"

namespace pitwall {
namespace {

using telemetry::field;
using telemetry::Group;

constexpr Duration kTick = milliseconds(10);
constexpr double kGreen = 4.0, kAttacker = 10.0;  // flags as race control shows them

double speed_of_this_one() {
  const char* const asked = std::getenv("PITWALL_CAR_SPEED_MPS");
  return asked == nullptr ? 50.5 : std::stod(asked);
}

class Car {
 public:
  explicit Car(testing::CarRadio radio) : radio_(std::move(radio)) {}

  void drive(Duration length) {
    const Instant start = transport::monotonic_now();
    radio_.end().log(telemetry::make_event(telemetry::TextEvent{"the car is here"}, start));
    for (Instant tick = start; tick < start + length; tick += kTick) {
      radio_.listen(tick);
      sample(transport::monotonic_now(), (tick - start).seconds());
      execute(transport::monotonic_now());
      radio_.send(snapshot_);
    }
    std::printf("sessions %llu\n", static_cast<unsigned long long>(
                                       radio_.end().report(transport::monotonic_now()).sessions));
  }

 private:
  void sample(Instant now, double time_s) {
    auto& values = snapshot_.values;
    values[field("mode.mode")] = 2;
    values[field("mode.stop_challenge")] = radio_.end().view(now).stop_challenge;
    values[field("mode.stop_latch")] = static_cast<double>(radio_.end().view(now).stop);
    values[field("ego.x")] = 12.5;
    values[field("ego.vx")] = speed_mps_;
    values[field("track.station")] = std::min(speed_mps_ * time_s, 12'000.0);
    values[field("tyres.pressure_rear_left")] = 152.5;
    values[field("flags.track")] = values[field("flags.track_acted_on")] = kGreen;
    values[field("flags.vehicle")] = values[field("flags.vehicle_acted_on")] = kAttacker;
    values[field("flags.conflict")] = 0;
    values[field("flags.heartbeat_age")] = 0.05;
    values[field("opponent_1.identity")] = 3;
    values[field("opponent_1.station")] = 400.0;
    values[field("opponent_1.offset")] = -2.0;
    values[field("opponent_1.speed")] = 40.0;
    values[field("opponent_1.age")] = 0.1;
    values[field("opponent_1.position_sigma")] = 0.5;
    for (const Group group : {Group::kMode, Group::kFlags, Group::kEgo, Group::kTrack,
                              Group::kTyres, Group::kOpponent1}) {
      snapshot_.at(group) = now;
    }
  }

  void execute(Instant now) {
    radio_.end().standstill(true);
    const auto level = radio_.end().view(now).stop;
    if (level != stop_) std::printf("stop %d\n", static_cast<int>(level));
    stop_ = level;
    while (const auto due = radio_.end().next_command(now)) {
      std::printf("command %s %g\n", std::string{telemetry::row_of(due->command.type).name}.c_str(),
                  due->command.argument);
      radio_.end().decide(due->id, telemetry::Outcome::kApplied, now);
    }
    std::fflush(stdout);
  }

  const double speed_mps_ = speed_of_this_one();
  testing::CarRadio radio_;
  telemetry::Snapshot snapshot_;
  telemetry::StopLevel stop_ = telemetry::StopLevel::kNone;
};

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3 || words.size() > 4) return 2;
  if (!pitwall::testing::use_test_clock()) return 2;
  auto radio = pitwall::testing::CarRadio::open(words);
  if (!radio) {
    std::fprintf(stderr, "%s\n", to_string(radio.error()).c_str());
    return 1;
  }
  pitwall::Car(*std::move(radio)).drive(pitwall::from_seconds(std::stod(words[2])));
}
