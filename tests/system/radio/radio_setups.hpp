// Links and budgets for the radio tests.
//   units  bytes per second, Duration
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

inline constexpr double kRate = 32'000.0;  // 256 kbit/s
inline constexpr Duration kWay = milliseconds(15);

inline link::LinkParams clean_link(double rate_bytes_per_s = kRate) {
  link::LinkParams link;
  link.rate_bytes_per_s = rate_bytes_per_s;
  link.delay = kWay;
  return link;
}

// The same link for all paths and directions.
inline RadioSetup setup_of(const link::LinkParams& link, std::uint8_t paths = 1) {
  RadioSetup setup;
  setup.down.fill(link);
  setup.up.fill(link);
  setup.paths = paths;
  return setup;
}

inline RadioSetup lossy(double loss, std::uint64_t seed, std::uint8_t paths = 1) {
  link::LinkParams link = clean_link();
  link.loss = loss;
  RadioSetup setup = setup_of(link, paths);
  setup.seed = seed;
  return setup;
}

inline RadioSetup fading(double loss, Duration fade, std::uint64_t seed, std::uint8_t paths = 1) {
  RadioSetup setup = setup_of(link::bursty(loss, fade, kRate, kWay), paths);
  setup.seed = seed;
  return setup;
}

}  // namespace pitwall::radio
