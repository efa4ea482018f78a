// SPDX-License-Identifier: Apache-2.0
#include "tests/system/safe_stop/impact_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/nodes/raptor.hpp"
#include "tests/hil/plant/family/grip_limit.hpp"
#include "tests/hil/plant/family/steady_turn.hpp"
#include "vehicle/safety/causes.hpp"
#include "vehicle/safety/stop_brake.hpp"

namespace pitwall::testing {
namespace {

constexpr double kEvery_m = 10.0, kBoundStep_s = 0.01, kLongest_s = 60.0, kRestsBelow_mps = 0.5;
constexpr int kLimitEvery = 10;  // steps between two looks at the tyres' limit

double deadline_s(safety::Cause cause) { return safety::row_of(cause).deadline.seconds(); }

class LostCar {
 public:
  explicit LostCar(const ImpactCase& of)
      : of_(of),
        wheelbase_m_(of.plant.chassis.front_axle_m + of.plant.chassis.rear_axle_m),
        understeer_(plant::understeer_of(of.plant)) {}

  // Lost at `s_m` with this error of the curvature, as a share; the impact, if there is one.
  Impact drive(double s_m, double error) {
    begin(s_m, error);
    for (double t_s = 0.0; t_s < kLongest_s; t_s += kBoundStep_s) {
      const plant::Road road = plant::road_at(of_.plant, of_.setup.track, state_, hint_m_);
      hint_m_ = road.s_m;
      if (road.contact)
        return {.speed_mps = speed_mps_,
                .normal_mps = normal_mps(of_.setup.track, road, speed_mps_, 0.0),
                .from_s_m = s_m,
                .after_m = travelled_m_,
                .after_s = t_s,
                .left = road.wall_gap_left_m < road.wall_gap_right_m};
      if (speed_mps_ < kRestsBelow_mps) break;
      notice(road, t_s);
      move(road, t_s);
    }
    return {};
  }

  double angle_rad(const world::TrackPoint& at, double speed_mps) const {
    const double k = at.curvature_per_m * std::cos(at.bank_rad);
    return wheelbase_m_ * k +
           understeer_ * (speed_mps * speed_mps * k - kGravity_mps2 * std::sin(at.bank_rad));
  }

 private:
  void begin(double s_m, double error) {
    const world::TrackPoint at =
        of_.setup.track.offset(s_m, of_.setup.params.planning.line.offset_m);
    state_ = plant::standing(of_.plant, at.x_m, at.y_m, at.yaw_rad);
    hint_m_ = s_m;
    speed_mps_ = of_.speed_mps;
    travelled_m_ = pressure_kpa_ = 0.0;
    error_ = error;
    steps_ = 0;
    noticed_s_ = of_.loss == Loss::kSteering ? kLongest_s : 0.0;
    held_rad_ = angle_rad(at, speed_mps_);
  }

  double curvature_per_m(const plant::Road& road) const {
    const double bank_rad = road.surface.bank_rad;
    const double step_rad = of_.plant.steering.quantum_rad / of_.plant.steering.ratio;
    double k = of_.setup.track.at(road.s_m).curvature_per_m * std::cos(bank_rad);
    if (of_.loss != Loss::kReference)
      k = (held_rad_ + understeer_ * kGravity_mps2 * std::sin(bank_rad)) /
          (wheelbase_m_ + understeer_ * speed_mps_ * speed_mps_);
    return k * (1.0 + error_) + std::copysign(step_rad, error_) / wheelbase_m_;
  }

  // A held angle is seen once control asks for another: for the line's, and back to the line.
  void notice(const plant::Road& road, double t_s) {
    if (of_.loss != Loss::kSteering || noticed_s_ < kLongest_s) return;
    const control::LateralWeights& weights = of_.setup.params.control.lateral.weights.back();
    const double per_m = std::sqrt(weights.state[0] / weights.steering);
    const double asked_rad = angle_rad(of_.setup.track.at(road.s_m), speed_mps_) -
                             per_m * (road.n_m - of_.setup.params.planning.line.offset_m);
    const double off_rad = std::abs(asked_rad - held_rad_) * of_.plant.steering.ratio;
    if (off_rad > of_.setup.params.supervisor.faults.following.steering.tolerance) noticed_s_ = t_s;
  }

  double reacts_after_s() const {
    switch (of_.loss) {
      case Loss::kSteering:
        return deadline_s(safety::Cause::kSteeringDeviates);
      case Loss::kReference:
        return deadline_s(safety::Cause::kImuLost);
      case Loss::kComputer:
        return drive_by_wire::Params{}.command_timeout.seconds();
    }
    return kLongest_s;
  }

  void press(double curvature_per_m, double bank_rad) {
    if (of_.loss == Loss::kComputer) {
      const drive_by_wire::Params own;
      pressure_kpa_ = std::min(pressure_kpa_ + own.brake_ramp_kpa_per_s * kBoundStep_s,
                               own.emergency_brake_kpa);
      return;
    }
    const safety::SafeStopParams& p = of_.setup.params.supervisor.safe_stop;
    const safety::Grip grip =
        safety::grip_at(p, speed_mps_, curvature_per_m, bank_rad, of_.plant.thermal.working_c);
    pressure_kpa_ =
        safety::brake_towards(p, safety::StopKind::kEmergency,
                              {p.emergency_decel_mps2, grip, pressure_kpa_, kBoundStep_s});
  }

