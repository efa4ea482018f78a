// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/station.hpp"

namespace pitwall::intake {

bool Station::take(std::span<const std::uint8_t> datagram, Instant received) {
  const auto packet = intake_.feed(datagram, received);
  if (!packet) return false;
  link_.note(*packet, received);
  uplink_.heard(*packet, received);
  picture_.update(*packet, received);
  return true;
}

}  // namespace pitwall::intake
