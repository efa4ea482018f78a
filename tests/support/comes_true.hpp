// Waits for what another thread or the kernel does in its own time.
//   in     a condition, looked at every millisecond
//   out    false: it did not come true within ten seconds, which no working machine needs
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
