// Trust in one stream: after several consecutive refusals or a long silence the samples of a stream
// must be consistent for a while before they are used again.
//
//   refused  x x x . . . . . . . .      x refused by a check, . passes every check
//   trusted  T T - - - - - - - T T      again after readmit_after_s without an x; alone: sooner
//
//   in     per sample: whether it passed every check, and whether no other source gives this state
//   out    whether it may enter the filter
//   cost   O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/localization/checks/check_params.hpp"

namespace pitwall::localization {

struct Trust {
  bool trusted = true, received = false, consistent = false;
  std::uint8_t refused_in_row = 0;
  Instant received_at{}, consistent_since{};

  // A sample arrives at `now`; a silence before it of more than `silence_s` ends the trust.
  void receive(double silence_s, Instant now);
  // The sample was refused.
  void refuse(const CheckParams& params);
  // The sample passed every check. Returns true if it may enter the filter.
  bool admit(const CheckParams& params, bool alone, Instant now);
};
static_assert(std::is_trivially_copyable_v<Trust>);

}  // namespace pitwall::localization
