// Statistics of one direction of a path: loss, bursts of loss, one-way delay, rate; and where on
// the track.
//   in     sequence numbers as they arrive (64 bit, with the paths each was sent on), delays,
//          station of the car
//   out    figures of the last seconds and of the run; two-state loss model fitted to the bursts;
//          loss by track position
//   invariants
//          a duplicate, a packet that comes late or by the other path is never loss; a number
//          counts as lost when 1024 newer ones have come, or one second has passed, without it.
//          One that comes after that is taken back and counts as late
//          a number that came by no path is taken to have been sent on the paths of the next that
//          came
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
  Duration mean_good{}, mean_bad{};  // of the fitted model; zero until there was a burst
};

inline constexpr std::size_t kTrackBins = 64;

class LinkStats {
 public:
  // `paths_mask` zero: as of the copy that came before.
  void received(std::uint64_t sequence, std::uint8_t paths_mask, PathId path, std::size_t bytes,
                Instant at);
  void delay(PathId path, Duration one_way, Instant at);
  void place(double station_m, double lap_length_m, Instant at);
  void advance(Instant now);

  PathFigures figures(PathId path, Instant now) const;
  double both_lost() const;  // of what was sent on both: fraction that came by neither
  // Loss where the car was in this bin of the lap: fraction of the numbers that came by no path;
  // unset where it never was.
  double loss_at(std::size_t bin) const;
  // Numbers start anew; what is open is not judged.
  void new_session();

 private:
  static constexpr std::size_t kOpen = 1'024;  // numbers that are kept
  static constexpr std::size_t kTenths = 50;   // of a second, of the figures of the last 5 s
  static constexpr std::size_t kDelays = 256;  // about 5 s of 50 packets per second
  static constexpr std::size_t kPlaces = 64;

  struct Number {
    std::uint64_t sequence = 0;
    Instant about{};   // when it came, or by its neighbours would have
    Instant missed{};  // when a newer one came
    std::uint8_t sent_on = 0, came_by = 0;
    bool judged = false;
  };
  struct Tenth {
    std::int64_t index = -1;
    std::uint32_t expected = 0, lost = 0;
    std::uint64_t bytes = 0;
  };
  struct PathBook {
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
  static Tenth& tenth(PathBook& book, Instant at);
  static void note_delays(const PathBook& book, PathFigures& figures);
  double station_at(Instant at) const;
  std::size_t bin_at(Instant at) const;

  std::array<Number, kOpen> open_{};
  std::uint64_t newest_ = 0, next_judged_ = 0;  // 0: no session yet
  Instant newest_at_{};
  double spacing_s_ = 0.0;  // time between numbers, summed, and how many
  std::uint64_t spacings_ = 0;
  std::array<PathBook, kPaths> books_{};
  std::uint64_t sent_on_both_ = 0, lost_on_both_ = 0;
  std::array<Place, kPlaces> places_{};
  std::uint64_t place_count_ = 0;
  double lap_length_m_ = 0.0;
  std::array<std::uint64_t, kTrackBins> expected_{}, missed_{};
};

}  // namespace pitwall::telemetry
