// Is this the bus that the database describes? Before the car may arm, ids, lengths and periods on
// the bus are compared with the database: the same id means different things in different revisions
// (a steering angle of 10 bits read as 11 is +511 degrees).
//   in     frames of this tick, whether the car is armed, now
//   out    kListening until every required message has been heard often enough to judge its
//          period, kRight, or kWrong with the first message that differs and how
//   units  seconds, bytes
//   law    while disarmed the verdict follows a sliding window of `listen`; a difference heals when
//          a whole window has passed without it. While armed the verdict stands: a frame that goes
//          astray at speed is a matter of integrity, not of identity
//   order  of several differences the one with the smallest id is named; unknown ids and wrong
//          lengths before silence and wrong periods, because they are proof and those are absence
//   errors none
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "protocol/can/av21.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/bus_health.hpp"

namespace pitwall::gateway {

struct IdentityParams {
  Duration listen = milliseconds(2500);  // [1.5, 10] s; longer than twice the slowest period
};

struct IdentityState {
  std::uint64_t placeholder = 0;
};
static_assert(std::is_trivially_copyable_v<IdentityState>);

world::BusIdentity identify(const IdentityParams& params, IdentityState& state,
                            std::span<const can::ReceivedFrame> frames, bool armed, Instant now);

}  // namespace pitwall::gateway
