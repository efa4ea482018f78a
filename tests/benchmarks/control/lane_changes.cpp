// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/lane_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/control/control_run.hpp"
#include "tests/benchmarks/laps/lap_plan.hpp"
#include "vehicle/autonomy/control/preview.hpp"

namespace pitwall::control_bench {
namespace {

constexpr std::array kSpeeds_mph{128.0, 138.0, 147.0};
constexpr double kLane_m = 3.5;  // from one line to the other
constexpr Duration kEvery = seconds(8);
constexpr Duration kChanges = seconds(5);  // the merge, and the second after it

// The set-up with a line beside the one that it has, to the left.
Result<pipeline::Setup, Problem> on_lane(const pipeline::Setup& setup, double left_m) {
  pipeline::Setup lane = setup;
  lane.params.planning.line.offset_m += left_m;
  auto line = planning::prepare(lane.params.planning, setup.track);
  if (!line) return Unexpected{line.error()};
  lane.line = *std::move(line);
  return lane;
}

class Drive {
 public:
  Drive(const Plan& plan, const pipeline::Setup& beside, LaneChangeRow& row)
      : plan_(plan), beside_(beside), row_(row) {}

  pipeline::Outputs step(const pipeline::Setup& setup, pipeline::Car& car,
                         const pipeline::Inputs& in) {
    const Window* window = window_at(plan_, in.now);
    const std::int64_t changes =
        window ? (in.now - (Instant{} + window->from)).ns / kEvery.ns + 1 : 0;
    const bool there = changes % 2 == 1;
    if (there != there_) changed_at_ = in.now, ++row_.changes;
    there_ = there;
    pipeline::Outputs out = pipeline::step(there ? beside_ : setup, car, in);
    planned_ = car.plan.output.drive;
    return out;
  }

  void look(const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    if (!row_.end.empty()) return;
    row_.end = early_end(out, rig, now);
    if (row_.changes == 0 || now - changed_at_ > kChanges || !row_.end.empty()) return;
    const plant::Truth& truth = rig.truth();
    const auto station_m = control::project(planned_, truth.x_m, truth.y_m);
    if (!station_m) return;
    const world::TrajectoryPoint at = control::at(planned_, *station_m);
    const double error_m = std::abs((truth.y_m - at.y_m) * std::cos(at.yaw_rad) -
                                    (truth.x_m - at.x_m) * std::sin(at.yaw_rad));
    ++row_.error.samples;
    row_.error.sum_m += error_m;
    row_.error.max_m = std::max(row_.error.max_m, error_m);
  }

 private:
  const Plan& plan_;
  const pipeline::Setup& beside_;
  LaneChangeRow& row_;
  bool there_ = false;
  Instant changed_at_{};
  world::Trajectory planned_;
};

}  // namespace

Plan lane_change_plan(const scenario::Scenario& like) { return plan_of(like, 0.0, kSpeeds_mph); }

Result<LaneChangeRow, Problem> run_lane_changes(const Plan& plan, const pipeline::Setup& setup) {
  LaneChangeRow row;
  row.track = setup.track.name();
  const auto own = on_lane(setup, -0.5 * kLane_m), beside = on_lane(setup, 0.5 * kLane_m);
  if (!own) return Unexpected{own.error()};
  if (!beside) return Unexpected{beside.error()};
  Drive drive{plan, *beside, row};
  bench::LockstepOptions options;
  options.step = [&drive](const pipeline::Setup& right, pipeline::Car& car,
                          const pipeline::Inputs& in) { return drive.step(right, car, in); };
  options.watch = [&drive](const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    drive.look(out, rig, now);
  };
  const auto result = bench::run_lockstep(plan.scenario, *own, options);
  if (!result) return Unexpected{result.error()};
  return row;
}

std::vector<Gate> gates_of(const std::vector<LaneChangeRow>& rows) {
  constexpr double kMean_m = 0.25, kMax_m = 0.60, kOtherMean_m = 0.40;
  Gate mean{"lane changes: mean within 0.25 m (nominal), 0.40 m (other worlds)", "", true};
  Gate most{"lane changes: maximum within 0.60 m (nominal)", "", true};
  double mean_ratio = 0.0, max_ratio = 0.0;
  const auto judge = [](Gate& gate, double& ratio, const LaneChangeRow& row, double figure_m,
                        double bound_m) {
    const bool ended = !row.end.empty() || row.changes == 0 || row.error.samples == 0;
    const double now = ended ? HUGE_VAL : figure_m / bound_m;
    gate.held = gate.held && now <= 1.0;
    if (now < ratio) return;
    ratio = now;
    gate.worst = row.track + ' ' + row.world +
                 (ended ? ": " + row.end : formatted(": %.3f of %.2f m", figure_m, bound_m));
  };
  for (const LaneChangeRow& row : rows) {
    if (row.law != kOurs || !row.is_judged) continue;
    const bool nominal = row.world == laps::kNominal;
    judge(mean, mean_ratio, row, row.error.mean_m(), nominal ? kMean_m : kOtherMean_m);
    if (nominal) judge(most, max_ratio, row, row.error.max_m, kMax_m);
  }
  return {mean, most};
}

std::string to_text(const std::vector<LaneChangeRow>& rows) {
  std::string out =
      formatted("lane changes of %.1f m at 57, 62 and 66 m/s, m from the path\n", kLane_m);
  out += formatted("%-6s %-20s %-13s %8s %8s %8s\n", "track", "world", "law", "changes", "mean",
                   "max");
  for (const LaneChangeRow& r : rows)
    out +=
        formatted("%-6.6s %-20.20s %-13s %8zu %8.3f %8.3f %s\n", r.track.c_str(), r.world.c_str(),
                  r.law.c_str(), r.changes, r.error.mean_m(), r.error.max_m, r.end.c_str());
  return out;
}

std::string to_json(const std::vector<LaneChangeRow>& rows) {
  json::Array listed;
  for (const LaneChangeRow& r : rows)
    listed.json(json::Object{}
                    .text("track", r.track)
                    .text("world", r.world)
                    .text("law", r.law)
                    .text("end", r.end)
                    .number("changes", r.changes)
                    .number("mean_m", r.error.mean_m())
                    .number("max_m", r.error.max_m)
                    .str());
  return listed.str();
}

}  // namespace pitwall::control_bench
