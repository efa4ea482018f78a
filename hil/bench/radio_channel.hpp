// Radio channel between car and base station: one link emulator per path and direction, and the
// radio faults of the scenario. The caller gives the time, real or virtual.
//   in     datagrams of one end; radio faults; now in scenario time, never decreasing
//   out    the datagrams that arrive at the other end; the time since the car last received the
//          base
//   invariants
//          radio_down: nothing passes in either direction. base_station_silent: nothing reaches the
//          car. radio_loss: each datagram is lost with probability `value`. radio_delay: each
//          datagram arrives `value` seconds later, in order (like a queue that is too long)
//          both directions of a path have the same fades; two paths have different ones
//   errors dropped datagrams are counted by reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "hil/link/link_emulator.hpp"
#include "hil/scenario/radio_section.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

enum class Way : std::uint8_t { kDown, kUp };  // to the base, to the car
inline constexpr std::size_t kWays = 2;

struct Payload {
  std::span<const std::uint8_t> bytes;
  std::uint64_t tag = 0;  // arrives with the bytes: link::Datagram::tag
};

struct RadioChannelCounters {
  std::array<std::uint64_t, kWays> offered{}, delivered{}, switched_off{}, lost{};
};

class RadioChannel {
 public:
  // `paths` empty: a single path without delay and loss.
  RadioChannel(const std::vector<scenario::RadioPath>& paths,
               std::vector<faults::BenchFault> faults, std::uint64_t seed);

  std::uint8_t paths() const { return static_cast<std::uint8_t>(lanes_.size()); }
  void offer(Way way, telemetry::PathId path, const Payload& payload, Instant now);
  // The next datagram that has arrived by now.
  std::optional<link::Datagram> take(Way way, telemetry::PathId path, Instant now);
  void place(double station_m);  // station of the car, for loss that depends on it

  // Time since the newest base datagram that reached the car was sent; nullopt before the first.
  std::optional<Duration> silence(Instant now) const;
  // The longest silence of the run so far; zero before the first datagram reached the car.
  Duration longest_silence(Instant now) const;
  const RadioChannelCounters& counters() const { return counters_; }
  const link::LinkCounters& counters(Way way, telemetry::PathId path) const;

 private:
  struct Lane {
    link::LinkEmulator emulator;
    Random random;
    std::deque<link::Datagram> held;  // arrived, and held back by radio_delay
    Instant last{};                   // arrival of the newest held one
  };

  Lane& lane(Way way, telemetry::PathId path) {
    return lanes_[path][static_cast<std::size_t>(way)];
  }
  // The greatest value of the active faults of this kind; nullopt if none is active.
  std::optional<double> active(faults::BenchFaultKind kind, Instant at) const;
  bool is_off(Way way, Instant at) const;
  void hold_back(Lane& lane, Instant now);
  void note_received(Instant sent, Instant now);

  std::vector<faults::BenchFault> faults_;
  std::vector<std::array<Lane, kWays>> lanes_;
  std::optional<Instant> newest_up_;
  Duration longest_{};  // before newest_up_ arrived
  RadioChannelCounters counters_;
};

}  // namespace pitwall::bench
