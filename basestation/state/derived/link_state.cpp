// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/link_state.hpp"

namespace pitwall::state {

void LinkStateMonitor::step(const LinkFigures& link, Instant now) {
  if (!link.received) return;
  if (now - *link.received >= kLostAfter) return become(LinkState::kLost, now);
  const bool poor =
      link.down_loss > kLossMax || link.up_loss > kLossMax || link.round_trip_ms > kRoundTripMax_ms;
  if (state_ == LinkState::kLost || poor) {
    clean_since_.reset();
    return become(LinkState::kDegraded, now);
  }
  if (state_ == LinkState::kNone) return become(LinkState::kGood, now);
  if (state_ == LinkState::kGood) return;
  if (!clean_since_) clean_since_ = now;
  if (now - *clean_since_ >= kGoodFor) become(LinkState::kGood, now);
}

void LinkStateMonitor::become(LinkState state, Instant now) {
  if (state_ == state) return;
  state_ = state;
  since_ = now;
}

}  // namespace pitwall::state
