// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/restamp_plan.hpp"

namespace pitwall::replay {

RestampPlan::RestampPlan(const RestampRules& rules, const CounterHistory& history,
                         std::span<const can::Frame> frames) {
  std::vector<std::uint32_t> sender_of(rules.rules.size(), kNoSender);
  places_.resize(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::size_t place = rules.place_of(frames[i]);
    if (place == RestampRules::kNone) continue;
    const RestampRule& rule = rules.rules[place];
    if (!RestampRules::fits(rule, frames[i])) {
      ++unfit_;
      continue;
    }
    if (sender_of[place] == kNoSender) {
      sender_of[place] = static_cast<std::uint32_t>(senders_.size());
      Sender sender{.rule = rule, .range = {}};
      if (rule.counter_bits > 0) {
        sender.range = history.range_of(place);
        const std::uint32_t value = rule.counter_of(frames[i]);
        const bool lies_in = value >= sender.range.bottom && value <= sender.range.top;
        sender.first = lies_in ? value - sender.range.bottom : 0;
      }
      senders_.push_back(sender);
    }
    Sender& sender = senders_[sender_of[place]];
    places_[i] = {.sender = sender_of[place], .number = sender.per_pass++};
    ++stamped_;
  }
}

bool RestampPlan::stamp(std::size_t i, unsigned pass, can::Frame& frame) const {
  if (i >= places_.size() || places_[i].sender == kNoSender) return false;
  const Sender& sender = senders_[places_[i].sender];
  const std::uint64_t number =
      std::uint64_t{sender.first} + places_[i].number + std::uint64_t{pass} * sender.per_pass;
  const auto counter =
      sender.range.bottom + static_cast<std::uint32_t>(number % sender.range.length());
  sender.rule.stamp(frame, counter);
  return true;
}

}  // namespace pitwall::replay
