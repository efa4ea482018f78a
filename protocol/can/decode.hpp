// Decoder of CAN frames into physical values by the plans of a database, for any database at run
// time. The hot path uses the generated structs instead.
//   in      the message definition and a frame
//   out     one value per signal, in the order of the definition; NaN for a signal that its
//           selector excludes, and for a floating-point signal whose bits are NaN
//   errors  false, values unchanged: another id, another length, a remote frame, another format; a
//           message longer than any frame
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "protocol/can/database.hpp"

namespace pitwall::can {

bool is_frame_of(const Message& message, const Frame& frame);

// `values` must have message.signals.size() entries. Allocates nothing.
[[nodiscard]] bool decode(const Message& message, const Frame& frame, std::span<double> values);

// One signal, even if its selector excludes it; the frame must be one of the signal's message.
double decode(const Signal& signal, const Frame& frame);

bool is_present(const Message& message, const Signal& signal, const Frame& frame);

}  // namespace pitwall::can
