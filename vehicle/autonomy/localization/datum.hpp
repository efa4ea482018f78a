// Tangent plane of the track: conversion from WGS 84 to Map (x east, y north, z up, metres).
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
  // Returns a Problem for a latitude beyond 90 degrees, a longitude beyond 180, or a value that is
  // not finite.
  static Result<Datum, Problem> at(double latitude_deg, double longitude_deg, double height_m);

  // Returns nullopt for coordinates that are not on the Earth. An unset height counts as the height
  // of the datum.
  std::optional<MapPoint> to_map(double latitude_deg, double longitude_deg, double height_m) const;

 private:
  explicit Datum(GeographicLib::LocalCartesian plane, double height_m)
      : plane_(plane), height_m_(height_m) {}
  GeographicLib::LocalCartesian plane_;
  double height_m_;
};

}  // namespace pitwall::localization