  double brake_mps2(double lateral_mps2) const {
    const plant::Brakes& b = of_.plant.brakes;
    const bool compliant = of_.plant.structure == plant::Structure::kCompliantBrush;
    const double pressing_kpa =
        std::max(0.0, pressure_kpa_ - (compliant ? of_.plant.hydraulics.dead_band_kpa : 0.0));
    const double force_n =
        pressing_kpa * (b.front_nm_per_kpa * b.front_remaining / of_.plant.front.radius_m +
                        b.rear_nm_per_kpa * b.rear_remaining / of_.plant.rear.radius_m);
    const double used = std::min(1.0, std::abs(lateral_mps2) / limit_.lateral_mps2);
    return std::min(force_n / of_.plant.chassis.mass_kg,
                    limit_.braking_mps2 * std::sqrt(1.0 - used * used));
  }

  void move(const plant::Road& road, double t_s) {
    const double bank_rad = road.surface.bank_rad, v2 = speed_mps_ * speed_mps_;
    double k = curvature_per_m(road);
    if (steps_++ % kLimitEvery == 0)
      limit_ = plant::grip_limit(of_.plant, {speed_mps_, k / std::cos(bank_rad), bank_rad});
    const double fall_mps2 = kGravity_mps2 * std::sin(bank_rad);
    const double lateral_mps2 =
        std::clamp(v2 * k - fall_mps2, -limit_.lateral_mps2, limit_.lateral_mps2);
    k = (lateral_mps2 + fall_mps2) / v2;
    const plant::Brakes& b = of_.plant.brakes;
    double decel_mps2 = 0.0;
    if (t_s > noticed_s_ + reacts_after_s() + b.delay_s + b.lag_s) {
      press(k / std::cos(bank_rad), bank_rad);
      const plant::Aero& air = of_.plant.aero;
      decel_mps2 = brake_mps2(lateral_mps2) +
                   0.5 * air.air_density_kgpm3 * air.drag_area_m2 * v2 / of_.plant.chassis.mass_kg +
                   of_.plant.rear.rolling_resistance * kGravity_mps2;
    }
    plant::Motion& m = state_.motion;
    m.yaw_rad += speed_mps_ * k / std::cos(bank_rad) * kBoundStep_s;
    m.x_m += speed_mps_ * std::cos(m.yaw_rad) * kBoundStep_s;
    m.y_m += speed_mps_ * std::sin(m.yaw_rad) * kBoundStep_s;
    m.vx_mps = speed_mps_;
    travelled_m_ += speed_mps_ * kBoundStep_s;
    speed_mps_ = std::max(0.0, speed_mps_ - decel_mps2 * kBoundStep_s);
  }

  const ImpactCase& of_;
  double wheelbase_m_, understeer_;
  plant::State state_;
  plant::GripLimit limit_;
  double hint_m_ = 0.0, speed_mps_ = 0.0, travelled_m_ = 0.0, pressure_kpa_ = 0.0;
  double held_rad_ = 0.0, error_ = 0.0, noticed_s_ = 0.0;
  int steps_ = 0;
};

}  // namespace

const char* text_of(Loss loss) {
  constexpr std::array<const char*, 3> kTexts{"steering held", "no reference", "computers dead"};
  return kTexts[static_cast<std::size_t>(loss)];
}

double normal_mps(const world::TrackMap& track, const plant::Road& road, double speed_mps,
                  double slip_rad) {
  constexpr double kReach_m = 5.0;
  const bool left = road.wall_gap_left_m < road.wall_gap_right_m;
  const auto wall_m = [&](double s_m) {
    const world::TrackPoint at = track.at(s_m);
    return left ? at.width_left_m : -at.width_right_m;
  };
  const double along_m =
      2.0 * kReach_m * (1.0 - track.at(road.s_m).curvature_per_m * wall_m(road.s_m));
  const double wall_rad =
      std::atan2(wall_m(road.s_m + kReach_m) - wall_m(road.s_m - kReach_m), along_m);
  return speed_mps * std::abs(std::sin(road.heading_error_rad + slip_rad - wall_rad));
}

ImpactBound bound_impact(const ImpactCase& of) {
  LostCar car{of};
  ImpactBound bound;
  for (double s_m = 0.0; s_m < of.setup.track.length_m(); s_m += kEvery_m) {
    for (const double error : {-kCurvatureError, 0.0, kCurvatureError}) {
      const Impact hit = car.drive(s_m, error);
      if (hit.speed_mps > bound.fastest.speed_mps) bound.fastest = hit;
      if (hit.normal_mps > bound.steepest.normal_mps) bound.steepest = hit;
    }
  }
  return bound;
}

double steering_rate_rad_per_s(const ImpactCase& of) {
  const LostCar car{of};
  const world::TrackMap& track = of.setup.track;
  double most_rad = 0.0;
  for (double s_m = 0.0; s_m < track.length_m(); s_m += kEvery_m)
    most_rad = std::max(most_rad, std::abs(car.angle_rad(track.at(s_m + kEvery_m), of.speed_mps) -
                                           car.angle_rad(track.at(s_m), of.speed_mps)));
  return most_rad / kEvery_m * of.speed_mps;
}

}  // namespace pitwall::testing
