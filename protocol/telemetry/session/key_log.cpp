// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/key_log.hpp"

#include <array>
#include <cstdio>

#include "protocol/telemetry/session/traffic.hpp"

namespace pitwall::telemetry {

std::string key_log_lines(std::uint16_t receiver, const Key& first) {
  std::string text;
  Key key = first;
  for (int phase = 0; phase <= kMaxSilentPhases; ++phase) {
    std::array<char, 40> head{};
    std::snprintf(head.data(), head.size(), "CHACHA20_POLY1305 %04x %d ", unsigned{receiver},
                  phase);
    text += head.data();
    text += text_of(key.bytes) + "\n";
    key = next_phase(key);
  }
  return text;
}

}  // namespace pitwall::telemetry
