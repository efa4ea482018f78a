// A radio link as the bench sees it, one direction: a byte queue before a serial air, then delay,
// and what the air does to datagrams. A simulation; virtual time, from Instant{} on.
//   in     datagrams and when they were offered; where the car is, if loss depends on it
//   out    datagrams and when they arrive
//   invariants
//          each effect draws from its own seeded stream; fades are drawn over time, not over
//          datagrams, so that every sender under one seed meets the same fades. What fades, fades
//          while it is on the air: the moment when its last byte leaves decides. Whatever becomes
//          of a datagram, it has used its time on the air. offered + duplicated = delivered + each
//          reason + what is under way
//   units  Instant; sizes are UDP payload, the overhead is added here
//   errors what is dropped is counted by reason
//   cost   an hour of a 100 Hz sender in less than 5 s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hil/link/fade_process.hpp"
#include "hil/link/link_params.hpp"
#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

struct LinkCounters {
  std::uint64_t offered = 0, delivered = 0;
  std::uint64_t bytes = 0;  // that were put on the air, with overhead
  std::uint64_t queue_full = 0, faded = 0, lost = 0, blacked_out = 0;
  std::uint64_t duplicated = 0, corrupted = 0, reordered = 0;
};

struct Datagram {
  std::vector<std::uint8_t> bytes;
  Instant offered{}, arrives{};
  std::uint64_t tag = 0;  // of the caller: from where, over which path
};

class LinkEmulator {
 public:
  LinkEmulator(LinkParams params, std::uint64_t seed);

  // Times never go back.
  void offer(std::span<const std::uint8_t> bytes, Instant now, std::uint64_t tag = 0);
  // The next that has arrived by now, in order of arrival.
  std::optional<Datagram> take(Instant now);
  // When the next one arrives; none: nothing is under way.
  std::optional<Instant> next() const;

  // Where the car is from now on: for loss by place.
  void place(double station_m) { station_m_ = station_m; }

  bool faded(Instant at);  // the air at this time; times never go back
  std::size_t queued_bytes(Instant now) const;
  const LinkCounters& counters() const { return counters_; }

 private:
  std::optional<Instant> through_the_queue(std::size_t size, Instant now);
  bool survives(Instant on_air);
  Instant arrival_of(Instant on_air);
  void spoil(std::vector<std::uint8_t>& bytes);
  void send_off(Datagram datagram);

  LinkParams params_;
  FadeProcess fades_, asked_;  // the same trace twice: datagrams run ahead of who asks
  sensors::Noise loss_, jitter_, reorder_, duplicate_, corrupt_;
  Instant last_offer_{}, air_free_{}, last_in_order_{};
  double station_m_ = 0.0;
  std::deque<Datagram> under_way_;
  LinkCounters counters_;
};

}  // namespace pitwall::link
