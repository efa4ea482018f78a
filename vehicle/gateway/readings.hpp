// One frame of the car, decoded and applied to the state if all of it is plausible; else nothing of
// it. Holds the mapping from the signals of the CAN database to SI, and the ranges and slews.
//   in     a frame that has passed the integrity rules of inbound.hpp (id, length, counter)
//   out    Reading: applied, or why not
//   units  in: as in the CAN database; out: SI
//   errors by value
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/can/frame.hpp"
#include "vehicle/gateway/inbound.hpp"

namespace pitwall::gateway {

enum class Reading : std::uint8_t { kApplied, kNotFinite, kOutOfRange, kImplausibleSlew };

Reading apply(const InboundParams& params, InboundState& state, const can::ReceivedFrame& received);

}  // namespace pitwall::gateway
