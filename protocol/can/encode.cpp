// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/encode.hpp"

#include <cmath>

#include "protocol/can/decode.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::can {

bool encode(const Message& message, std::span<const double> values, Frame& out,
            EncodeCounters& counters) {
  CHECK(values.size() == message.signals.size());
  if (!message.is_on_frame()) {
    ++counters.too_long;
    return false;
  }
  Frame frame{.id = message.id,
              .extended = message.extended,
              .remote = false,
              .fd = message.fd,
              .length = static_cast<std::uint8_t>(message.length),
              .data = {}};
  std::uint64_t held = 0;
  // Selectors first: they decide which of the others are present.
  for (unsigned depth = 0; depth <= message.deepest; ++depth) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Signal& s = message.signals[i];
      if (s.depth != depth || (depth > 0 && !is_present(message, s, frame))) continue;
      if (!std::isfinite(values[i])) {
        ++counters.not_finite;
        return false;
      }
      bool saturated = false;
      insert(s.plan, frame.data, raw_of(values[i], s.plan, saturated));
      held += saturated ? 1U : 0U;
    }
  }
  counters.saturated += held;
  out = frame;
  return true;
}

}  // namespace pitwall::can
