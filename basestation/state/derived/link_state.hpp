// State of the downlink: good, degraded or lost, from measured figures.
//   in     the time of the newest authentic packet, loss and round trip of the last seconds
//   out    state, and since when
//   invariants
//          lost: no packet for kLostAfter, which is 20 packet periods, so that a console shows it
//          within half a second. Degraded: loss of the last seconds above kLossMax in one
//          direction, or a round trip above kRoundTripMax_ms. From degraded to good after kGoodFor
//          without either; from lost to degraded with the first packet. Before the first packet of
//          the car the state is kNone
//   units  loss 0 .. 1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "basestation/state/known.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::state {

enum class LinkState : std::uint8_t { kNone, kGood, kDegraded, kLost };

class LinkStateMonitor {
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
