// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/lap_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace pitwall::laps {
namespace {

using grading::kBrackets;

constexpr const char* kWhere = "%-6.6s %-22s ";

template <class... Args>
std::string format(const char* pattern, Args... args) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), pattern, args...);
  return text.data();
}

std::string cell(double value, const char* pattern = "%6.3f ") {
  return std::isfinite(value) ? format(pattern, value) : "     - ";
}

std::string head() {
  std::string out = format(kWhere, "track", "perturbation") + "laps fly   mean   peak ";
  for (const grading::Bracket& b : kBrackets)
    out += b.to_mps > 1e6 ? format("%6s ", format(">%.0f", b.from_mps).c_str())
                          : format("%6s ", format("%.0f-%.0f", b.from_mps, b.to_mps).c_str());
  return out + "   all    max  end\n";
}

std::string line_of(const LapRow& r) {
  std::string out = format(kWhere, r.track.c_str(), r.perturbation.c_str()) +
                    format("%4u %3u ", r.laps, r.flying) + cell(r.flying_mean_mps, "%6.2f ") +
                    cell(r.speed_max_mps, "%6.2f ");
  for (const grading::ErrorStatistics& s : r.cross_track.by_bracket) out += cell(s.mean_m());
  return out + cell(r.cross_track.overall.mean_m()) + cell(r.cross_track.overall.max_m) + " " +
         end_of(r) + "\n";
}

std::string paper_line(const char* name, double grading::Bracket::*figure, double all_m) {
  std::string out = format(kWhere, "paper", name) + "  -   -      -      - ";
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
  return format("gate: %s: %s\n", what, held ? "held" : "MISSED");
}

// JSON has no NaN.
std::string number(double value) {
  return std::isfinite(value) ? format("%.9g", value) : std::string("null");
}

std::string text(const std::string& words) {
  std::string out = "\"";
  for (const char c : words) {
    const bool plain = c != '"' && c != '\\' && static_cast<unsigned char>(c) >= 0x20;
    out += plain ? c : ' ';
  }
  return out + "\"";
}

std::string json_of(const LapRow& r) {
  std::string brackets;
  for (std::size_t i = 0; i < kBrackets.size(); ++i) {
    const grading::ErrorStatistics& s = r.cross_track.by_bracket[i];
    brackets += (i == 0 ? "" : ",") + std::string("{\"from_mps\":") +
                number(kBrackets[i].from_mps) + ",\"samples\":" + std::to_string(s.samples) +
                ",\"mean_m\":" + number(s.mean_m()) + ",\"max_m\":" + number(s.max_m) + "}";
  }
  return "{\"track\":" + text(r.track) + ",\"perturbation\":" + text(r.perturbation) +
         ",\"end\":" + text(end_of(r)) +
         ",\"lapped\":" + (r.outcome == Outcome::kLapped ? "true" : "false") +
         ",\"laps\":" + std::to_string(r.laps) + ",\"flying_laps\":" + std::to_string(r.flying) +
         ",\"flying_mean_mps\":" + number(r.flying_mean_mps) +
         ",\"speed_max_mps\":" + number(r.speed_max_mps) +
         ",\"side_slip_max_rad\":" + number(r.slip_max_rad) +
         ",\"cross_track_mean_m\":" + number(r.cross_track.overall.mean_m()) +
         ",\"cross_track_max_m\":" + number(r.cross_track.overall.max_m) + ",\"brackets\":[" +
         brackets + "],\"left_at_s\":" + number(r.at_s) +
         ",\"left_station_m\":" + number(r.station_m) +
         ",\"left_speed_mps\":" + number(r.speed_mps) + "}";
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
      format(" at s = %.0f m at %.1f m/s, %.1f s", row.station_m, row.speed_mps, row.at_s);
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
    std::string out = "[";
    for (const grading::Bracket& b : kBrackets) out += number(b.*figure) + ",";
    return out + number(all_m) + "]";
  };
  std::string out = "{\"bench\":\"laps\",\"simulation\":true,\"rows\":[";
  for (std::size_t i = 0; i < rows.size(); ++i) out += (i == 0 ? "" : ",") + json_of(rows[i]);
  return out + "],\"paper_brackets_then_all_m\":{\"note\":\"a real car on a real track\"" +
         ",\"mean\":" + paper(&grading::Bracket::paper_mean_m, grading::kPaperMeanOverall_m) +
         ",\"best\":" + paper(&grading::Bracket::paper_best_m, grading::kPaperBestOverall_m) +
         "},\"held\":" + (gates_of(rows).held() ? "true" : "false") + "}\n";
}

}  // namespace pitwall::laps
