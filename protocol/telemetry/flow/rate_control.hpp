// Rate control of a path: the share of its budget that the path carries at present, from the
// gradient of its one-way delay. A growing queue is congestion; loss alone is a fade and changes
// nothing.
//   in     deliveries: times when a packet was sent (our clock) and received (the peer's clock, any
//          offset), and the bytes that arrived since the delivery before, its own included
//   out    factor of the budget, (0, 1]
//   invariants
//          overuse is a queue of at least kLeastQueue whose delay grows faster than kOveruse and
//          than its noise explains, by a straight line through the last half second (and at least
//          eight deliveries). The rate is then set to 0.85 of the rate that arrived, fades left
//          out. Otherwise it rises by 5 % of the budget per second unless a queue stands. It never
//          falls below the floor that safety needs. Without deliveries nothing changes
//   source trendline filter of Google congestion control (draft-ietf-rmcat-gcc-02, 5.3 to 5.5), its
//          delay part only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class RateControl {
 public:
  static constexpr Duration kLeastQueue = milliseconds(40);  // two slots
  static constexpr double kOveruse = 0.05;                   // seconds of queue per second

  RateControl(double budget_bytes_per_s, double floor_bytes_per_s);

  void delivered(Instant sent, Instant received_by_peer, std::size_t bytes, Instant now);
  double factor() const { return factor_; }
  Duration queue_delay() const;  // delay above the minimum of the last 5 to 10 s
  std::uint64_t backoffs() const { return backoffs_; }

 private:
  static constexpr std::size_t kWindow = 64;

  struct Point {
    double at_s = 0.0, delay_s = 0.0;
    double bytes = 0.0;
  };
  struct Line {
    double slope = 0.0, standard_error = 0.0;
  };

  void forget_old(double at_s);
  Line line() const;
  double arrived_rate() const;
  void note_least(double at_s, double delay_s);

  double budget_, floor_;
  double factor_ = 1.0;
  std::array<Point, kWindow> points_{};  // ring
  std::size_t first_ = 0, count_ = 0;
  bool started_ = false;
  Instant origin_sent_{}, origin_received_{};
  Instant changed_{};  // last change of the factor
  double hold_until_s_ = 0.0;
  std::array<double, 2> least_s_{};  // minima of the current interval and of the one before
  double interval_start_s_ = 0.0;
  double smoothed_s_ = 0.0;
  std::uint64_t backoffs_ = 0;
};

}  // namespace pitwall::telemetry
