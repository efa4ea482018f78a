// The car's ear for its base station: lets each heartbeat through once, and says when the base was
// known to live and how long the way there and back is.
//   in     datagrams of the radio socket and when they were received; the car's own run
//   out    alive_at: the base was alive then, on the car's clock. It is when the car sent the
//          packet that the heartbeat names plus the time that the base held it, so at most when
//          the heartbeat was sent: one that waited in a queue, or was kept and sent again, is as
//          old as it is. The clocks of car and base need not agree
//          round_trip: of the newest packet that a heartbeat answered
//   law    a heartbeat counts if it is whole, of the base's present run (RunFilter), newer than
//          the newest, and answers a packet of this run of this car; all others are counted by what
//          is wrong with them. alive_at never goes back
//   errors counters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/heartbeat.hpp"
#include "protocol/telemetry/run_filter.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct HeartbeatCounters {
  std::uint64_t received = 0, accepted = 0;
  std::uint64_t old = 0;        // not newer than one accepted: late, double, or sent again
  std::uint64_t other_run = 0;  // of a second base, or of the time before its restart
  std::uint64_t other_car = 0;  // answers another car, or this one before its restart
  std::uint64_t too_early = 0;  // answers what the car had not sent yet
  std::uint64_t runs = 0;       // starts of the base
  std::array<std::uint64_t, kPacketErrors> refused{};  // by PacketError

  constexpr std::uint64_t refused_total() const {
    std::uint64_t sum = old + other_run + other_car + too_early;
    for (const std::uint64_t n : refused) sum += n;
    return sum;
  }
};

class HeartbeatIntake {
 public:
  explicit HeartbeatIntake(std::uint32_t own_run) : own_run_(own_run) {}

  void feed(std::span<const std::uint8_t> datagram, Instant at);

  std::optional<Instant> alive_at() const { return alive_at_; }
  std::optional<Duration> round_trip() const { return round_trip_; }
  const HeartbeatCounters& counters() const { return counters_; }

 private:
  bool is_fresh(const BaseHeartbeat& heartbeat, Instant at);

  std::uint32_t own_run_;
  RunFilter runs_;
  std::uint32_t newest_ = 0, answered_ = 0;  // of the base, of the car
  bool ever_answered_ = false;
  std::optional<Instant> alive_at_;
  std::optional<Duration> round_trip_;
  HeartbeatCounters counters_;
};

}  // namespace pitwall::telemetry
