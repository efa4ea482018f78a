// State of the downlink: good, degraded or lost, from measured figures.
//   in     the newest authentic packet, loss and round trip of the last seconds
//   out    state, and since when
//   invariants
//          lost: no packet for kLostAfter, 20 of them, so that a console shows it within half a
//          second. Degraded: loss of the last seconds above kLossMax in one direction, or a round
//          trip above kRoundTripMax. From degraded to good only after kGoodFor of neither; from
//          lost with the first packet to degraded. A car that was never heard has none of these
//   units  loss 0 .. 1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "basestation/state/known.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::state {

enum class LinkState : std::uint8_t { kNone, kGood, kDegraded, kLost };

class LinkWatch {
 public:
  static constexpr Duration kLostAfter = milliseconds(400), kGoodFor = seconds(2);
  static constexpr double kLossMax = 0.10, kRoundTripMax_ms = 150.0;

  void step(const LinkFigures& link, Instant now);
  LinkState state() const { return state_; }
  Instant since() const { return since_; }

 private:
  void become(LinkState state, Instant now);

  LinkState state_ = LinkState::kNone;
  Instant since_{};
  std::optional<Instant> clean_since_;
};

}  // namespace pitwall::state
