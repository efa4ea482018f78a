// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/modes.hpp"

#include <cmath>

namespace pitwall::tracking {
namespace {

using Shares = std::array<double, kModes>;
static_assert(kModes == 3);

// Which maneuver a car begins.
Shares choice(const RoadParams& p) {
  return {0.0, p.speed_change_share, 1.0 - p.speed_change_share};
}

// Second moments of every mode about x.
std::array<RoadMatrix, kModes> moments_of(const Modes& m) {
  std::array<RoadMatrix, kModes> moments;
  for (std::size_t k = 0; k < kModes; ++k)
    for (std::size_t i = 0; i < kRoadStates; ++i)
      for (std::size_t j = 0; j < kRoadStates; ++j)
        moments[k][i][j] = m.p[k][i][j] + m.apart[k][i] * m.apart[k][j];
  return moments;
}

RoadVector mean_of(const Modes& m, const Shares& share) {
  RoadVector mean{};
  for (std::size_t k = 0; k < kModes; ++k)
    for (std::size_t i = 0; i < kRoadStates; ++i) mean[i] += share[k] * m.apart[k][i];
  return mean;
}

}  // namespace

// Times of exponential lengths. Steady or not is a process with two states; which maneuver it is
// changes only by a steady time between two.
ModeChange mode_change(const RoadParams& p, double dt_s) {
  const double ended = -std::expm1(-dt_s / p.maneuver_s);  // once at least
  const double share = -std::expm1(-dt_s * (1.0 / p.steady_s + 1.0 / p.maneuver_s));
  const double both_s = p.steady_s + p.maneuver_s;
  const double to_maneuver = share * p.maneuver_s / both_s;
  const double to_steady = share * p.steady_s / both_s;
  const Shares begun = choice(p);
  ModeChange c{};
  c[kSteady][kSteady] = 1.0 - to_maneuver;
  for (const std::size_t one : {kSpeedChange, kLaneChange}) {
    c[kSteady][one] = to_maneuver * begun[one];
    c[one][kSteady] = to_steady;
    for (const std::size_t other : {kSpeedChange, kLaneChange})
      c[one][other] = (ended - to_steady) * begun[other] + (one == other ? 1.0 - ended : 0.0);
  }
  return c;
}

void begin_modes(const RoadParams& params, Track& track) {
  const double maneuver = params.maneuver_s / (params.steady_s + params.maneuver_s);
  track.modes.share = choice(params);
  for (double& share : track.modes.share) share *= maneuver;
  track.modes.share[kSteady] = 1.0 - maneuver;
  track.modes.apart = {};
  for (RoadMatrix& p : track.modes.p)
    for (std::size_t i = 0; i < kRoadStates; ++i)
      for (std::size_t j = 0; j < kRoadStates; ++j) p[i][j] = track.p[i][j];
}

void mix_modes(const ModeChange& change, Modes& m) {
  const std::array<RoadMatrix, kModes> moments = moments_of(m);
  Shares after;
  std::array<RoadVector, kModes> mean;
  for (std::size_t to = 0; to < kModes; ++to) {
    Shares share;
    for (std::size_t k = 0; k < kModes; ++k) share[k] = m.share[k] * change[k][to];
    after[to] = share[0] + share[1] + share[2];
    for (double& one : share) one /= after[to];
    mean[to] = mean_of(m, share);
    for (std::size_t i = 0; i < kRoadStates; ++i)
      for (std::size_t j = 0; j < kRoadStates; ++j)
        m.p[to][i][j] = share[0] * moments[0][i][j] + share[1] * moments[1][i][j] +
                        share[2] * moments[2][i][j] - mean[to][i] * mean[to][j];
  }
  m.share = after, m.apart = mean;
}

void centre_modes(Track& track) {
  const RoadVector shift = mean_of(track.modes, track.modes.share);
  for (std::size_t i = 0; i < kRoadStates; ++i) {
    track.x[i] += shift[i];
    for (RoadVector& apart : track.modes.apart) apart[i] -= shift[i];
  }
}

void join_modes(Track& track) {
  const Modes& m = track.modes;
  const std::array<RoadMatrix, kModes> moments = moments_of(m);
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t j = 0; j < kRoadStates; ++j)
      track.p[i][j] = m.share[0] * moments[0][i][j] + m.share[1] * moments[1][i][j] +
                      m.share[2] * moments[2][i][j];
}

}  // namespace pitwall::tracking
