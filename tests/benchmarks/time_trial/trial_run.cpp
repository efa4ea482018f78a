// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/time_trial/trial_run.hpp"

#include <algorithm>
#include <cmath>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"

namespace pitwall::time_trial {
namespace {

constexpr double kSlipSpeed_mps = 10.0;  // slower, the direction of motion says little
constexpr double kSpun_deg = 20.0;       // a car that corners has some 5

class TrialWatch {
 public:
  TrialWatch(TrialRow& row, const pipeline::Setup& setup)
      : row_(row),
        length_m_(setup.track.length_m()),
        line_offset_m_(setup.params.planning.line.offset_m) {}

  void look(const pipeline::Outputs& out, const bench::Rig& rig) {
    if (is_over()) return;
    const plant::Truth& truth = rig.truth();
    row_.speed_max_mps = std::max(row_.speed_max_mps, truth.speed_mps);
    row_.wall_gap_m = std::min(row_.wall_gap_m, bench::wall_gap_m(rig));
    row_.contact = rig.road().contact;
    row_.stopped = row_.stopped || (rig.flags().track == world::TrackFlag::kGreen &&
                                    (out.chosen.mode == world::Mode::kControlledStop ||
                                     out.chosen.mode == world::Mode::kEmergencyStop));
    if (truth.speed_mps > kSlipSpeed_mps) {
      row_.slip_max_deg =
          std::max(row_.slip_max_deg, std::abs(to_deg(std::atan2(truth.vy_mps, truth.vx_mps))));
      row_.cross_track_max_m =
          std::max(row_.cross_track_max_m, std::abs(bench::cross_track_m(rig, line_offset_m_)));
    }
    count(rig.laps());
  }

  bool is_over() const { return row_.contact || row_.stopped || row_.laps == kLaps; }

 private:
  void count(const bench::Laps& laps) {
    if (laps.flying == flying_) return;
    flying_ = laps.flying;
    if (flying_ < 2) return;
    ++row_.laps;
    sum_s_ += laps.last_s;
    row_.best_s = std::fmin(row_.best_s, laps.last_s);
    row_.worst_s = std::fmax(row_.worst_s, laps.last_s);
    row_.mean_mps = length_m_ * row_.laps / sum_s_;
  }

  TrialRow& row_;
  double length_m_, line_offset_m_, sum_s_ = 0.0;
  std::uint32_t flying_ = 0;
};

}  // namespace

bool TrialRow::spun() const { return slip_max_deg > kSpun_deg; }

Result<TrialRow, Problem> run_trial(const scenario::Scenario& scenario,
                                    const pipeline::Setup& setup) {
  TrialRow row;
  row.seed = scenario.seed;
  row.planned_s = setup.line.lap_s.back();
  TrialWatch watch{row, setup};
  bench::LockstepOptions options;
  options.watch = [&watch](const pipeline::Outputs& out, const bench::Rig& rig, Instant) {
    watch.look(out, rig);
  };
  options.over = [&watch](const bench::RunView&) { return watch.is_over(); };
  const auto result = bench::run_lockstep(scenario, setup, options);
  if (!result) return Unexpected{result.error()};
  return row;
}

}  // namespace pitwall::time_trial
