// Statistics of one direction of the link, per path: loss, bursts of loss, one-way delay, rate; and
// loss by track position.
//   in     sequence numbers as they arrive (64 bit, with the paths each was sent on), delays,
//          station of the car
//   out    figures of the last seconds and of the run; two-state loss model fitted to the bursts;
//          loss by track position
//   invariants
//          a duplicate, a late packet or one that arrives on the other path is never loss. A number
//          counts as lost once 1024 newer ones or one second have passed without it. If it arrives
//          after that, the loss is taken back and it counts as late
//          a number that arrived on no path counts as sent on the paths of the next number that
//          arrived
//   source Gilbert (1960) for the loss model: mean burst = 1 / P(bad to good); see loss_model.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/telemetry/flow/loss_model.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::telemetry {

struct PathFigures {
  std::uint64_t received = 0, lost = 0, duplicates = 0, late = 0;
  double loss = 0.0;  // of the last 5 s, 0 .. 1
  double rate_bytes_per_s = 0.0;
  Duration delay_p50{}, delay_p95{}, delay_p99{}, jitter{};
  Duration mean_good{}, mean_bad{};  // of the fitted model; zero until the first burst
};

inline constexpr std::size_t kTrackBins = 64;

class LinkStats {
 public:
  // `paths_mask` zero: that of the copy received before.
  void received(std::uint64_t sequence, std::uint8_t paths_mask, PathId path, std::size_t bytes,
                Instant at);
  void delay(PathId path, Duration one_way, Instant at);
  void place(double station_m, double lap_length_m, Instant at);
  void advance(Instant now);

  PathFigures figures(PathId path, Instant now) const;
  double both_lost() const;  // fraction of the packets sent on both paths that arrived on neither
  // Fraction of the numbers that arrived on no path while the car was in this bin of the lap; unset
  // if it never was there.
  double loss_at(std::size_t bin) const;
  // Starts the numbers again; open numbers count neither as lost nor as received.
  void new_session();

 private:
  static constexpr std::size_t kOpen = 1'024;  // numbers that are kept
  static constexpr std::size_t kTenths = 50;   // intervals of 100 ms in the figures of the last 5 s
  static constexpr std::size_t kDelays = 256;  // about 5 s of 50 packets per second
  static constexpr std::size_t kPlaces = 64;

  struct Number {
    std::uint64_t sequence = 0;
    Instant about{};   // time of arrival; of a missing one, as its neighbours suggest
    Instant missed{};  // time when a newer one arrived
    std::uint8_t sent_on = 0, came_by = 0;
    bool judged = false;
  };
  struct Tenth {
    std::int64_t index = -1;
    std::uint32_t expected = 0, lost = 0;
    std::uint64_t bytes = 0;
  };
  struct PathState {
    std::uint64_t received = 0, lost = 0, duplicates = 0, late = 0;
    std::array<Tenth, kTenths> tenths{};
    std::array<Duration, kDelays> delays{};
    std::size_t delay_count = 0;
    double jitter_s = 0.0;
    LossModel model;
  };
  struct Place {
    Instant at{};
    double station_m = 0.0;
  };

  Number& number(std::uint64_t sequence) { return open_[sequence % kOpen]; }
  void open_up_to(std::uint64_t sequence, std::uint8_t paths_mask, Instant at);
  void skip(std::uint64_t count, std::uint8_t paths_mask, Instant at);
  void arrived(Number& number, PathId path, std::size_t bytes, Instant at);
  void take_back(Number& number, PathId path);
  void judge(Number& number);
  static Tenth& tenth(PathState& state, Instant at);
  static void note_delays(const PathState& state, PathFigures& figures);
  double station_at(Instant at) const;
  std::size_t bin_at(Instant at) const;

  std::array<Number, kOpen> open_{};
  std::uint64_t newest_ = 0, next_judged_ = 0;  // 0: no session yet
  Instant newest_at_{};
  double spacing_s_ = 0.0;  // sum and number of the times between numbers
  std::uint64_t spacings_ = 0;
  std::array<PathState, kPaths> path_states_{};
  std::uint64_t sent_on_both_ = 0, lost_on_both_ = 0;
  std::array<Place, kPlaces> places_{};
  std::uint64_t place_count_ = 0;
  double lap_length_m_ = 0.0;
  std::array<std::uint64_t, kTrackBins> expected_{}, missed_{};
};

}  // namespace pitwall::telemetry
