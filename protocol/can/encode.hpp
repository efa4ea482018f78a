// Physical values to a frame, for generated structs and for run-time databases.
//   in      one value per signal in DBC units
//   out     a frame whose unused bits are zero
//   rule    rounded half away from zero, then held inside the field and the file's range (if it
//           gives one); a value never wraps into another sign
//   errors  false, frame untouched: a value of a present signal is NaN or infinite; the message is
//           longer than a frame
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "protocol/can/database.hpp"

namespace pitwall::can {

struct EncodeCounters {
  std::uint64_t saturated = 0;   // signals held at a limit
  std::uint64_t not_finite = 0;  // frames refused for a NaN or an infinity
  std::uint64_t too_long = 0;    // messages refused because no frame holds them
  bool operator==(const EncodeCounters&) const = default;
};

// `values` must have message.signals.size() entries; those of signals that their selector leaves
// out are not looked at. Allocates nothing.
[[nodiscard]] bool encode(const Message& message, std::span<const double> values, Frame& out,
                          EncodeCounters& counters);

// For generated code: the bits of one finite value, counting a saturation.
inline std::uint64_t encode_signal(double physical, const SignalPlan& p, EncodeCounters& counters) {
  bool saturated = false;
  const std::uint64_t raw = raw_of(physical, p, saturated);
  counters.saturated += saturated ? 1U : 0U;
  return raw;
}

}  // namespace pitwall::can
