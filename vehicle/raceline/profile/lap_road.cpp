// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/profile/lap_road.hpp"

#include "protocol/vocabulary/text.hpp"

namespace pitwall::raceline {

std::vector<RoadStep> road_of(const Raceline& line, const Lanes& lanes) {
  std::vector<RoadStep> road;
  road.reserve(line.points.size());
  double station_m = 0.0;
  for (const RacelinePoint& p : line.points) {
    RoadStep step{
        .curvature_per_m = p.curvature_per_m, .bank_rad = p.bank_rad, .step_m = line.spacing_m()};
    if (line.region == Region::kPitLane) {
      station_m = lanes.track().project(p.x_m, p.y_m, station_m).s_m;
      if (lanes.along_pit(station_m)) step.cap_mps = lanes.track().pit()->speed_limit_mps;
    }
    road.push_back(step);
  }
  return road;
}

std::optional<Problem> add_laps(RacelineBank& bank, const Lanes& lanes,
                                const envelope::EnvelopeTable& table) {
  LapProfile profile{table};
  for (Raceline& line : bank.lines) {
    if (!line.lap.empty()) continue;
    const std::vector<RoadStep> road = road_of(line, lanes);
    line.lap.resize(road.size());
    const LapOutcome outcome = profile.solve(road, line.lap);
    if (outcome.stuck) {
      const double s_m = line.spacing_m() * static_cast<double>(*outcome.stuck);
      return Problem{
          formatted("%s: s = %.1f m", line.name.c_str(), s_m),
          formatted("no speed carries the car there: curvature %.5f 1/m, bank %.1f deg",
                    road[*outcome.stuck].curvature_per_m, to_deg(road[*outcome.stuck].bank_rad))};
    }
    line.lap_s = outcome.lap_s;
  }
  return std::nullopt;
}

}  // namespace pitwall::raceline
