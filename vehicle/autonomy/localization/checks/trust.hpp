// Trust in a stream: a stream that was refused some times in a row, or was silent for long, has to
// be consistent for a while before it is used again.
//
//   refused  x x x . . . . . . . .      x refused for a reason of its own, . passes every check
//   trusted  T T - - - - - - - T T      after readmit_after_s without an x; alone: sooner
//
//   in     per sample: whether it passed every check; whether nothing else gives this state
//   out    whether it may enter
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

  // A sample comes at `now`; a silence before it that was longer than `silence_s` ends the trust.
  void receive(double silence_s, Instant now);
  // It was refused.
  void refuse(const CheckParams& params);
  // It passed every check; true: it may enter.
  bool admit(const CheckParams& params, bool alone, Instant now);
};
static_assert(std::is_trivially_copyable_v<Trust>);

}  // namespace pitwall::localization
