// Parameters of the radio link emulator, link_emulator.hpp.
//   units  bytes per second, Duration, metres, probabilities 0 .. 1; times count from the start of
//          the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/telemetry/packet/header.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

// Two-state loss (Gilbert-Elliott): exponential times in each state.
struct Fades {
  Duration mean_good{}, mean_bad{};  // mean_bad zero: no fades
  double loss_good = 0.0, loss_bad = 1.0;

  constexpr double share_bad() const {
    const double cycle_s = mean_good.seconds() + mean_bad.seconds();
    return cycle_s > 0.0 ? mean_bad.seconds() / cycle_s : 0.0;
  }
  constexpr double mean_loss() const {
    return share_bad() * loss_bad + (1.0 - share_bad()) * loss_good;
  }
};

// Nothing passes from `from` for `length`, repeated every `every` (zero: once).
struct Blackout {
  Instant from{};
  Duration length{}, every{};
};

// From a recording: this share of the datagrams sent in [from, to) is lost.
struct Outage {
  Instant from{}, to{};
  double loss = 1.0;
};

// From a recording: loss around this station, up to half way to the next ones.
struct StationLoss {
  double station_m = 0.0;
  double loss = 0.0;
};

// A recorded link: outages in order of time, and loss by ascending station.
struct LinkTrace {
  std::vector<Outage> outages;
  Duration repeat{};  // period of repetition of the outages; zero: once
  std::vector<StationLoss> by_station;
  double lap_length_m = 0.0;
};

// One direction of one link.
struct LinkParams {
  double rate_bytes_per_s = 0.0;  // of the radio, with IP and UDP overhead; 0: unlimited
  std::size_t overhead_bytes = telemetry::kIpUdpOverhead;  // 0 if whole IP packets are offered
  std::size_t queue_bytes = 16'384;  // queue before it; what does not fit is dropped
  Duration delay{}, jitter{};        // jitter: uniform, 0 .. jitter; keeps the order
  Fades fades;
  double loss = 0.0, duplicate = 0.0, corrupt = 0.0;  // per datagram, independent
  double reorder = 0.0;                               // per datagram: delayed by reorder_by
  Duration reorder_by{};
  std::vector<Blackout> blackouts;
  LinkTrace trace;
};

// Preset by mean loss and mean duration of a fade.
LinkParams bursty(double loss, Duration mean_fade, double rate_bytes_per_s, Duration delay);

}  // namespace pitwall::link
