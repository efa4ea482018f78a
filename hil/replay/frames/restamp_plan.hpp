// Plan of restamping the frames of one bus over all passes of a replay: the counter of each message
// continues from frame to frame and from pass to pass, even if frames in between are left out.
//   in     rules, the recorded counting of the senders, the frames that are played
//   out    stamp(): the frame as sent in a pass; number of frames that can be stamped
//   invariants
//          the first frame of a message keeps its counter if that is within the range; the n-th
//          frame after it, over all passes, counts n further within the range
//          a frame without a rule, with another length than its message, or a remote frame is not
//          changed
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
  RestampPlan() = default;  // for no frames
  RestampPlan(const RestampRules& rules, const CounterHistory& history,
              std::span<const can::Frame> frames);

  // Returns false if frame i stays unchanged.
  bool stamp(std::size_t i, unsigned pass, can::Frame& frame) const;

  std::uint64_t stamped() const { return stamped_; }  // number of stamped frames per pass
  // frames of a message with a rule that cannot be stamped
  std::uint64_t unfit() const { return unfit_; }

 private:
  struct Sender {
    RestampRule rule;
    CounterRange range;
    std::uint32_t first = 0;     // offset from the bottom of the range
    std::uint32_t per_pass = 0;  // frames per pass
  };
  struct Place {
    std::uint32_t sender = kNoSender, number = 0;
  };
  static constexpr std::uint32_t kNoSender = UINT32_MAX;

  std::vector<Sender> senders_;
  std::vector<Place> places_;  // one per frame
  std::uint64_t stamped_ = 0, unfit_ = 0;
};

}  // namespace pitwall::replay
