// Arrival statistics of a stream of samples: rate, largest gap and largest latency of the last
// second. A low rate, a gap and an old sample are three different faults.
//   in     note(): when a sample arrived and how old it was, by the thread that receives
//   out    newest(): figures at any time, by any other thread
//   units  Hz, ms
//   invariants
//          silence is seen although nothing arrives: the gap grows, after a second the rate is 0
//   unset  all three before the first sample; the latency of samples whose stamp is no time of ours
//   cost   note(): a look at the arrivals of a second; newest(): four atomic loads
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::io {

struct ArrivalFigures {
  double rate_hz = kUnset, gap_ms = kUnset, latency_ms = kUnset;
};

class Arrivals {
 public:
  static constexpr Duration kWindow = seconds(1);
  static constexpr std::size_t kKept = 512;  // of a faster stream the window is shorter

  void note(Instant at, std::optional<Duration> latency);
  ArrivalFigures newest(Instant now) const;
  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  struct Arrival {
    Instant at{};
    Duration gap{};  // to the one before
    double latency_ms = kUnset;
  };

  std::array<Arrival, kKept> ring_{};  // the receiving thread's own
  std::uint64_t noted_ = 0;
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> last_ns_{0};
  std::atomic<double> rate_hz_{kUnset}, gap_ms_{kUnset}, latency_ms_{kUnset};
};

}  // namespace pitwall::io
