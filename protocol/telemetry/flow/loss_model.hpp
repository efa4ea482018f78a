// Two-state (Gilbert) model of packet loss, fitted to a series of received and lost packets: in the
// bad state all packets are lost, in the good state single packets at random, with probability g.
//   in     outcomes in order of sending, and the mean time between two packets
//   out    mean time in the good and in the bad state
//   invariants
//          losses in the good state are uncorrelated, so the covariance of losses k packets apart
//          is  C_k = good bad (1 - g)^2 r^k  with the share of each state and the decay r per
//          packet of the two-state chain; the share that arrives is came = good (1 - g). Hence
//          bad / good = C_0' / came^2 with C_0' = C_1 / r, and 1 / (1 - r) packets is
//          T_good T_bad / (T_good + T_bad)
//   cost   a few integer additions per packet; no memory of the packets beyond the last kLag
//   source E. N. Gilbert, "Capacity of a Burst-Noise Channel", 1960, section 6 (fit by moments of
//          the observed series)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class LossModel {
 public:
  static constexpr unsigned kLag = 4;  // C_1 and C_kLag give the decay

  void note(bool lost);
  void note_lost(std::uint64_t count);  // `count` packets in a row

  struct Fit {
    Duration mean_good{}, mean_bad{};
  };
  // An empty optional until there are more bursts than random single losses explain.
  std::optional<Fit> fit(Duration between_packets) const;

 private:
  double covariance(unsigned lag) const;

  std::uint64_t packets_ = 0, lost_ = 0;
  std::array<std::uint64_t, kLag + 1> both_lost_{};  // element k: lost pairs k packets apart
  std::uint32_t last_ = 0;                           // bit k: the packet k + 1 before was lost
};

}  // namespace pitwall::telemetry
