// How a path was, one direction: loss, bursts of loss, one-way delay, rate; and where on the track.
//   in     sequence numbers as they arrive (64 bit, with the paths each was sent on), delays,
//          station of the car
//   out    figures of the last second and of the run; two-state loss model fitted to the bursts;
//          loss by track position
//   law    a duplicate, a packet that comes late or by the other path is never loss; a number
//          counts as lost when 1024 newer ones have come, or one second has passed, without it
//   source Gilbert (1960) for the loss model: mean burst = 1 / P(bad to good)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::telemetry {

struct PathFigures {
  std::uint64_t received = 0, lost = 0, duplicates = 0, late = 0;
  double loss = 0.0;  // of the last 5 s, 0 .. 1
  double rate_bytes_per_s = 0.0;
  Duration delay_p50{}, delay_p95{}, delay_p99{}, jitter{};
  Duration mean_good{}, mean_bad{};  // of the fitted model; zero until there was a burst
};

inline constexpr std::size_t kTrackBins = 64;

class LinkStats {
 public:
  void received(std::uint64_t sequence, std::uint8_t paths_mask, PathId path, std::size_t bytes,
                Instant at);
  void delay(PathId path, Duration one_way, Instant at);
  void place(double station_m, double lap_length_m, Instant at);
  void advance(Instant now);

  PathFigures figures(PathId path, Instant now) const;
  double both_lost() const;  // of what was sent on both: fraction that came by neither
  // Loss where the car was in this bin of the lap; unset where it never was.
  double loss_at(std::size_t bin) const;
  void new_session() {}

 private:
  std::array<std::uint64_t, kTrackBins> expected_{}, missed_{};
};

}  // namespace pitwall::telemetry
