// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_report.hpp"

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::raceline {
namespace {

std::string extreme_json(const Extreme& extreme) {
  return json::Object{}.number("value", extreme.value).number("s_m", extreme.s_m).str();
}

std::string lap_text(const LapFigures& lap) {
  return formatted("  %8.3f  %8.2f  %6.0f  %6.2f  %6.0f", lap.lap_s, lap.speed_least.value,
                   lap.speed_least.s_m, lap.speed_most.value, lap.speed_most.s_m);
}

std::string figures_json(const LineFigures& f) {
  json::Object line;
  line.text("name", f.name)
      .number("length_m", f.length_m)
      .number("points", f.points)
      .json("room_least_m", extreme_json(f.room_least))
      .json("curvature_most_per_m", extreme_json(f.curvature_most))
      .json("steer_rate_most_rad_per_s", extreme_json(f.steer_rate_most))
      .json("speed_least_mps", extreme_json(f.speed_least))
      .json("mismatch_most_per_m", extreme_json(f.mismatch_most));
  if (f.lap)
    line.number("lap_s", f.lap->lap_s)
        .json("lap_speed_least_mps", extreme_json(f.lap->speed_least))
        .json("lap_speed_most_mps", extreme_json(f.lap->speed_most))
        .json("lap_lateral_use_most", extreme_json(f.lap->lateral_use_most));
  return line.str();
}

}  // namespace

std::string report_text(const RacelineBank& bank, std::span<const LineFigures> figures) {
  std::string out = formatted("track      %s, fingerprint %s\n", bank.track.c_str(),
                              bank.track_fingerprint.c_str()) +
                    "line                     length m   room m  at s m  radius m  at s m  "
                    "steering rad/s  at s m     lap s  from m/s  at s m  to m/s  at s m\n";
  for (const LineFigures& f : figures) {
    out += formatted("%-23s  %8.1f  %7.2f  %6.0f  %8.1f  %6.0f  %14.4f  %6.0f", f.name.c_str(),
                     f.length_m, f.room_least.value, f.room_least.s_m, 1.0 / f.curvature_most.value,
                     f.curvature_most.s_m, f.steer_rate_most.value, f.steer_rate_most.s_m);
    out += (f.lap ? lap_text(*f.lap) : "") + "\n";
  }
  return out;
}

std::string report_json(const RacelineBank& bank, std::span<const LineFigures> figures) {
  json::Array lines;
  for (const LineFigures& f : figures) lines.json(figures_json(f));
  return json::Object{}
             .text("track", bank.track)
             .text("track_fingerprint", bank.track_fingerprint)
             .json("lines", lines.str())
             .str() +
         "\n";
}

}  // namespace pitwall::raceline
