// The tangent plane of the track: WGS 84 to Map (x east, y north, metres, z up).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <optional>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::localization {

struct MapPoint {
  double x_m, y_m, z_m;
};

class Datum {
 public:
  // Refused: latitude beyond 90 degrees, longitude beyond 180, anything not finite.
  static Result<Datum, Problem> at(double latitude_deg, double longitude_deg, double height_m);

  // Nothing for coordinates that are not on the Earth. An unset height counts as the datum's.
  std::optional<MapPoint> to_map(double latitude_deg, double longitude_deg, double height_m) const;

 private:
  explicit Datum(GeographicLib::LocalCartesian plane, double height_m)
      : plane_(plane), height_m_(height_m) {}
  GeographicLib::LocalCartesian plane_;
  double height_m_;
};

}  // namespace pitwall::localization
