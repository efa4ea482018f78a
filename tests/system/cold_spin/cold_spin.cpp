// SPDX-License-Identifier: Apache-2.0
#include "tests/system/cold_spin/cold_spin.hpp"

#include <algorithm>
#include <cmath>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"
#include "hil/plant/tyre_thermal.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/system/cars/car_stops.hpp"

namespace pitwall::testing {
namespace {

constexpr double kRound_mph = 5.0, kLongest_s = 300.0, kSlipAbove_mps = 5.0;
constexpr double kRampFrom_s = 10.0, kRamp_mps2 = 1.0;
constexpr double kStart_m = 2250.0;
constexpr double kNoCap_mps = 1e3;  // the published chain knows no highest speed of the car

plant::Params cold_car(double loss) {
  plant::Params plant = flying_lap("lvms").scenario.plant;
  plant::TyreThermal& t = plant.thermal;
  t.cold_grip_loss = loss * (t.working_c - t.ambient_c) / (t.working_c - kLossAt_c);
  return plant;
}

pipeline::Setup setup_of(Chain chain) {
  pipeline::Setup setup = flying_lap("lvms").setup;
  if (chain == Chain::kOurs) return setup;
  setup.params.planning.speed_law = planning::SpeedLaw::kPaper;
  setup.params.planning.line.speed_max_mps = kNoCap_mps;
  setup.params.control.controller = control::controller_named("paper_lqr");
  setup.params.supervisor.faults.off.add(world::Monitor::kOversteer);
  return setup;
}

scenario::Scenario scenario_of(const SpinCase& spin) {
  scenario::Scenario s = green_run("lvms", cold_car(drawn_loss(spin.seed)), kSpinTyre_c,
                                   spin.base_mph + kSpinRaise_mph);
  s.seed = spin.seed;
  s.duration = from_seconds(kLongest_s);
  s.start.s_m = kStart_m;
  return s;
}

class Drive {
 public:
  explicit Drive(const SpinCase& spin) : base_mps_(from_mph(spin.base_mph)) {
    run_.of = spin, run_.loss = drawn_loss(spin.seed);
  }

  pipeline::Outputs step(const pipeline::Setup& setup, pipeline::Car& car,
                         const pipeline::Inputs& in) const {
    pipeline::Inputs own = in;
    const double ramp_mps = kRamp_mps2 * ((in.now - Instant{}).seconds() - kRampFrom_s);
    own.operator_speed_limit_mps =
        run_.raised ? base_mps_ + from_mph(kSpinRaise_mph) : std::clamp(ramp_mps, 0.0, base_mps_);
    return pipeline::step(setup, car, own);
  }

  void watch(const bench::Rig& rig, Instant now) {
    const plant::Truth& t = rig.truth();
    if (over()) return;
    const double station_m = rig.road().s_m;
    const double since_start_s = (now - Instant{}).seconds() - kRampFrom_s;
    if (kRamp_mps2 * since_start_s < base_mps_) based_m_ = t.odometer_m;
    const bool at_turn = station_before_m_ < kTurn_m && station_m >= kTurn_m;
    if (!run_.raised && at_turn && t.odometer_m - based_m_ > lap_m()) {
      run_.raised = true, raised_at_ = now, raised_m_ = t.odometer_m;
      run_.from_mps = t.speed_mps;
    }
    station_before_m_ = station_m;
    const double slip_deg = std::abs(to_deg(std::atan2(t.vy_mps, t.vx_mps)));
    run_.spun = t.speed_mps > kSlipAbove_mps && slip_deg > kSpun_deg;
    run_.left = rig.road().contact;
    run_.station_m = station_m;
    if (!run_.raised) return;
    run_.after_s = (now - raised_at_).seconds();
    run_.fastest_mps = std::max(run_.fastest_mps, t.speed_mps);
    if (t.speed_mps > kSlipAbove_mps) run_.slip_deg = std::max(run_.slip_deg, slip_deg);
    run_.wall_gap_m = std::fmin(run_.wall_gap_m, bench::wall_gap_m(rig));
    lap_done_ = t.odometer_m - raised_m_ > lap_m();
  }

  bool over() const { return run_.lost() || lap_done_; }
  const SpinRun& run() const { return run_; }

 private:
  static double lap_m() { return flying_lap("lvms").setup.track.length_m(); }

