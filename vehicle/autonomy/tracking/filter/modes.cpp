// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/modes.hpp"

#include <cmath>

namespace pitwall::tracking {
namespace {

// Covariance of a mixture of both modes.
template <class Matrix>
void mix(const Modes& m, double maneuver, Matrix& out) {
  const double steady = 1.0 - maneuver, between = maneuver * steady;
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t j = 0; j < kRoadStates; ++j)
      out[i][j] = steady * m.p[kSteady][i][j] + maneuver * m.p[kManeuver][i][j] +
                  between * m.apart[i] * m.apart[j];
}

}  // namespace

// A process with two states whose times have exponential lengths.
ModeChange mode_change(const RoadParams& p, double dt_s) {
  const double share = -std::expm1(-dt_s * (1.0 / p.steady_s + 1.0 / p.maneuver_s));
  const double both_s = p.steady_s + p.maneuver_s;
  return {.to_maneuver = share * p.maneuver_s / both_s, .to_steady = share * p.steady_s / both_s};
}

void begin_modes(const RoadParams& params, Track& track) {
  track.modes.maneuver = params.maneuver_s / (params.steady_s + params.maneuver_s);
  track.modes.apart = {};
  for (RoadMatrix& p : track.modes.p)
    for (std::size_t i = 0; i < kRoadStates; ++i)
      for (std::size_t j = 0; j < kRoadStates; ++j) p[i][j] = track.p[i][j];
}

void mix_modes(const ModeChange& change, Modes& m) {
  const Modes from = m;
  const double stays = (1.0 - change.to_steady) * from.maneuver;
  const double ends = change.to_steady * from.maneuver;
  m.maneuver = stays + change.to_maneuver * (1.0 - from.maneuver);
  const double of_maneuver = stays / m.maneuver, of_steady = ends / (1.0 - m.maneuver);
  mix(from, of_steady, m.p[kSteady]);
  mix(from, of_maneuver, m.p[kManeuver]);
  for (double& apart : m.apart) apart *= of_maneuver - of_steady;
}

void join_modes(Track& track) { mix(track.modes, track.modes.maneuver, track.p); }

}  // namespace pitwall::tracking
