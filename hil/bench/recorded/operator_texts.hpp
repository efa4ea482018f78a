// Commands and stops that a recorded car had from its operator, as text commands of a base station.
//   in     the inputs of each tick, in order
//   out    texts with the time at which the car had them; a stop that is let go is a "release"
//   units  times as the caller counts them
//   invariants
//          every text overrides the gates of a base station that can be overridden, with a reason
//          a console must hold the authority for commands: authority() says from when until when,
//          and how often "take" has to be said meanwhile
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
// Of texts in the order of time, at least one.
AuthorityClaim authority_for(const std::vector<scenario::OperatorText>& texts);
// The claims among the texts, in the order of time; without texts none.
std::vector<scenario::OperatorText> with_authority(std::vector<scenario::OperatorText> texts);

}  // namespace pitwall::bench
