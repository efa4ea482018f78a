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
    row_.contact = rig.road().contact;
    row_.stopped = rig.flags().track == world::TrackFlag::kGreen &&
                   (out.chosen.mode == world::Mode::kControlledStop ||
                    out.chosen.mode == world::Mode::kEmergencyStop);
    const double speed_mps = rig.truth().speed_mps;
    if (row_.ended_early()) {
      row_.end =
          std::string(row_.contact ? "wall" : safety::text_of(out.chosen.cause)) +
          formatted(" at s = %.0f m at %.1f m/s, %.1f s", rig.road().s_m, speed_mps, now.seconds());
      return;
    }
    const Window* window = window_at(now);
    if (window == nullptr) return;
    const grading::Bracket& bracket = grading::kBrackets[window->bracket];
    if (speed_mps < bracket.from_mps || speed_mps >= bracket.to_mps) return;
    grading::add(row_.cross_track, speed_mps, bench::cross_track_m(rig, line_offset_m_));
  }

 private:
  const Window* window_at(Instant now) const {
    for (const Window& w : plan_.windows)
      if (now >= Instant{} + w.from && now < Instant{} + w.until) return &w;
    return nullptr;
  }

  ControlRow& row_;
  const Plan& plan_;
  double line_offset_m_;
};

}  // namespace

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