  double base_mps_;
  SpinRun run_;
  double station_before_m_ = 1e9, based_m_ = 0.0, raised_m_ = 0.0;
  Instant raised_at_{};
  bool lap_done_ = false;
};

}  // namespace

const char* text_of(Chain chain) { return chain == Chain::kOurs ? "ours" : "paper"; }

double drawn_loss(std::uint64_t seed) {
  Random random{seed};
  return random.between(kLossLeast, kLossMost);
}

double base_speed_mph(double loss) {
  const plant::Params plant = cold_car(loss);
  const double grip = plant::thermal_grip(plant.thermal, kSpinTyre_c);
  return kRound_mph * std::floor(to_mph(speed_of(plant, "lvms", grip)) / kRound_mph);
}

SpinRun run_spin(const SpinCase& spin) {
  Drive drive{spin};
  bench::LockstepOptions options;
  options.step = [&](const pipeline::Setup& setup, pipeline::Car& car, const pipeline::Inputs& in) {
    return drive.step(setup, car, in);
  };
  options.watch = [&](const pipeline::Outputs&, const bench::Rig& rig, Instant now) {
    drive.watch(rig, now);
  };
  options.over = [&](const bench::RunView&) { return drive.over(); };
  CHECK(bench::run_lockstep(scenario_of(spin), setup_of(spin.chain), options));
  return drive.run();
}

std::vector<SpinRun> run_spins(const std::vector<SpinCase>& cases, unsigned workers) {
  std::vector<SpinRun> runs(cases.size());
  static_cast<void>(flying_lap("lvms"));  // reads the files once
  sweep::in_parallel(runs.size(), workers, [&](std::size_t i) { runs[i] = run_spin(cases[i]); });
  return runs;
}

SpinCount count_of(const std::vector<SpinRun>& runs, Chain chain) {
  SpinCount out;
  for (const SpinRun& run : runs) {
    if (run.of.chain != chain) continue;
    out.runs += 1, out.raised += run.raised, out.spun += run.spun, out.left += run.left;
    out.lost += run.lost() && run.raised;
  }
  return out;
}

std::string fault_of(const std::vector<SpinRun>& runs) {
  const SpinCount ours = count_of(runs, Chain::kOurs), paper = count_of(runs, Chain::kPaper);
  std::string why;
  const auto add = [&](bool holds, const std::string& what) {
    if (holds) why += (why.empty() ? "" : "; ") + what;
  };
  add(ours.runs == 0 || paper.runs == 0, "a chain did not run");
  add(ours.raised < ours.runs || paper.raised < paper.runs, "a car did not come to the turn");
  add(ours.spun + ours.left > 0, "our chain spins or leaves the track");
  add(10 * paper.lost < 9 * paper.runs, "the published chain survives more than one run in ten");
  return why;
}

std::string row_of(const SpinRun& r) {
  return formatted(
      "seed %3llu loss %.3f %-5s %s from %4.1f m/s, to %4.1f m/s, slip %5.1f deg, wall %5.2f m, "
      "%5.1f s after at station %4.0f m",
      static_cast<unsigned long long>(r.of.seed), r.loss, text_of(r.of.chain),
      !r.raised ? (r.lost() ? "LOST BEFORE" : "NOT RAISED ")
      : r.spun  ? "SPINS      "
      : r.left  ? "AT THE WALL"
                : "laps       ",
      r.from_mps, r.fastest_mps, r.slip_deg, r.wall_gap_m, r.after_s, r.station_m);
}

std::string to_json(const std::vector<SpinRun>& runs) {
  const auto number = [](double value) {
    return std::isfinite(value) ? formatted("%.4g", value) : std::string{"null"};
  };
  const auto yes = [](bool value) { return value ? "true" : "false"; };
  std::string text = formatted("{\"simulated\": true, \"raise_mph\": %.0f, ", kSpinRaise_mph);
  for (const Chain chain : kChains) {
    const SpinCount c = count_of(runs, chain);
    text += formatted("\"%s\": {\"runs\": %zu, \"raised\": %zu, \"spun\": %zu, \"left\": %zu}, ",
                      text_of(chain), c.runs, c.raised, c.spun, c.left);
  }
  text += "\"fault\": \"" + fault_of(runs) + "\", \"each\": [";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SpinRun& r = runs[i];
    text += (i == 0 ? "\n" : ",\n") +
            formatted(
                "{\"seed\": %llu, \"chain\": \"%s\", \"base_mph\": %.0f, \"loss\": %s, \"raised\": "
                "%s, ",
                static_cast<unsigned long long>(r.of.seed), text_of(r.of.chain), r.of.base_mph,
                number(r.loss).c_str(), yes(r.raised)) +
            formatted("\"spun\": %s, \"left\": %s, \"from_mps\": %s, \"fastest_mps\": %s, ",
                      yes(r.spun), yes(r.left), number(r.from_mps).c_str(),
                      number(r.fastest_mps).c_str()) +
            formatted("\"slip_deg\": %s, \"wall_gap_m\": %s, \"after_s\": %s, \"station_m\": %s}",
                      number(r.slip_deg).c_str(), number(r.wall_gap_m).c_str(),
                      number(r.after_s).c_str(), number(r.station_m).c_str());
  }
  return text + "\n]}\n";
}

}  // namespace pitwall::testing
