// SPDX-License-Identifier: Apache-2.0
#include "hil/report/time_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/report/absent.hpp"
#include "hil/report/plot.hpp"
#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

constexpr std::size_t kChartBuckets = 1060;  // about one for each pixel
constexpr const char* kNotInLive = "not recorded: the car of a live run is a process of its own";

struct State {
  int value;
  const char* name;
  Colour fill;
};
constexpr Colour kCalm{"#dfe5ea"}, kGo{"#a9dcc3"}, kSlow{"#f5dd8b"}, kStop{"#f2a58e"},
    kEnd{"#c9b8dc"};

constexpr std::array kModes{State{0, "disarmed", kCalm},       State{1, "standby", kCalm},
                            State{2, "driving", kGo},          State{3, "controlled stop", kSlow},
                            State{4, "emergency stop", kStop}, State{5, "halted", kEnd}};
constexpr std::array kCtStates{
    State{1, "power on", kCalm},         State{2, "initialised", kCalm},
    State{3, "actuator test", kCalm},    State{4, "crank ready", kCalm},
    State{5, "cranking", kCalm},         State{6, "race ready", kCalm},
    State{7, "init driving", kCalm},     State{8, "caution", kSlow},
    State{9, "nominal race", kGo},       State{10, "coordinated stop", kSlow},
    State{11, "controlled stop", kSlow}, State{12, "emergency stop", kStop},
    State{255, "default", kCalm}};
constexpr std::array kSysStates{State{0, "unknown", kCalm},
                                State{1, "power on", kCalm},
                                State{2, "connected", kCalm},
                                State{3, "actuator test", kCalm},
                                State{4, "test done", kCalm},
                                State{5, "crank ready", kCalm},
                                State{6, "pre-crank check", kCalm},
                                State{7, "cranking", kCalm},
                                State{8, "engine running", kCalm},
                                State{9, "driving", kGo},
                                State{10, "shut engine", kStop},
                                State{11, "power off", kEnd},
                                State{12, "Raptor off", kEnd},
                                State{13, "crank check", kCalm},
                                State{14, "actuator test failed", kStop},
                                State{15, "crank check failed", kStop},
                                State{16, "emergency", kStop},
                                State{17, "no engine start", kStop},
                                State{18, "critical limits", kStop},
                                State{19, "standby", kCalm},
                                State{255, "default", kCalm}};
constexpr std::array kFlags{State{0, "none", kCalm},
                            State{1, "red", Colour{"#f2a58e"}},
                            State{2, "orange", Colour{"#f6c68a"}},
                            State{3, "yellow", Colour{"#f5dd8b"}},
                            State{4, "green", kGo},
                            State{5, "waving green", kGo},
                            State{6, "chequered", kEnd},
                            State{7, "unknown", kStop}};

Lane lane_of(const char* name, std::span<const Span> spans, std::span<const State> states,
             const std::string& why_absent) {
  Lane lane{.name = name, .pieces = {}, .absent = why_absent};
  for (const Span& span : spans) {
    const auto state = std::ranges::find(states, span.value, &State::value);
    const bool known = state != states.end();
    lane.pieces.push_back({span.from_s, span.to_s,
                           known ? state->name : "number " + std::to_string(span.value),
                           known ? state->fill : kStop});
  }
  return lane;
}

std::string label_of(const FaultSpan& fault) {
  return fault.kind + (fault.can_id != 0 ? formatted(" id %u", fault.can_id) : std::string());
}

double end_of(const FaultSpan& fault, const RunData& run) {
  return std::isfinite(fault.to_s) ? fault.to_s : run.end_s();
}

void add_fault_lanes(const RunData& run, std::vector<Lane>& lanes) {
  constexpr std::size_t kLanesMax = 12;
  if (run.faults.empty())
    lanes.push_back({.name = "faults", .pieces = {}, .absent = "none in this scenario"});
  for (std::size_t i = 0; i < run.faults.size(); ++i) {
    const FaultSpan& fault = run.faults[i];
    if (i < kLanesMax)
      lanes.push_back({.name = formatted("fault %zu", i + 1), .pieces = {}, .absent = {}});
    lanes.back().pieces.push_back({fault.from_s, end_of(fault, run), label_of(fault), kStop});
  }
}

std::string state_lanes(const RunData& run) {
  using T = bench::TruthSample;
  std::vector<Lane> lanes;
  const std::string no_truth = "not recorded";
  lanes.push_back(lane_of("car mode", spans_of(run.car, [](const auto& v) { return v.mode; }),
                          kModes, kNotInLive));
  lanes.push_back(lane_of("computer (CT)",
                          spans_of(run.truth, [](const T& v) { return v.ct_state; }), kCtStates,
                          no_truth));
  lanes.push_back(lane_of("drive-by-wire",
                          spans_of(run.truth, [](const T& v) { return v.sys_state; }), kSysStates,
                          no_truth));
  lanes.push_back(lane_of("track flag",
                          spans_of(run.truth, [](const T& v) { return v.track_flag; }), kFlags,
                          no_truth));
  add_fault_lanes(run, lanes);
  Lane violations{.name = "violations", .pieces = {}, .absent = "none"};
  for (const VerdictRow& verdict : run.verdicts)
    if (!verdict.pass && std::isfinite(verdict.first_violation_s))
      violations.pieces.push_back({verdict.first_violation_s, verdict.first_violation_s + 1e-3,
                                   "first violation: " + verdict.text, kVermillion});
  lanes.push_back(std::move(violations));
  return lanes_svg("states", "States, flags and faults", lanes, kPageWidth, run.end_s());
}

