// Simulated race for replay tests: the packets that a live base receives, their recording in a
// folder, and the state of a listener at any time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "basestation/replay/listener.hpp"
#include "basestation/state/vehicle_state.hpp"
#include "protocol/recorder/file_disk.hpp"
#include "protocol/recorder/segment_chain.hpp"

namespace pitwall::replay::testing {

// Listener with the vehicle state and the texts of a console.
struct Console : Listener {
  state::VehicleState vehicle;
  std::vector<std::string> texts;
  std::vector<Instant> received;
  int restarts = 0;

  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant at) override {
    vehicle.update(state, groups);
    received.push_back(at);
  }
  void text(recorder::Topic topic, Instant, std::string_view json) override {
    texts.push_back(std::string{recorder::name_of(topic)} + std::string{json});
  }
  void restart(Instant) override {
    ++restarts;
    vehicle = {};
    texts.clear();
    received.clear();
  }
};

inline constexpr Instant kRaceStart{seconds(1'000).ns};
inline constexpr Duration kPacket = milliseconds(20);
inline const recorder::ClockMap kRaceClock{.utc_minus_base = seconds(1'700'000'000),
                                           .boot = "the boot of the race"};

// Sends a listener the packets and texts of the race; each instance sends the same ones.
class Race {
 public:
  void go_to(Instant to, Listener& listener) {
    for (; now_ <= to; now_ += kPacket, ++packet_) packet(listener);
  }

 private:
  void packet(Listener& listener) {
    telemetry::GroupSet groups;
    for (std::size_t g = 0; g < telemetry::kGroups; ++g) {
      if (packet_ % (1 + g % 7) != 0) continue;
      groups.add(static_cast<telemetry::Group>(g));
      state_.sampled_at[g] = now_ - milliseconds(static_cast<std::int64_t>(10 + g));
      const auto [first, count] = telemetry::kGroupFields[g];
      for (std::size_t i = first; i < first + count; ++i) {
        // A fifth of the values is not known.
        const bool known = (packet_ / 100 + i) % 5 != 0;
        state_.values[i] = known ? static_cast<double>(packet_ + 1'000 * i) : kUnset;
      }
    }
    listener.state(state_, groups, now_);
    if (packet_ % 250 == 0) {
      listener.text(recorder::Topic::kAudit, now_, "{\"n\": " + std::to_string(packet_) + "}");
      listener.text(recorder::Topic::kAlarms, now_, "{\"a\": " + std::to_string(packet_) + "}");
    }
  }

  telemetry::Snapshot state_;
  Instant now_ = kRaceStart;
  std::size_t packet_ = 0;
};

struct Recording : Listener {
  recorder::FileDisk disk;
  recorder::SegmentChain chain;

  explicit Recording(const std::string& folder, const recorder::ClockMap& clock = kRaceClock)
      : disk(folder),
        chain(disk, {.segment = seconds(20), .run = {{"car", "7"}}, .clock = clock}) {}

  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant at) override {
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      if (!groups.has(row.group)) continue;
      const auto bytes = recorder::encode(row.group, state.values);
      chain.take({.channel = recorder::channel_of(row.group),
                  .logged = at,
                  .published = state.at(row.group),
                  .data = bytes.span()},
                 at);
    }
    chain.turn(at);
  }
  void text(recorder::Topic topic, Instant at, std::string_view json) override {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(json.data());
    chain.take({.channel = recorder::channel_of(topic),
                .logged = at,
                .published = at,
                .data = {bytes, json.size()}},
               at);
  }
  void restart(Instant) override {}
};

inline void record_race(const std::string& folder, Duration length) {
  Recording recording{folder};
  Race race;
  race.go_to(kRaceStart + length, recording);
}

// Expects the same value, quality and age for every field; values must be equal exactly.
inline void expect_same(const state::VehicleState& a, const state::VehicleState& b, Instant now) {
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    const auto x = a.view(i, now), y = b.view(i, now);
    ASSERT_EQ(x.quality, y.quality) << i;
    ASSERT_EQ(x.age, y.age) << i;
    ASSERT_TRUE(x.value == y.value || (std::isnan(x.value) && std::isnan(y.value))) << i;
  }
}

}  // namespace pitwall::replay::testing
