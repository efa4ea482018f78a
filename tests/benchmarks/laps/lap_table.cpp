// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/lap_table.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/laps/bracket_text.hpp"

namespace pitwall::laps {
namespace {

using grading::kBrackets;

constexpr const char* kWhere = "%-6.6s %-22s ";

std::string cell(double value, const char* pattern = "%6.3f ") {
  return std::isfinite(value) ? formatted(pattern, value) : "     - ";
}

std::string head() {
  std::string out = formatted(kWhere, "track", "perturbation") + "laps fly   mean   peak ";
  for (const grading::Bracket& b : kBrackets) out += formatted("%6s ", bracket_name(b).c_str());
  return out + "   all    max  end\n";
}

std::string line_of(const LapRow& r) {
  std::string out = formatted(kWhere, r.track.c_str(), r.perturbation.c_str()) +
                    formatted("%4u %3u ", r.laps, r.flying) + cell(r.flying_mean_mps, "%6.2f ") +
                    cell(r.speed_max_mps, "%6.2f ");
  for (const grading::ErrorStatistics& s : r.cross_track.by_bracket) out += cell(s.mean_m());
  return out + cell(r.cross_track.overall.mean_m()) + cell(r.cross_track.overall.max_m) + " " +
         end_of(r) + "\n";
}

std::string paper_line(const char* name, double grading::Bracket::*figure, double all_m) {
  std::string out = formatted(kWhere, "paper", name) + "  -   -      -      - ";
  for (const grading::Bracket& b : kBrackets) out += cell(b.*figure);
  return out + cell(all_m) + "     -  a real car on a real track: not a claim\n";
}

const LapRow* nominal_of(const std::vector<LapRow>& rows, const std::string& track) {
  const auto found = std::ranges::find_if(
      rows, [&track](const LapRow& r) { return r.track == track && r.perturbation == kNominal; });
  return found == rows.end() ? nullptr : &*found;
}

bool reached(const std::vector<LapRow>& rows, const LapRow& row) {
  const LapRow* nominal = nominal_of(rows, row.track);
  return row.perturbation == kNominal || nominal == nullptr || !same_run(row, *nominal);
}

std::string gate(const char* what, bool held) {
  return formatted("gate: %s: %s\n", what, held ? "held" : "MISSED");
}

std::string json_of(const LapRow& r) {
  return json::Object{}
      .text("track", r.track)
      .text("perturbation", r.perturbation)
      .text("end", end_of(r))
      .flag("lapped", r.outcome == Outcome::kLapped)
      .number("laps", r.laps)
      .number("flying_laps", r.flying)
      .number("flying_mean_mps", r.flying_mean_mps)
      .number("speed_max_mps", r.speed_max_mps)
      .number("side_slip_max_rad", r.slip_max_rad)
      .number("cross_track_mean_m", r.cross_track.overall.mean_m())
      .number("cross_track_max_m", r.cross_track.overall.max_m)
      .json("brackets", brackets_json(r.cross_track))
      .number("left_at_s", r.at_s)
      .number("left_station_m", r.station_m)
      .number("left_speed_mps", r.speed_mps)
      .str();
}

}  // namespace

Gates gates_of(const std::vector<LapRow>& rows) {
  Gates gates;
  for (const LapRow& row : rows) {
    if (row.perturbation == kNominal && row.outcome != Outcome::kLapped) gates.nominal_laps = false;
    if (row.outcome == Outcome::kUnfinished) gates.every_verdict = false;
    if (!reached(rows, row)) gates.every_perturbation = false;
  }
  return gates;
}

std::string end_of(const LapRow& row) {
  const std::string where =
      formatted(" at s = %.0f m at %.1f m/s, %.1f s", row.station_m, row.speed_mps, row.at_s);
  switch (row.outcome) {
    case Outcome::kLapped:
      return "lapped";
    case Outcome::kContact:
      return "LEFT THE TRACK: wall" + where;
    case Outcome::kStopped:
      return "stopped by its supervisor (" + row.cause + ")" + where;
    case Outcome::kUnfinished:
      break;
  }
  return "UNFINISHED";
}

std::string to_text(const std::vector<LapRow>& rows) {
  std::string out =
      "SIMULATION, lockstep. Mean cross-track error by speed bracket (m/s), m; mean and peak "
      "speed, "
      "m/s.\n" +
      head();
  for (const LapRow& row : rows) {
    out += line_of(row);
    if (!reached(rows, row)) out += "       ^ the same run as nominal: it was not applied\n";
  }
  out += paper_line("mean of three runs", &grading::Bracket::paper_mean_m,
                    grading::kPaperMeanOverall_m);
  out += paper_line("best run", &grading::Bracket::paper_best_m, grading::kPaperBestOverall_m);
  const Gates gates = gates_of(rows);
  return out + gate("every nominal run laps its track without contact", gates.nominal_laps) +
         gate("every run ended lapped or at a stated place", gates.every_verdict) +
         gate("every perturbation reached the model", gates.every_perturbation);
}

std::string to_json(const std::vector<LapRow>& rows) {
  const auto paper = [](double grading::Bracket::*figure, double all_m) {
    json::Array out;
    for (const grading::Bracket& b : kBrackets) out.number(b.*figure);
    return out.number(all_m).str();
  };
  json::Array listed;
  for (const LapRow& row : rows) listed.json(json_of(row));
  json::Object published;
  published.text("note", "a real car on a real track")
      .json("mean", paper(&grading::Bracket::paper_mean_m, grading::kPaperMeanOverall_m))
      .json("best", paper(&grading::Bracket::paper_best_m, grading::kPaperBestOverall_m));
  return json::Object{}
             .text("bench", "laps")
             .flag("simulation", true)
             .json("rows", listed.str())
             .json("paper_brackets_then_all_m", published.str())
             .flag("held", gates_of(rows).held())
             .str() +
         "\n";
}

}  // namespace pitwall::laps
