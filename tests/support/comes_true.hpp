// Wait for a condition that another thread or the kernel makes true.
//   in     a condition, checked every millisecond
//   out    false if it is still not true after ten seconds, far more than a working machine needs
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/transport/clock.hpp"

namespace pitwall::testing {

template <class Condition>
bool comes_true(Condition&& condition) {
  const Instant limit = transport::monotonic_now() + seconds(10);
  while (!condition()) {
    if (transport::monotonic_now() > limit) return false;
    transport::sleep_until(transport::monotonic_now() + milliseconds(1));
  }
  return true;
}

}  // namespace pitwall::testing
