// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/tracking_summary.hpp"

#include "protocol/json/json_text.hpp"

namespace pitwall::io {

std::string tracking_json(const tracking::Counters& counters, const world::Opponents& opponents) {
  json::Array cars;
  for (const world::Opponent& car : opponents.cars) {
    cars.json(json::Object{}
                  .number("id", car.id)
                  .number("x_m", car.x_m)
                  .number("y_m", car.y_m)
                  .number("speed_mps", car.speed_mps)
                  .number("position_sigma_m", world::position_sigma_m(car))
                  .number("unmeasured_s", (opponents.at - car.measured_at).seconds())
                  .str());
  }
  return json::Object{}
      .number("frames", counters.frames)
      .number("detections", counters.detections)
      .number("frames_in_future", counters.frames_in_future)
      .number("frames_too_old", counters.frames_too_old)
      .number("frames_repeated", counters.frames_repeated)
      .number("frames_too_many", counters.frames_too_many)
      .number("frames_unplaced", counters.frames_unplaced)
      .number("frames_unknown", counters.frames_unknown)
      .number("frames_excluded", counters.frames_excluded)
      .number("not_finite", counters.not_finite)
      .number("low_confidence", counters.low_confidence)
      .number("in_own_car", counters.in_own_car)
      .number("off_track", counters.off_track)
      .number("too_far", counters.too_far)
      .number("too_many", counters.too_many)
      .json("cars", cars.str())
      .str();
}

}  // namespace pitwall::io
