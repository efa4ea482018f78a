// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/envelope_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::envelope {
namespace {

constexpr double kBankStep_rad = from_deg(1.0);
constexpr double kSlowest_mps = 0.1;         // of a row: at standstill no curvature gives a demand
constexpr double kLateralMost_mps2 = 100.0;  // a steep bank carries anything
constexpr double kRightAngle_rad = 0.5 * std::numbers::pi;

double mix(double a, double b, double share) { return a + share * (b - a); }

// By the tyres alone: a <= s mu n with n = g / cos(bank) + a tan(bank) + downforce v^2.
double tyres_carry_mps2(const EnvelopeParams& p, double speed_mps, double bank_rad) {
  const double used = p.grip_share * p.friction.friction;
  const double load =
      kGravity_mps2 / std::cos(bank_rad) + p.friction.downforce_per_m * speed_mps * speed_mps;
  const double rest = 1.0 - used * std::tan(bank_rad);
  return rest > 0.0 ? std::min(used * load / rest, kLateralMost_mps2) : kLateralMost_mps2;
}

// By the steering: L (a + g sin(bank)) / v^2 + K a <= share angle_max(v).
double steering_carries_mps2(const SteeringLimit& s, double speed_mps, double bank_rad) {
  const double v2 = speed_mps * speed_mps;
  const double angle_rad = s.share * steering::angle_max_rad(s.limits, speed_mps);
  const double slope = s.car.wheelbase_m + s.car.understeer_rad_per_mps2 * v2;
  if (!(slope > 0.0)) return kLateralMost_mps2;
  const double rest = angle_rad * v2 - s.car.wheelbase_m * kGravity_mps2 * std::sin(bank_rad);
  return std::clamp(rest / slope, 0.0, kLateralMost_mps2);
}

}  // namespace

EnvelopeTable::EnvelopeTable(const EnvelopeParams& params) : params_(params) {
  speeds_ = static_cast<std::size_t>(std::ceil(params.speed_max_mps / kSpeedStep_mps)) + 1;
  banks_ = 2 * static_cast<std::size_t>(std::ceil(params.bank_most_rad / kBankStep_rad)) + 1;
  for (std::size_t k = 0; k < kShareRows; ++k)
    shares_[k] = std::sin(kRightAngle_rad * static_cast<double>(k) / (kShareRows - 1.0));
  shares_.back() = 1.0;
  lateral_.reserve(speeds_ * banks_);
  limits_.reserve(speeds_ * banks_ * kShareRows);
  for (std::size_t i = 0; i < speeds_; ++i) {
    const double speed_mps = std::max(static_cast<double>(i) * kSpeedStep_mps, kSlowest_mps);
    const double v2 = speed_mps * speed_mps;
    for (std::size_t j = 0; j < banks_; ++j) {
      const double bank = bank_rad(j), most_mps2 = carried_mps2(speed_mps, bank);
      const double cos_bank = std::cos(bank), sin_bank = std::sin(bank);
      lateral_.push_back(most_mps2);
      for (const double share : shares_) {
        // v^2 times the curvature of the plan view
        const double level_mps2 = (share * most_mps2 + kGravity_mps2 * sin_bank) / cos_bank;
        const RoadLoad at{speed_mps, level_mps2 / v2, bank, cos_bank, sin_bank};
        limits_.push_back({drive_available_mps2(params.friction, at, params.grip_share),
                           brake_available_mps2(params.friction, at, params.grip_share) +
                               coasting_mps2(speed_mps)});
      }
    }
  }
}

double EnvelopeTable::bank_rad(std::size_t row) const {
  return kBankStep_rad * (static_cast<double>(row) - static_cast<double>(banks_ / 2));
}

double EnvelopeTable::carried_mps2(double speed_mps, double bank_rad) const {
  const double tyres = tyres_carry_mps2(params_, speed_mps, bank_rad);
  if (!params_.steering) return tyres;
  return std::min(tyres, steering_carries_mps2(*params_.steering, speed_mps, bank_rad));
}

EnvelopeTable::Cell EnvelopeTable::cell(double at, std::size_t rows) {
  if (rows < 2 || !(at > 0.0)) return {0, 0.0};
  const auto row = std::min(static_cast<std::size_t>(at), rows - 2);
  return {row, std::min(at - static_cast<double>(row), 1.0)};
}

RoadPlace EnvelopeTable::place(double curvature_per_m, double bank_rad) const {
  return {curvature_per_m * std::cos(bank_rad), kGravity_mps2 * std::sin(bank_rad),
          bank_rad / kBankStep_rad + static_cast<double>(banks_ / 2)};
}

EnvelopeTable::Cell EnvelopeTable::bank_cell(const RoadPlace& at, double lateral_mps2) const {
  const double mirrored = static_cast<double>(banks_ - 1) - at.bank_row;
  return cell(lateral_mps2 < 0.0 ? mirrored : at.bank_row, banks_);
}

double EnvelopeTable::lateral_at(Cell speed, Cell bank) const {
  const std::size_t next = banks_ > 1 ? 1 : 0;
  const double* low = &lateral_[column(speed.row, bank.row)];
  const double* high = low + banks_;
  return mix(mix(low[0], low[next], bank.share), mix(high[0], high[next], bank.share), speed.share);
}

