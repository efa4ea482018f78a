// What a radio link does to datagrams: see link_emulator.hpp.
//   units  bytes per second, Duration, probabilities 0 .. 1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

// Two-state loss (Gilbert-Elliott): exponential times in each state.
struct Fades {
  Duration mean_good{}, mean_bad{};  // mean_bad zero: no fades
  double loss_good = 0.0, loss_bad = 1.0;
};

// Nothing passes from `from` for `length`, again each `every` (zero: once).
struct Blackout {
  Instant from{};
  Duration length{}, every{};
};

// One direction of one link.
struct LinkParams {
  double rate_bytes_per_s = 0.0;     // of the air, IP and UDP overhead counted; 0: without limit
  std::size_t queue_bytes = 16'384;  // before it; what does not fit is dropped
  Duration delay{}, jitter{};        // jitter: uniform, 0 .. jitter; keeps the order
  Fades fades;
  double loss = 0.0, duplicate = 0.0, corrupt = 0.0;  // of each datagram, independent
  double reorder = 0.0;                               // of each datagram: held back by
  Duration reorder_by{};                              // so long
  std::vector<Blackout> blackouts;
};

// Presets: mean loss and mean fade.
LinkParams bursty(double loss, Duration mean_fade, double rate_bytes_per_s, Duration delay);

}  // namespace pitwall::link
