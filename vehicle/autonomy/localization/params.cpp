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
  return world::first_illegal(
      std::array{LegalRange{"antenna.x_m", unit.antenna.x_m, -kReach_m, kReach_m},
                 LegalRange{"antenna.y_m", unit.antenna.y_m, -kReach_m, kReach_m},
                 LegalRange{"antenna.z_m", unit.antenna.z_m, -kReach_m, kReach_m},
                 LegalRange{"imu.x_m", unit.imu.x_m, -kReach_m, kReach_m},
                 LegalRange{"imu.y_m", unit.imu.y_m, -kReach_m, kReach_m},
                 LegalRange{"imu.z_m", unit.imu.z_m, -kReach_m, kReach_m},
                 LegalRange{"baseline_m", unit.baseline_m, 0.2, 5.0},
                 LegalRange{"baseline_yaw_rad", unit.baseline_yaw_rad, -std::numbers::pi,
                            std::numbers::pi}},
      place);
}

}  // namespace

Result<Params, Problem> checked(const Params& params) {
  for (std::size_t i = 0; i < params.units.size(); ++i) {
    if (auto problem = illegal_unit(params.units[i], i)) return Unexpected{*problem};
  }
  if (auto problem = illegal(params.filter)) return Unexpected{*problem};
  if (auto problem = illegal(params.checks)) return Unexpected{*problem};
  if (auto problem = world::first_illegal(kRanges, params)) return Unexpected{*problem};
  if (auto problem = world::first_illegal(kGeometryRanges, params)) return Unexpected{*problem};
  if (auto problem = world::first_illegal(steering::kBicycleRanges, params.bicycle, "bicycle."))
    return Unexpected{*problem};
  return params;
}

}  // namespace pitwall::localization
