// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/lap_run.hpp"

#include <algorithm>
#include <cmath>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"

namespace pitwall::laps {
namespace {

constexpr std::uint32_t kFlyingLapsWanted = 2;
constexpr double kSlipSpeed_mps = 10.0;  // slower, the direction of motion says little

class LapWatch {
 public:
  LapWatch(LapRow& row, double length_m, double line_offset_m)
      : row_(row), length_m_(length_m), line_offset_m_(line_offset_m) {}

  void look(const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    if (row_.outcome == Outcome::kContact) return;
    const plant::Truth& truth = rig.truth();
    grading::add(row_.cross_track, truth.speed_mps, bench::cross_track_m(rig, line_offset_m_));
    row_.speed_max_mps = std::max(row_.speed_max_mps, truth.speed_mps);
    if (truth.vx_mps > kSlipSpeed_mps)
      row_.slip_max_rad =
          std::max(row_.slip_max_rad, std::abs(std::atan2(truth.vy_mps, truth.vx_mps)));
    count(rig.laps());
    if (rig.road().contact) end(Outcome::kContact, rig, now);
    if (row_.outcome == Outcome::kUnfinished && stops_itself(out, rig)) {
      row_.cause = safety::text_of(out.chosen.cause);
      end(Outcome::kStopped, rig, now);
    }
  }

 private:
  void count(const bench::Laps& laps) {
    row_.laps = laps.finished;
    if (laps.flying == row_.flying) return;
    row_.flying = laps.flying;
    flying_s_ += laps.last_s;
    row_.flying_mean_mps = length_m_ * row_.flying / flying_s_;
  }

  static bool stops_itself(const pipeline::Outputs& out, const bench::Rig& rig) {
    return rig.flags().track == world::TrackFlag::kGreen &&
           (out.chosen.mode == world::Mode::kControlledStop ||
            out.chosen.mode == world::Mode::kEmergencyStop);
  }

  void end(Outcome outcome, const bench::Rig& rig, Instant now) {
    row_.outcome = outcome;
    row_.at_s = now.seconds();
    row_.station_m = rig.road().s_m;
    row_.speed_mps = rig.truth().speed_mps;
  }

  LapRow& row_;
  double length_m_, line_offset_m_;
  double flying_s_ = 0.0;
};

}  // namespace

Result<LapRow, Problem> run_laps(const scenario::Scenario& scenario, const pipeline::Setup& setup) {
  LapRow row;
  row.track = setup.track.name();
  LapWatch watch{row, setup.track.length_m(), setup.params.planning.line.offset_m};
  bench::LockstepOptions options;
  options.watch = [&watch](const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    watch.look(out, rig, now);
  };
  const auto result = bench::run_lockstep(scenario, setup, options);
  if (!result) return Unexpected{result.error()};
  if (row.outcome == Outcome::kUnfinished && row.flying >= kFlyingLapsWanted)
    row.outcome = Outcome::kLapped;
  return row;
}

bool same_run(const LapRow& a, const LapRow& b) {
  return a.cross_track.overall.samples == b.cross_track.overall.samples &&
         a.cross_track.overall.sum_m == b.cross_track.overall.sum_m &&
         a.cross_track.slow == b.cross_track.slow && a.speed_max_mps == b.speed_max_mps;
}

}  // namespace pitwall::laps
