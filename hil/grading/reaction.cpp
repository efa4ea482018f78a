// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/reaction.hpp"

namespace pitwall::grading {

void ReactionMonitor::observe(const ReactionTick& tick) {
  if (before_) {
    const Duration since = tick.at - before_->at;
    const bool drives = before_->speed_mps >= kStands_mps;
    const bool stops = !tick.stop.empty() && tick.stop != stop_;
    if (open_) follow(tick, before_->speed_mps * since.seconds());
    if (tick.restriction < before_->restriction) open_ = false;
    // A stop that answers the flag which is being followed is its reaction, not another one.
    if (tick.restriction > before_->restriction && drives) {
      begin(tick.flag, tick, false);
    } else if (stops && drives && !open_) {
      begin(tick.stop, tick, true);
    }
  }
  stop_ = tick.stop;
  before_ = tick;
  before_->flag = before_->stop = {};  // views of the caller's
}

void ReactionMonitor::begin(std::string_view to, const ReactionTick& tick, bool answered) {
  open_ = reactions_.size() < kKept;
  if (!open_) {
    ++left_out_;
    return;
  }
  reactions_.push_back({.to = std::string{to}, .at = tick.at, .speed_mps = tick.speed_mps});
  if (answered) reactions_.back().reaction = Duration{};
  driven_m_ = 0.0;
  throttle_then_ = before_->throttle;
  brake_then_kpa_ = before_->brake_kpa;
}

void ReactionMonitor::follow(const ReactionTick& tick, double driven_m) {
  Reaction& reaction = reactions_.back();
  driven_m_ += driven_m;
  const bool lifts = throttle_then_ > kCoasts && tick.throttle <= kThrottleShare * throttle_then_;
  const bool acts = lifts || tick.brake_kpa >= brake_then_kpa_ + kBrakeRise_kpa ||
                    (!tick.stop.empty() && tick.stop != stop_);
  if (!reaction.reaction && acts) reaction.reaction = tick.at - reaction.at;
  if (tick.speed_mps < kStands_mps) {
    reaction.stop_m = driven_m_;
    open_ = false;
  }
}

}  // namespace pitwall::grading
