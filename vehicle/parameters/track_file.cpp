// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/track_file.hpp"

#include "protocol/vocabulary/units.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::parameters {
namespace {

// What a track on this planet can be; TrackMap::build() checks the rest.
constexpr double kLengthMax_m = 50'000.0, kHeightMax_m = 9'000.0, kMapMax_m = 100'000.0;
constexpr double kCurvatureMax_per_m = 0.5, kWidthMax_m = 200.0, kSpeedMax_mps = 120.0;

world::TrackKnot read_knot(yaml::StrictMap& m) {
  return {
      .s_m = m.number("s_m", 0.0, kLengthMax_m),
      .curvature_per_m = m.number("curvature_per_m", -kCurvatureMax_per_m, kCurvatureMax_per_m),
      .bank_rad = from_deg(m.number("bank_deg", -45.0, 45.0)),
      .width_left_m = m.number("width_left_m", 0.0, kWidthMax_m),
      .width_right_m = m.number("width_right_m", 0.0, kWidthMax_m),
  };
}

world::PitLane read_pit(yaml::StrictMap& m) {
  return {
      .entry_s_m = m.number("entry_s_m", 0.0, kLengthMax_m),
      .exit_s_m = m.number("exit_s_m", 0.0, kLengthMax_m),
      .offset_m = m.number("offset_m", -kWidthMax_m, kWidthMax_m),
      .width_m = m.number("width_m", 0.0, kWidthMax_m),
      .speed_limit_mps = m.number("speed_limit_mps", 0.0, kSpeedMax_mps),
      .box_s_m = m.number_or("box_s_m", kUnset, 0.0, kLengthMax_m),
  };
}

}  // namespace

Result<world::TrackDescription, Problem> read_track(std::string_view text,
                                                    const std::string& name) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, [&](yaml::StrictMap& root) {
    world::TrackDescription track;
    track.source = name;
    track.name = root.text("name");
    track.length_m = root.number("length_m", 1.0, kLengthMax_m);
    yaml::StrictMap datum = root.map("datum");
    track.datum_latitude_deg = datum.number("latitude_deg", -90.0, 90.0);
    track.datum_longitude_deg = datum.number("longitude_deg", -180.0, 180.0);
    track.datum_height_m = datum.number("height_m", -kHeightMax_m, kHeightMax_m);
    yaml::StrictMap start = root.map("start");
    track.start_x_m = start.number("x_m", -kMapMax_m, kMapMax_m);
    track.start_y_m = start.number("y_m", -kMapMax_m, kMapMax_m);
    track.start_yaw_rad = from_deg(start.number("yaw_deg", -360.0, 360.0));
    if (auto pit = root.optional_map("pit")) track.pit = read_pit(*pit);
    for (yaml::StrictMap& knot : root.maps("knots")) track.knots.push_back(read_knot(knot));
    return track;
  });
}

}  // namespace pitwall::parameters
