// Radio channel between car and base station: a link emulator for each path and direction, and what
// the scenario does to the radio. Real time or virtual: it is told the time.
//   in     datagrams of one end; faults of the radio; now, of the scenario, never going back
//   out    those that arrive at the other end; when the car could last hear its base
//   invariants
//          radio_down: nothing passes either way. base_station_silent: nothing reaches the car.
//          radio_loss: each datagram is lost with this probability. radio_delay: each comes so much
//          later, in order (what waits in a queue that is too long)
//          both directions of a path meet the same fades; two paths meet different ones
//   errors what is dropped is counted by reason
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
  std::uint64_t tag = 0;  // arrives with them: link::Datagram::tag
};

struct RadioChannelCounters {
  std::array<std::uint64_t, kWays> offered{}, delivered{}, switched_off{}, lost{};
};

class RadioChannel {
 public:
  // No path given: one that takes no time and loses nothing.
  RadioChannel(const std::vector<scenario::RadioPath>& paths,
               std::vector<faults::BenchFault> faults, std::uint64_t seed);

  std::uint8_t paths() const { return static_cast<std::uint8_t>(lanes_.size()); }
  void offer(Way way, telemetry::PathId path, const Payload& payload, Instant now);
  // The next that has arrived by now.
  std::optional<link::Datagram> take(Way way, telemetry::PathId path, Instant now);
  void place(double station_m);  // of the car: for loss by place

  // Since the newest datagram of the base that reached the car was sent; none: none has yet.
  std::optional<Duration> silence(Instant now) const;
  // The longest of the run so far; zero before the car has heard anything.
  Duration longest_silence(Instant now) const;
  const RadioChannelCounters& counters() const { return counters_; }
  const link::LinkCounters& counters(Way way, telemetry::PathId path) const;

 private:
  struct Lane {
    link::LinkEmulator emulator;
    Random random;
    std::deque<link::Datagram> held;  // arrived, but for radio_delay
    Instant last{};                   // arrival of the newest of them
  };

  Lane& lane(Way way, telemetry::PathId path) {
    return lanes_[path][static_cast<std::size_t>(way)];
  }
  // The greatest value of the active faults of this kind; none: none is active.
  std::optional<double> active(faults::BenchFaultKind kind, Instant at) const;
  bool is_off(Way way, Instant at) const;
  void hold_back(Lane& lane, Instant now);
  void note_received(Instant sent, Instant now);

  std::vector<faults::BenchFault> faults_;
  std::vector<std::array<Lane, kWays>> lanes_;
  std::optional<Instant> newest_up_;
  Duration longest_{};  // until newest_up_ came
  RadioChannelCounters counters_;
};

}  // namespace pitwall::bench
