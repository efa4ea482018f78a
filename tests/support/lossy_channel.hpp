// Lossy channel between two ends of a test: it loses, duplicates, delays and reorders what is sent,
// by a seed.
//   units  virtual time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::testing {

struct LossyChannelParams {
  double loss = 0.0, twice = 0.0;
  Duration delay_min = milliseconds(15), delay_max = milliseconds(15);
  std::uint32_t seed = 1;
};

class LossyChannel {
 public:
  explicit LossyChannel(const LossyChannelParams& params) : params_(params), random_(params.seed) {}

  void send(std::span<const std::uint8_t> bytes, Instant now) {
    sent_bytes_ += bytes.size();
    const int copies = chance(params_.twice) ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      if (chance(params_.loss)) continue;
      const Duration delay = params_.delay_min + (params_.delay_max - params_.delay_min) *
                                                     static_cast<std::int64_t>(random_() % 1'001) /
                                                     1'000;
      flying_.push_back({now + delay, now, {bytes.begin(), bytes.end()}});
    }
  }
  // Calls take(bytes, sent, arrived) for each packet that has arrived, in order of arrival.
  template <class Take>
  void arrive(Instant now, Take&& take) {
    std::ranges::stable_sort(flying_, {}, &Flight::arrives);
    while (!flying_.empty() && flying_.front().arrives <= now) {
      const Flight flight = std::move(flying_.front());
      flying_.erase(flying_.begin());
      take(flight.bytes, flight.sent, flight.arrives);
    }
  }
  void forget() { flying_.clear(); }
  std::size_t sent_bytes() const { return sent_bytes_; }

 private:
  struct Flight {
    Instant arrives, sent;
    std::vector<std::uint8_t> bytes;
  };
  bool chance(double p) { return static_cast<double>(random_() % 1'000'000) < p * 1e6; }

  LossyChannelParams params_;
  std::mt19937 random_;
  std::vector<Flight> flying_;
  std::size_t sent_bytes_ = 0;
};

}  // namespace pitwall::testing
