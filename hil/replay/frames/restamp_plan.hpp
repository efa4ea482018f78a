// Plan of restamping the frames of one bus, pass after pass: each message counts on from frame to
// frame and from pass to pass, whatever was left out in between.
//   in     rules, how the senders counted, the frames that are played
//   out    stamp(): the frame as it goes out in a pass; how many can be stamped
//   invariants
//          the first frame of a message keeps its counter where that lies in the range; the n-th
//          one after it, over all passes, is n further in the range
//          a frame without a rule, of another length than its message, or a remote one stays as it
//          is
//   cost   8 bytes a frame; stamp() O(1) without allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hil/replay/frames/restamp_rules.hpp"

namespace pitwall::replay {

class RestampPlan {
 public:
  RestampPlan() = default;  // of no frames
  RestampPlan(const RestampRules& rules, const CounterHistory& history,
              std::span<const can::Frame> frames);

  // False: frame i stays as it is.
  bool stamp(std::size_t i, unsigned pass, can::Frame& frame) const;

  std::uint64_t stamped() const { return stamped_; }  // frames of a pass
  std::uint64_t unfit() const { return unfit_; }      // of a message with a rule, but not stamped

 private:
  struct Sender {
    RestampRule rule;
    CounterRange range;
    std::uint32_t first = 0;     // from the bottom of the range
    std::uint32_t per_pass = 0;  // frames
  };
  struct Place {
    std::uint32_t sender = kNobody, number = 0;
  };
  static constexpr std::uint32_t kNobody = UINT32_MAX;

  std::vector<Sender> senders_;
  std::vector<Place> places_;  // of each frame
  std::uint64_t stamped_ = 0, unfit_ = 0;
};

}  // namespace pitwall::replay
