// Mapping of one frame from the car to SI signals, with its ranges and slew limits. The frame is
// applied to the state as a whole if every value is plausible, otherwise not at all.
//   in     a frame that has passed the integrity rules of inbound.hpp (identifier, length, counter)
//   out    Reading: applied, or the reason for the refusal
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
