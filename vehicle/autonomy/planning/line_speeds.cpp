// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/line_speeds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vehicle/envelope/lap_profile.hpp"

namespace pitwall::planning {
namespace {

constexpr double kShareOff = 1e-6;  // a bank's file rounds its share

std::vector<envelope::RoadStep> road_of(const Line& line) {
  std::vector<envelope::RoadStep> road;
  road.reserve(line.points.size());
  for (const LinePoint& p : line.points)
    road.push_back(
        {.curvature_per_m = p.curvature_per_m, .bank_rad = p.bank_rad, .step_m = line.spacing_m});
  return road;
}

// The bank's speeds hold for its tyres and for colder ones.
void limit_to_bank(const std::optional<BankLap>& bank, double share,
                   std::vector<envelope::RoadStep>& road) {
  const bool holds = bank && !bank->line.lap.empty() && share <= bank->tyre_share + kShareOff;
  for (std::size_t i = 0; i < road.size(); ++i)
    road[i].cap_mps = holds ? bank->line.lap[i].speed_mps : envelope::kNoCap_mps;
}

}  // namespace

envelope::EnvelopeParams envelope_of(const LineParams& params, const world::TrackMap& track,
                                     const std::optional<envelope::SteeringLimit>& steering) {
  double bank_rad = 0.0;
  for (std::size_t i = 0; i < track.size(); ++i)
    bank_rad = std::max(bank_rad, std::abs(track.point(i).bank_rad));
  return {.friction = params.friction,
          .grip_share = params.grip_share,
          .speed_max_mps = params.speed_max_mps,
          .bank_most_rad = bank_rad,
          .steering = steering};
}

void add_speeds(const envelope::EnvelopeParams& car, const std::optional<BankLap>& of_bank,
                Line& line) {
  std::vector<envelope::RoadStep> road = road_of(line);
  std::vector<world::LapPoint> lap(road.size());
  const auto& shares = car.friction.tyres.share;
  for (std::size_t row = 0; row < world::kTyreRows; ++row) {
    envelope::EnvelopeParams on_row = car;
    on_row.friction.friction *= shares[row];
    const envelope::EnvelopeTable table{on_row};
    limit_to_bank(of_bank, shares[row], road);
    const envelope::LapOutcome outcome = envelope::LapProfile{table}.solve(road, lap);
    line.lap_s[row] = outcome.lap_s;
    for (std::size_t i = 0; i < lap.size(); ++i)
      line.points[i].speed_mps[row] = outcome.stuck ? 0.0 : lap[i].speed_mps;
  }
}

}  // namespace pitwall::planning
