// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/cross_track.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::grading {
namespace {

void add_one(ErrorStatistics& s, double error_m) {
  ++s.samples;
  s.sum_m += error_m;
  s.max_m = std::max(s.max_m, error_m);
}

std::string row(const std::string& name, const ErrorStatistics& s, double best_m, double mean_m) {
  if (s.samples == 0)
    return formatted("%-8s %9s %8s %8s %11.3f %11.3f\n", name.c_str(), "0", "-", "-", best_m,
                     mean_m);
  return formatted("%-8s %9llu %8.3f %8.3f %11.3f %11.3f\n", name.c_str(),
                   static_cast<unsigned long long>(s.samples), s.mean_m(), s.max_m, best_m, mean_m);
}

std::string name_of(const Bracket& b) {
  return b.to_mps > 1e6 ? formatted(">%.0f", b.from_mps)
                        : formatted("%.0f-%.0f", b.from_mps, b.to_mps);
}

}  // namespace

void add(CrossTrack& statistics, double speed_mps, double cross_track_m,
         std::uint32_t laps_finished) {
  if (!std::isfinite(speed_mps) || !std::isfinite(cross_track_m)) {
    ++statistics.undefined;
    return;
  }
  for (std::size_t i = 0; i < kBrackets.size(); ++i) {
    if (speed_mps < kBrackets[i].from_mps) continue;
    add_one(statistics.by_bracket[i], std::abs(cross_track_m));
    add_one(statistics.overall, std::abs(cross_track_m));
    if (statistics.by_lap.size() <= laps_finished) statistics.by_lap.resize(laps_finished + 1);
    add_one(statistics.by_lap[laps_finished], std::abs(cross_track_m));
    return;
  }
  ++statistics.slow;
}

std::string to_table(const CrossTrack& statistics) {
  std::string table = formatted("%-8s %9s %8s %8s %11s %11s\n", "m/s", "samples", "mean_m", "max_m",
                                "paper_best", "paper_mean");
  for (std::size_t i = 0; i < kBrackets.size(); ++i)
    table += row(name_of(kBrackets[i]), statistics.by_bracket[i], kBrackets[i].paper_best_m,
                 kBrackets[i].paper_mean_m);
  table += row("all >10", statistics.overall, kPaperBestOverall_m, kPaperMeanOverall_m);
  if (statistics.by_lap.size() < 2) return table;
  table += "by lap, mean and max:";
  for (const ErrorStatistics& lap : statistics.by_lap)
    table += formatted(" %.3f %.3f;", lap.mean_m(), lap.max_m);
  table.back() = '\n';
  return table;
}

}  // namespace pitwall::grading
