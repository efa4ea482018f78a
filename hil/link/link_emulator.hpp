// A radio link as the bench sees it, one direction: a byte queue before a serial air, then delay,
// and what the air does to datagrams. A simulation; virtual time.
//   in     datagrams and when they were offered
//   out    datagrams and when they arrive
//   law    each effect draws from its own seeded stream; fades are drawn over time, not over
//          datagrams, so that every sender under one seed meets the same fades. What fades, fades
//          while it is on the air
//   units  Instant; sizes are UDP payload, the overhead is added here
//   errors what is dropped is counted by reason
//   cost   an hour of a 100 Hz sender in less than 5 s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hil/link/link_params.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

struct LinkCounters {
  std::uint64_t offered = 0, delivered = 0, bytes = 0;  // with overhead
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

  bool faded(Instant at);  // the air at this time; times never go back
  std::size_t queued_bytes(Instant now) const;
  const LinkCounters& counters() const { return counters_; }

 private:
  LinkParams params_;
  std::uint64_t seed_;
  std::deque<Datagram> under_way_;
  LinkCounters counters_;
};

}  // namespace pitwall::link