struct Curve {
  Line line;
  Plot::Mark mark;
};

struct ChartText {
  const char *name, *title, *axis;
  double height = 170.0, least_span = 1.0;
};

std::string chart(const RunData& run, const ChartText& text, std::vector<Curve> curves,
                  const std::string& why_absent) {
  std::vector<Line> lines;
  for (Curve& curve : curves) {
    curve.line = thinned(curve.line, 0.0, run.end_s(), kChartBuckets);
    lines.push_back(curve.line);
  }
  const bool drawn = std::ranges::any_of(lines, [](const Line& line) {
    return std::ranges::any_of(line, [](const Point& p) { return std::isfinite(p.y); });
  });
  if (!drawn) return absent(text.name, text.title, why_absent);
  Plot plot(text.name, text.title, Plot::Kind::kTime, {kPageWidth, text.height},
            {0.0, run.end_s(), "time, s"}, axis_over(lines, text.axis, text.least_span));
  for (const FaultSpan& fault : run.faults)
    plot.band(fault.from_s, end_of(fault, run), kVermillion, label_of(fault));
  for (const Curve& curve : curves) plot.line(curve.line, curve.mark);
  return plot.svg();
}

template <class Value>
Curve truth_curve(const RunData& run, Colour colour, const char* name, const char* unit,
                  Value value) {
  return {line_of(run.truth, value), {.colour = colour, .name = name, .unit = unit}};
}

std::string speed_chart(const RunData& run) {
  using T = bench::TruthSample;
  std::vector<Curve> curves;
  curves.push_back({line_of(run.car, [](const auto& v) { return v.target_speed_mps; }),
                    {.colour = kOrange, .name = "target", .unit = "m/s", .dashed = true}});
  curves.push_back(truth_curve(run, kBlue, "speed", "m/s",
                               [](const T& v) { return std::hypot(v.vx_mps, v.vy_mps); }));
  std::string out = chart(run, {"speed", "Speed", "speed, m/s", 210.0}, std::move(curves),
                          "no truth was recorded");
  if (run.car.empty()) out += absent("target_speed", "Target speed", kNotInLive);
  return out;
}

std::string control_charts(const RunData& run) {
  using T = bench::TruthSample;
  std::vector<Curve> pedals;
  pedals.push_back(
      truth_curve(run, kGreen, "throttle", "%", [](const T& v) { return 100.0 * v.throttle; }));
  pedals.push_back(
      truth_curve(run, kVermillion, "brake", "bar", [](const T& v) { return 0.01 * v.brake_kpa; }));
  std::vector<Curve> steering;
  steering.push_back(truth_curve(run, kPurple, "steering motor", "deg",
                                 [](const T& v) { return to_deg(v.steering_motor_rad); }));
  const std::string why = "no truth was recorded";
  return chart(run, {"pedals", "Throttle and brake", "%, bar"}, std::move(pedals), why) +
         chart(run, {"steering", "Steering", "motor, deg"}, std::move(steering), why);
}

std::string error_charts(const RunData& run) {
  using T = bench::TruthSample;
  std::vector<Curve> error, gap;
  error.push_back(truth_curve(run, kBlue, "cross-track error", "m",
                              [](const T& v) { return v.cross_track_m; }));
  gap.push_back(truth_curve(run, kInk, "gap", "m", [](const T& v) { return v.wall_gap_m; }));
  return chart(
             run,
             {"cross_track", "Cross-track error (truth; left is positive)", "error, m", 190.0, 0.1},
             std::move(error), "this log holds none") +
         chart(run, {"wall_gap", "Gap to the nearest wall", "gap, m"}, std::move(gap),
               "no truth was recorded");
}

std::string bus_chart(const RunData& run) {
  constexpr double kLoadWindow_s = 0.25;
  std::vector<Curve> load;
  // The truth ends where the run was cut off; what follows is not an empty bus.
  const double end_s = run.truth.empty() ? run.end_s() : run.truth.back().t_s;
  Line line = bus_load(run.can, end_s, kLoadWindow_s);
  for (Point& point : line) point.y *= 100.0;
  load.push_back({std::move(line), {.colour = kBlue, .name = "load", .unit = "%"}});
  return chart(run,
               {"bus_load", "Load of the CAN bus (stuff bits counted)", "% of 500 kbit/s", 160.0},
               std::move(load), "no CAN frame was recorded");
}

std::string tyre_chart(const RunData& run) {
  using T = bench::TruthSample;
  std::vector<Curve> tyres;
  tyres.push_back(
      truth_curve(run, kBlue, "front left", "C", [](const T& v) { return v.tyre_fl_c; }));
  tyres.push_back(
      truth_curve(run, kVermillion, "front right", "C", [](const T& v) { return v.tyre_fr_c; }));
  tyres.push_back(
      truth_curve(run, kGreen, "rear left", "C", [](const T& v) { return v.tyre_rl_c; }));
  tyres.push_back(
      truth_curve(run, kPurple, "rear right", "C", [](const T& v) { return v.tyre_rr_c; }));
  return chart(run, {"tyres", "Tyre temperature: model unvalidated", "deg C", 170.0, 5.0},
               std::move(tyres), "no truth was recorded");
}

}  // namespace

std::string time_charts(const RunData& run) {
  return state_lanes(run) + speed_chart(run) + error_charts(run) + control_charts(run) +
         bus_chart(run) + tyre_chart(run);
}

}  // namespace pitwall::report