double EnvelopeTable::lateral_max_mps2(const RoadPlace& at, double speed_mps) const {
  return lateral_at(cell(speed_mps / kSpeedStep_mps, speeds_),
                    bank_cell(at, lateral_mps2(at, speed_mps)));
}

Longitudinal EnvelopeTable::longitudinal(const RoadPlace& at, double speed_mps) const {
  const double lateral = lateral_mps2(at, speed_mps);
  const Cell speed = cell(speed_mps / kSpeedStep_mps, speeds_), bank = bank_cell(at, lateral);
  const double most = lateral_at(speed, bank);
  const double share = std::min(most > 0.0 ? std::abs(lateral) / most : 1.0, 1.0);
  auto k =
      std::min(static_cast<std::size_t>(std::asin(share) / kRightAngle_rad * (kShareRows - 1.0)),
               kShareRows - 2);
  const double t = (share - shares_[k]) / (shares_[k + 1] - shares_[k]);
  const std::size_t next = banks_ > 1 ? kShareRows : 0;
  const auto between = [&](std::size_t speed_row) {
    const Longitudinal* row = &limits_[column(speed_row, bank.row) * kShareRows + k];
    const auto here = [&](const Longitudinal* p) {
      return Longitudinal{mix(p[0].accel_mps2, p[1].accel_mps2, t),
                          mix(p[0].brake_mps2, p[1].brake_mps2, t)};
    };
    const Longitudinal a = here(row), b = here(row + next);
    return Longitudinal{mix(a.accel_mps2, b.accel_mps2, bank.share),
                        mix(a.brake_mps2, b.brake_mps2, bank.share)};
  };
  const Longitudinal slow = between(speed.row), fast = between(speed.row + 1);
  return {mix(slow.accel_mps2, fast.accel_mps2, speed.share),
          mix(slow.brake_mps2, fast.brake_mps2, speed.share)};
}

double EnvelopeTable::corner_speed_mps(const RoadPlace& left_or_right) const {
  RoadPlace at = left_or_right;
  if (at.turn_per_m < 0.0)  // as a left-hand one
    at = {-at.turn_per_m, -at.fall_mps2, static_cast<double>(banks_ - 1) - at.bank_row};
  const auto carries = [&](double speed_mps) {
    return std::abs(lateral_mps2(at, speed_mps)) <= lateral_max_mps2(at, speed_mps);
  };
  const double most_mps = params_.speed_max_mps;
  if (carries(most_mps)) return most_mps;
  // The slowest speeds of a bank may need more than faster ones: from where gravity turns the car.
  const double neutral_mps =
      at.fall_mps2 > 0.0 && at.turn_per_m > 0.0 ? std::sqrt(at.fall_mps2 / at.turn_per_m) : 0.0;
  if (!(neutral_mps < most_mps) || !carries(neutral_mps)) return 0.0;
  auto low = static_cast<std::size_t>(neutral_mps / kSpeedStep_mps), high = speeds_ - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (carries(static_cast<double>(middle) * kSpeedStep_mps) ? low : high) = middle;
  }
  // In the row the largest demand is linear in the speed:  turn v^2 - fall = a + slope (v - v0).
  const Cell bank = bank_cell(at, 0.0);
  const double v0 = static_cast<double>(low) * kSpeedStep_mps;
  const double a = lateral_at({low, 0.0}, bank);
  const double slope = (lateral_at({low, 1.0}, bank) - a) / kSpeedStep_mps;
  const double rest = a + at.fall_mps2 - slope * v0;
  const double root =
      (slope + std::sqrt(std::max(slope * slope + 4.0 * at.turn_per_m * rest, 0.0))) /
      (2.0 * at.turn_per_m);
  return std::clamp(root, std::max(v0, neutral_mps), std::min(v0 + kSpeedStep_mps, most_mps));
}

double EnvelopeTable::coasting_mps2(double speed_mps) const {
  return params_.friction.drag_per_m * speed_mps * speed_mps;
}

std::string EnvelopeTable::csv() const {
  const Engine& e = params_.friction.engine;
  std::string out =
      "# envelope of a car: linear in speed, in bank and in lateral demand over the\n"
      "# largest demand of the same speed and bank, which is that of its last row\n" +
      formatted("# grip_share %.17g\n# speed_max_mps %.17g\n# drag_per_m %.17g\n",
                params_.grip_share, params_.speed_max_mps, params_.friction.drag_per_m);
  if (has_gears(e)) {
    out += formatted("# shift_s %.17g\n# up_above_mps", e.shift_s);
    for (const double up_mps : e.up_above_mps) out += formatted(" %.17g", up_mps);
    out += "\n# down_below_mps";
    for (const double down_mps : e.down_below_mps) out += formatted(" %.17g", down_mps);
    out += "\n";
  }
  out += "speed_mps,bank_rad,lateral_mps2,accel_mps2,brake_mps2\n";
  for (std::size_t i = 0; i < speeds_; ++i)
    for (std::size_t j = 0; j < banks_; ++j)
      for (std::size_t k = 0; k < kShareRows; ++k) {
        const Longitudinal& l = limits_[column(i, j) * kShareRows + k];
        out +=
            formatted("%.17g,%.10f,%.10f,%.10f,%.10f\n", static_cast<double>(i) * kSpeedStep_mps,
                      bank_rad(j), shares_[k] * lateral_[column(i, j)], l.accel_mps2, l.brake_mps2);
      }
  return out;
}

}  // namespace pitwall::envelope
