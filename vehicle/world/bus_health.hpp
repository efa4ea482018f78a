// What gateway/inbound thinks of the traffic it hears: one row per expected message and a count of
// every frame that was not applied, by kind.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::world {

enum class Liveness : std::uint8_t { kNever, kAlive, kLate, kLost };

struct MessageHealth {
  std::uint32_t id = 0;
  Liveness liveness = Liveness::kNever;
  std::uint8_t counter_debt = 0;  // leaky bucket: +1 bad, -1 good
  Instant last{};
};

struct FrameRefusals {
  std::uint64_t unknown_id = 0, wrong_length = 0, remote_or_error = 0, stuck_counter = 0,
                jumped_counter = 0, not_finite = 0, out_of_range = 0, implausible_slew = 0;

  constexpr std::uint64_t total() const {
    return unknown_id + wrong_length + remote_or_error + stuck_counter + jumped_counter +
           not_finite + out_of_range + implausible_slew;
  }
};

struct BusHealth {
  std::uint64_t frames_applied = 0;
  FrameRefusals refused;
  FixedVector<MessageHealth, 64> messages;
  Instant last_frame{};
};

}  // namespace pitwall::world
