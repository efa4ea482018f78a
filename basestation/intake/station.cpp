// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/station.hpp"

namespace pitwall::intake {

void Station::take(std::span<const std::uint8_t> datagram, Instant received) {
  const auto packet = intake_.feed(datagram, received);
  if (!packet) return;
  link_.note(*packet, received);
  picture_.update(*packet, received);
}

}  // namespace pitwall::intake
