// Emulator of one direction of a radio link: a byte queue before a serial transmitter, then delay,
// loss, duplication, corruption and reordering. Virtual time, from Instant{} on.
//   in     datagrams with the time of the offer; the station of the car, for loss that depends on
//          it
//   out    datagrams with the time of arrival
//   invariants
//          each effect draws from its own seeded stream. Fades are drawn over time, not per
//          datagram, so that every sender under one seed has the same fades. The moment when the
//          last byte of a datagram is sent decides whether it fades. A lost datagram has used its
//          transmission time too. offered + duplicated = delivered + dropped for each reason + in
//          transit
//   units  Instant; sizes are UDP payload, the overhead is added here
//   errors dropped datagrams are counted by reason
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
  std::uint64_t bytes = 0;  // transmitted, with overhead
  std::uint64_t queue_full = 0, faded = 0, lost = 0, blacked_out = 0;
  std::uint64_t duplicated = 0, corrupted = 0, reordered = 0;
};

struct Datagram {
  std::vector<std::uint8_t> bytes;
  Instant offered{}, arrives{};
  std::uint64_t tag = 0;  // of the caller: source, path
};

class LinkEmulator {
 public:
  LinkEmulator(LinkParams params, std::uint64_t seed);

  // Times never decrease.
  void offer(std::span<const std::uint8_t> bytes, Instant now, std::uint64_t tag = 0);
  // The next datagram that has arrived by now, in order of arrival.
  std::optional<Datagram> take(Instant now);
  // Arrival of the next datagram; nullopt if none is in transit.
  std::optional<Instant> next() const;

  // Station of the car from now on, for loss that depends on it.
  void place(double station_m) { station_m_ = station_m; }

  bool faded(Instant at);  // whether the link fades at this time; times never decrease
  std::size_t queued_bytes(Instant now) const;
  const LinkCounters& counters() const { return counters_; }

 private:
  std::optional<Instant> through_the_queue(std::size_t size, Instant now);
  bool survives(Instant on_air);
  Instant arrival_of(Instant on_air);
  void corrupt(std::vector<std::uint8_t>& bytes);
  void send_off(Datagram datagram);

  LinkParams params_;
  FadeProcess fades_, query_fades_;  // two copies of one trace: datagrams may be ahead of faded()
  sensors::Noise loss_, jitter_, reorder_, duplicate_, corrupt_;
  Instant last_offer_{}, air_free_{}, last_in_order_{};
  double station_m_ = 0.0;
  std::deque<Datagram> under_way_;
  LinkCounters counters_;
};

}  // namespace pitwall::link
