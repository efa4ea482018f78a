// Arrival statistics of a stream of samples: rate, largest gap and largest latency in the last
// second. A low rate, a gap and an old sample are three different faults.
//   in     note(): time of arrival and age of a sample, by the receiving thread
//   out    newest(): the figures at any time, by any other thread
//   units  Hz, ms
//   invariants
//          silence shows without new samples: the gap grows, and after a second the rate is 0
//   unset  all three before the first sample; the latency if the stamps of the samples are not in
//          UTC
//   cost   note(): a pass over the arrivals of a second; newest(): four atomic loads
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::io {

struct ArrivalFigures {
  double rate_hz = kUnset, gap_ms = kUnset, latency_ms = kUnset;
};

// Rounded to a thousandth; left out where it is not known.
void add_figure(json::Object& out, const char* name, double value);
void add_figures(json::Object& out, const ArrivalFigures& figures);

class Arrivals {
 public:
  static constexpr Duration kWindow = seconds(1);
  static constexpr std::size_t kKept = 512;  // a faster stream has a shorter window

  void note(Instant at, std::optional<Duration> latency);
  ArrivalFigures newest(Instant now) const;
  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  struct Arrival {
    Instant at{};
    Duration gap{};  // to the previous arrival
    double latency_ms = kUnset;
  };

  std::array<Arrival, kKept> ring_{};  // of the receiving thread
  std::uint64_t noted_ = 0;
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> last_ns_{0};
  std::atomic<double> rate_hz_{kUnset}, gap_ms_{kUnset}, latency_ms_{kUnset};
};

// Of a sensor that the car has. Where it sends nothing within kAwaited of the start, its rate is 0.
struct SensorFigures {
  static constexpr Duration kAwaited = seconds(20);

  SensorFigures(const Arrivals& of, std::uint64_t dropped, Instant started, Instant now);

  ArrivalFigures arrivals;
  std::uint64_t drops;  // messages that were not used
};

}  // namespace pitwall::io
