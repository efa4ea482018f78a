// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/params.hpp"

#include <array>
#include <numbers>
#include <string>

#include "vehicle/world/legal_range.hpp"

namespace pitwall::localization {
namespace {

using world::LegalRange;

std::optional<Problem> illegal_unit(const UnitParams& unit, std::size_t index) {
  constexpr double kReach_m = 5.0;
  const std::string place = "units[" + std::to_string(index) + "].";
  auto problem = world::first_illegal(std::array{
      LegalRange{"antenna.x_m", unit.antenna.x_m, -kReach_m, kReach_m},
      LegalRange{"antenna.y_m", unit.antenna.y_m, -kReach_m, kReach_m},
      LegalRange{"antenna.z_m", unit.antenna.z_m, -kReach_m, kReach_m},
      LegalRange{"imu.x_m", unit.imu.x_m, -kReach_m, kReach_m},
      LegalRange{"imu.y_m", unit.imu.y_m, -kReach_m, kReach_m},
      LegalRange{"imu.z_m", unit.imu.z_m, -kReach_m, kReach_m},
      LegalRange{"baseline_m", unit.baseline_m, 0.2, 5.0},
      LegalRange{"baseline_yaw_rad", unit.baseline_yaw_rad, -std::numbers::pi, std::numbers::pi}});
  if (problem) problem->place = place + problem->place;
  return problem;
}

std::optional<Problem> illegal_sensors(const Params& p) {
  return world::first_illegal(
      std::array{LegalRange{"position_sigma_max_m", p.position_sigma_max_m, 0.05, 20},
                 LegalRange{"heading_sigma_max_rad", p.heading_sigma_max_rad, 0.005, 0.5},
                 LegalRange{"steering_ratio", p.steering_ratio, 5, 40},
                 LegalRange{"wheelbase_m", p.wheelbase_m, 1, 5},
                 LegalRange{"understeer_rad_per_mps2", p.understeer_rad_per_mps2, -0.005, 0.02},
                 LegalRange{"imu_timeout_s", p.imu_timeout_s, 0.02, 0.5},
                 LegalRange{"good_age_max_s", p.good_age_max_s, 0.1, 2},
                 LegalRange{"dead_reckoning_max_s", p.dead_reckoning_max_s, 0.5, 20},
                 LegalRange{"good_sigma_max_m", p.good_sigma_max_m, 0.05, 5},
                 LegalRange{"lost_sigma_max_m", p.lost_sigma_max_m, 0.5, 50},
                 LegalRange{"reset_after_s", p.reset_after_s, 0.5, 10}});
}

}  // namespace

Result<Params, Problem> checked(const Params& params) {
  for (std::size_t i = 0; i < params.units.size(); ++i) {
    if (auto problem = illegal_unit(params.units[i], i)) return Unexpected{*problem};
  }
  if (auto problem = illegal(params.filter)) return Unexpected{*problem};
  if (auto problem = illegal(params.checks)) return Unexpected{*problem};
  if (auto problem = illegal_sensors(params)) return Unexpected{*problem};
  return params;
}

}  // namespace pitwall::localization
