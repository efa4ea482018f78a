// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_run.hpp"

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::control_bench {
namespace {

class Watch {
 public:
  Watch(ControlRow& row, const Plan& plan, double line_offset_m)
      : row_(row), plan_(plan), line_offset_m_(line_offset_m) {}

  void look(const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    if (row_.ended_early()) return;
    row_.end = early_end(out, rig, now);
    const Window* window = window_at(plan_, now);
    if (row_.ended_early() || window == nullptr) return;
    const double speed_mps = rig.truth().speed_mps;
    const grading::Bracket& bracket = grading::kBrackets[window->bracket];
    if (speed_mps < bracket.from_mps || speed_mps >= bracket.to_mps) return;
    grading::add(row_.cross_track, speed_mps, bench::cross_track_m(rig, line_offset_m_));
  }

 private:
  ControlRow& row_;
  const Plan& plan_;
  double line_offset_m_;
};

}  // namespace

std::string early_end(const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
  const bool contact = rig.road().contact;
  const bool stopped = rig.flags().track == world::TrackFlag::kGreen &&
                       (out.chosen.mode == world::Mode::kControlledStop ||
                        out.chosen.mode == world::Mode::kEmergencyStop);
  if (!contact && !stopped) return {};
  return std::string(contact ? "wall" : safety::text_of(out.chosen.cause)) +
         formatted(" at s = %.0f m at %.1f m/s, %.1f s", rig.road().s_m, rig.truth().speed_mps,
                   now.seconds());
}

Result<ControlRow, Problem> run_control(const Plan& plan, const pipeline::Setup& setup) {
  ControlRow row;
  row.track = setup.track.name();
  Watch watch{row, plan, setup.params.planning.line.offset_m};
  bench::LockstepOptions options;
  options.watch = [&watch](const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    watch.look(out, rig, now);
  };
  const auto result = bench::run_lockstep(plan.scenario, setup, options);
  if (!result) return Unexpected{result.error()};
  return row;
}

}  // namespace pitwall::control_bench
