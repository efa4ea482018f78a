// Encoder of physical values into a CAN frame, for generated structs and for run-time databases.
//   in      one value per signal in DBC units
//   out     a frame whose unused bits are zero
//   rule    rounded half away from zero, then limited to the field and to the range of the file, if
//           it states one; a value never wraps to the other sign
//   errors  false, frame unchanged: a value of a present signal is NaN or infinite; the message is
//           longer than a frame
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "protocol/can/database.hpp"

namespace pitwall::can {

struct EncodeCounters {
  std::uint64_t saturated = 0;   // signals limited to their range
  std::uint64_t not_finite = 0;  // frames refused because of a NaN or an infinity
  std::uint64_t too_long = 0;    // messages refused because they are longer than a frame
  bool operator==(const EncodeCounters&) const = default;
};

// `values` must have message.signals.size() entries; those of signals that their selector excludes
// are not read. Does not allocate.
[[nodiscard]] bool encode(const Message& message, std::span<const double> values, Frame& out,
                          EncodeCounters& counters);

// For generated code: the raw bits of one finite value; counts a saturation.
inline std::uint64_t encode_signal(double physical, const SignalPlan& p, EncodeCounters& counters) {
  bool saturated = false;
  const std::uint64_t raw = raw_of(physical, p, saturated);
  counters.saturated += saturated ? 1U : 0U;
  return raw;
}

}  // namespace pitwall::can
