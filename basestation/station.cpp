// SPDX-License-Identifier: Apache-2.0
#include "basestation/station.hpp"

#include "basestation/outlets/summary.hpp"
#include "basestation/outlets/text_view.hpp"

namespace pitwall::basestation {

void Station::take(std::span<const std::uint8_t> datagram, Instant received) {
  const auto packet = intake_.feed(datagram, received);
  if (!packet) return;
  link_.note(*packet, received);
  picture_.update(*packet, received);
}

std::string Station::screen(Instant now, bool ansi) {
  link_.advance(now);
  return outlets::text_view(picture_, intake_.counters(), link_, now, {.ansi = ansi});
}

std::string Station::summary(Instant now) {
  link_.advance(now);
  return outlets::json_summary(picture_, intake_.counters(), link_, now);
}

}  // namespace pitwall::basestation
