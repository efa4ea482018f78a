// The fades of a link over time: good and bad alternate, each for an exponential time. What is on
// the air does not move them.
//   in     times, which never go back
//   out    whether the air is faded then
//   invariants
//          one seed, one trace; the first state is drawn too, so that the trace is stationary from
//          its start at Instant{}
//   cost   one draw for each change of state that has passed
//   source Gilbert 1960, Elliott 1963, in continuous time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hil/link/link_params.hpp"
#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

class FadeProcess {
 public:
  FadeProcess(const Fades& fades, std::uint64_t seed);

  bool bad(Instant at);
  Instant until() const { return until_; }  // the state that bad() told lasts to here

 private:
  Duration draw(Duration mean);

  Duration mean_good_, mean_bad_;
  sensors::Noise random_;
  bool bad_ = false;
  Instant until_{};
};

}  // namespace pitwall::link
