// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/laps/bracket_text.hpp"
#include "tests/benchmarks/laps/lap_plan.hpp"

namespace pitwall::control_bench {
namespace {

using grading::Bracket;
using grading::ErrorStatistics;
using grading::kBrackets;

constexpr double kFast_mps = 40.0, kSmall_m = 0.05, kHalf = 0.5;
constexpr std::uint64_t kHeldTicks = 5900;  // a minute, less a second at the edges of a bracket

bool is_nominal(const ControlRow& r) { return r.world == laps::kNominal; }

// Of a bound that a figure must not exceed: the figure that comes nearest to it, or is furthest
// above.
class Worst {
 public:
  explicit Worst(std::string name) { gate_.name = std::move(name); }

  void add(const ControlRow& row, std::size_t bracket, double figure_m, double bound_m) {
    if (figure_m <= bound_m * ratio_ && std::isfinite(figure_m)) return;
    ratio_ = std::isfinite(figure_m) ? figure_m / bound_m : HUGE_VAL;
    gate_.held = gate_.held && figure_m <= bound_m;
    gate_.worst = formatted("%.3f of %.3f m: %s %s %s m/s", figure_m, bound_m, row.track.c_str(),
                            row.world.c_str(), laps::bracket_name(kBrackets[bracket]).c_str());
  }
  void early(const ControlRow& row) {
    gate_.held = false, ratio_ = HUGE_VAL;
    gate_.worst = row.track + ' ' + row.world + ": " + row.end;
  }
  const Gate& gate() const { return gate_; }

 private:
  Gate gate_;
  double ratio_ = 0.0;
};

using Visit = std::function<void(const ControlRow&, std::size_t, const ErrorStatistics&)>;

void each_of_ours(const std::vector<ControlRow>& rows, bool nominal, Worst& worst,
                  const Visit& visit) {
  for (const ControlRow& r : rows) {
    if (r.law != kOurs || !r.is_judged || is_nominal(r) != nominal) continue;
    if (r.ended_early()) worst.early(r);
    for (std::size_t i = 0; i < kBrackets.size(); ++i)
      if (r.cross_track.by_bracket[i].samples > 0) visit(r, i, r.cross_track.by_bracket[i]);
  }
}

const ControlRow* paper_beside(const std::vector<ControlRow>& rows, const ControlRow& ours) {
  const auto found = std::ranges::find_if(rows, [&](const ControlRow& r) {
    return r.law == kPaper && r.track == ours.track && r.world == ours.world;
  });
  return found == rows.end() ? nullptr : &*found;
}

Gate held_gate(const std::vector<ControlRow>& rows) {
  Gate gate{"every speed held for a minute (nominal)", "", true};
  for (const ControlRow& r : rows)
    for (std::size_t i = 0; i < kBrackets.size() && is_nominal(r); ++i) {
      const std::uint64_t ticks = r.cross_track.by_bracket[i].samples;
      if (ticks >= kHeldTicks) continue;
      gate.held = false;
      gate.worst =
          formatted("%s %s %s m/s: %.1f s", r.track.c_str(), r.law.c_str(),
                    laps::bracket_name(kBrackets[i]).c_str(), 0.01 * static_cast<double>(ticks));
    }
  return gate;
}

std::string row_text(const ControlRow& r) {
  const auto line = [&r](const char* what, auto figure) {
    std::string out = formatted("%-6.6s %-20.20s %-13s %-5s", r.track.c_str(), r.world.c_str(),
                                r.law.c_str(), what);
    for (const ErrorStatistics& s : r.cross_track.by_bracket)
      out += s.samples == 0 ? "      - " : formatted("%7.3f ", figure(s));
    return out;
  };
  return line("mean", [](const ErrorStatistics& s) { return s.mean_m(); }) + r.end + '\n' +
         line("max", [](const ErrorStatistics& s) { return s.max_m; }) + '\n';
}

std::string row_json(const ControlRow& r) {
  return json::Object{}
      .text("track", r.track)
      .text("world", r.world)
      .text("law", r.law)
      .text("end", r.end)
      .json("brackets", laps::brackets_json(r.cross_track))
      .str();
}

}  // namespace

std::vector<Gate> gates_of(const std::vector<ControlRow>& rows) {
  Worst half{"at most half of the paper's law, or 0.05 m, above 40 m/s (nominal)"},
      nominal_mean{"mean within the goal (nominal)"},
      nominal_max{"maximum within the goal (nominal)"},
      perturbed{"mean within the goal (worst other world)"};
  each_of_ours(rows, true, half, [&](const ControlRow& r, std::size_t i, const ErrorStatistics& s) {
    const ControlRow* paper = paper_beside(rows, r);
    if (paper == nullptr || kBrackets[i].from_mps < kFast_mps) return;
    const double theirs_m = paper->cross_track.by_bracket[i].mean_m();
    half.add(r, i, s.mean_m(),
             std::isfinite(theirs_m) ? std::max(kHalf * theirs_m, kSmall_m) : kSmall_m);
  });
  each_of_ours(rows, true, nominal_mean,
               [&](const ControlRow& r, std::size_t i, const ErrorStatistics& s) {
                 nominal_mean.add(r, i, s.mean_m(), kGoals[i].nominal_mean_m);
                 nominal_max.add(r, i, s.max_m, kGoals[i].max_m);
               });
  each_of_ours(rows, false, perturbed,
               [&](const ControlRow& r, std::size_t i, const ErrorStatistics& s) {
                 perturbed.add(r, i, s.mean_m(), kGoals[i].perturbed_mean_m);
               });
  std::vector<Gate> gates{held_gate(rows), half.gate(), nominal_mean.gate(), nominal_max.gate()};
  if (std::ranges::any_of(rows, [](const ControlRow& r) { return r.is_judged && !is_nominal(r); }))
    gates.push_back(perturbed.gate());
  return gates;
}

bool all_held(const std::vector<Gate>& gates) { return std::ranges::all_of(gates, &Gate::held); }

std::string to_text(const std::vector<ControlRow>& rows) {
  std::string out =
      "SIMULATION, lockstep, estimator in the loop. True cross-track error at held speeds, m, by "
      "bracket (m/s).\n" +
      formatted("%-6s %-20s %-13s %-5s", "track", "world", "law", "");
  for (const Bracket& b : kBrackets) out += formatted("%7s ", laps::bracket_name(b).c_str());
  out += '\n';
  for (const ControlRow& row : rows) out += row_text(row);
  out += formatted("%-6s %-20s %-13s %-5s", "paper", "a real car", kPaper, "mean");
  for (const Bracket& b : kBrackets) out += formatted("%7.3f ", b.paper_mean_m);
  out += "not a claim\n";
  return out;
}

std::string to_text(const std::vector<Gate>& gates) {
  std::string out;
  for (const Gate& gate : gates)
    out += formatted("gate: %s: %s%s%s\n", gate.name.c_str(), gate.held ? "held" : "MISSED",
                     gate.worst.empty() ? "" : "; worst ", gate.worst.c_str());
  return out;
}

std::string to_json(const std::vector<ControlRow>& rows) {
  json::Array listed;
  for (const ControlRow& row : rows) listed.json(row_json(row));
  return listed.str();
}

std::string to_json(const std::vector<Gate>& gates) {
  json::Array listed;
  for (const Gate& gate : gates)
    listed.json(json::Object{}
                    .text("name", gate.name)
                    .flag("held", gate.held)
                    .text("worst", gate.worst)
                    .str());
  return listed.str();
}

}  // namespace pitwall::control_bench
