// Operator commands and stops that a recorded car received, as text commands for a base station.
//   in     the inputs of each tick, in order
//   out    texts with the time at which the car received them; the end of a stop request is
//          "release"
//   units  times since the origin that the caller chooses
//   invariants
//          every text except a stop overrides the gates of a base station that can be overridden,
//          with a reason
//          a console must hold the authority for commands: authority_for() gives the time span of
//          the claim, and kEvery the interval at which "take" is repeated
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hil/scenario/radio_section.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::bench {

class OperatorTexts {
 public:
  void add(const pipeline::Inputs& in, Duration at);
  std::vector<scenario::OperatorText> take() && { return std::move(texts_); }

 private:
  std::vector<scenario::OperatorText> texts_;
  world::StopRequest stop_ = world::StopRequest::kNone;
};

struct AuthorityClaim {
  static constexpr const char* kText = "take 1";
  static constexpr Duration kEvery = milliseconds(500);
  Duration from{}, until{};
};
// `texts` in order of time, at least one.
AuthorityClaim authority_for(const std::vector<scenario::OperatorText>& texts);
// The texts with the claims inserted, in order of time; empty if there are no texts.
std::vector<scenario::OperatorText> with_authority(std::vector<scenario::OperatorText> texts);

}  // namespace pitwall::bench
