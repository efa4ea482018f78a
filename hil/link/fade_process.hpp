// Fading of a radio link over time: good and bad states alternate, each for an exponential time,
// independent of the traffic.
//   in     times, never decreasing
//   out    whether the link fades at that time
//   invariants
//          one seed gives one trace; the first state is drawn too, so that the trace is stationary
//          from its start at Instant{}
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
  Instant until() const { return until_; }  // end of the state that bad() returned

 private:
  Duration draw(Duration mean);

  Duration mean_good_, mean_bad_;
  sensors::Noise random_;
  bool bad_ = false;
  Instant until_{};
};

}  // namespace pitwall::link
