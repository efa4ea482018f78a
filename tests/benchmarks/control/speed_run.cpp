// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/speed_run.hpp"

#include <algorithm>
#include <cmath>

#include "hil/bench/lockstep/lockstep.hpp"
#include "tests/benchmarks/control/control_run.hpp"

namespace pitwall::speed_bench {
namespace {

constexpr double kThrottleUsed = 0.02, kBrakeUsed_kpa = 50.0;

enum class Pedal : std::uint8_t { kNone, kThrottle, kBrake };

// Shifts that a speed needs: over the speeds of the shifts of the car file, with their hysteresis.
class Crossings {
 public:
  Crossings(const control::GearParams& gears) : gears_(gears) {}

  std::size_t of(double speed_mps) {
    while (gear_ < control::kGears && speed_mps > gears_.up_above_mps[gear_ - 1]) ++gear_, ++count_;
    while (gear_ > 1 && speed_mps < gears_.down_below_mps[gear_ - 2]) --gear_, ++count_;
    return count_;
  }

 private:
  const control::GearParams& gears_;
  std::size_t gear_ = 1, count_ = 0;
};

class Watch {
 public:
  Watch(SpeedRow& row, const Plan& plan, const pipeline::Setup& setup)
      : row_(row), plan_(plan), crossings_(setup.params.control.gear) {}

  void look(const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    if (!row_.end.empty() || now < Instant{} + plan_.holds.front().from) return;
    row_.end = control_bench::early_end(out, rig, now);
    const Hold* hold = hold_at(now);
    if (out.chosen.mode != world::Mode::kDriving || !row_.end.empty() || hold == nullptr) return;
    const double speed_mps = rig.truth().speed_mps;
    const bool steady = now >= Instant{} + hold->steady_from;
    look_at_gears(out, now);
    look_at_pedals(out.chosen.command, steady);
    look_at_speed(out.tracking.target_speed_mps, speed_mps, *hold, steady, now);
    row_.missed_shifts = out.steered.next.gear.missed;
    row_.refusals = out.passed.refused_total;
  }

 private:
  const Hold* hold_at(Instant now) const {
    for (const Hold& h : plan_.holds)
      if (now >= Instant{} + h.from && now < Instant{} + h.until) return &h;
    return nullptr;
  }

  void look_at_gears(const pipeline::Outputs& out, Instant now) {
    const std::uint8_t gear = out.chosen.command.gear;
    if (gear_ != 0 && gear != gear_ && gear >= 1) ++row_.shifts, shifted_ = now;
    gear_ = gear;
    if (std::isfinite(out.tracking.target_speed_mps))
      row_.crossings = crossings_.of(out.tracking.target_speed_mps);
  }

  void look_at_pedals(const world::ActuatorCommand& command, bool steady) {
    const Pedal pedal = command.brake_kpa > kBrakeUsed_kpa          ? Pedal::kBrake
                        : command.throttle_fraction > kThrottleUsed ? Pedal::kThrottle
                                                                    : pedal_;
    if (pedal_ == Pedal::kThrottle && pedal == Pedal::kBrake) {
      ++row_.brakings;
      row_.steady_brakings += steady ? 1 : 0;
    }
    pedal_ = pedal;
  }

  void look_at_speed(double reference_mps, double speed_mps, const Hold& hold, bool steady,
                     Instant now) {
    row_.driving.add(reference_mps - speed_mps);
    if (steady && (now - shifted_).seconds() > kShift_s) row_.steady.add(reference_mps - speed_mps);
    if (&hold == &plan_.holds[plan_.step])
      row_.overshoot_mps = std::fmax(row_.overshoot_mps, speed_mps - hold.speed_mps);
  }

  SpeedRow& row_;
  const Plan& plan_;
  Crossings crossings_;
  Instant shifted_{};
  std::uint8_t gear_ = 0;
  Pedal pedal_ = Pedal::kNone;
};

}  // namespace

void SpeedError::add(double error_mps) {
  ++ticks;
  squares += error_mps * error_mps;
  max_mps = std::fmax(max_mps, std::abs(error_mps));
}

double SpeedError::rms_mps() const {
  return ticks == 0 ? kUnset : std::sqrt(squares / static_cast<double>(ticks));
}

Result<SpeedRow, Problem> run_speed(const Plan& plan, const pipeline::Setup& setup) {
  SpeedRow row;
  row.track = setup.track.name();
  row.slow_downs = plan.slow_downs;
  Watch watch{row, plan, setup};
  bench::LockstepOptions options;
  options.watch = [&watch](const pipeline::Outputs& out, const bench::Rig& rig, Instant now) {
    watch.look(out, rig, now);
  };
  const auto result = bench::run_lockstep(plan.scenario, setup, options);
  if (!result) return Unexpected{result.error()};
  return row;
}

}  // namespace pitwall::speed_bench
