// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/datum.hpp"

#include <cmath>

namespace pitwall::localization {
namespace {

bool on_earth(double latitude_deg, double longitude_deg) {
  return std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 180.0;  // NaN is not
}

}  // namespace

Result<Datum, Problem> Datum::at(double latitude_deg, double longitude_deg, double height_m) {
  if (!on_earth(latitude_deg, longitude_deg) || !std::isfinite(height_m)) {
    return Unexpected{Problem{"datum", "latitude, longitude or height is not on the Earth"}};
  }
  return Datum{GeographicLib::LocalCartesian(latitude_deg, longitude_deg, height_m), height_m};
}

std::optional<MapPoint> Datum::to_map(double latitude_deg, double longitude_deg,
                                      double height_m) const {
  if (!on_earth(latitude_deg, longitude_deg)) return std::nullopt;
  MapPoint p{};
  plane_.Forward(latitude_deg, longitude_deg, std::isfinite(height_m) ? height_m : height_m_, p.x_m,
                 p.y_m, p.z_m);
  return p;
}

}  // namespace pitwall::localization
