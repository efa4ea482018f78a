// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/paper_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vehicle/autonomy/tracking/filter/association.hpp"
#include "vehicle/autonomy/tracking/filter/cholesky.hpp"
#include "vehicle/autonomy/tracking/filter/life.hpp"
#include "vehicle/autonomy/tracking/filter/measurement.hpp"

namespace pitwall::tracking {
namespace {

using world::DetectionSource;

constexpr std::size_t kBoxValues = 5;  // x, y, yaw, length, width: the first states
constexpr double kStanding_mps = 1.0;  // slower, the direction of motion is that of the box
using Box = std::array<double, kBoxValues>;

struct BoxDetection {
  std::size_t size = 0;  // 5, or 2 for a position alone
  Box value{};
};

BoxDetection box_of(const Frame& frame, const Measurement& m) {
  const Position at = position_of(frame.key.source, frame.own, m);
  BoxDetection box{.size = 2, .value = {at.x_m, at.y_m, 0.0, 0.0, 0.0}};
  if (frame.key.source != DetectionSource::kLidar || !std::isfinite(m.value[2]) ||
      !std::isfinite(m.value[3]) || !std::isfinite(m.value[4]))
    return box;
  box.size = kBoxValues;
  box.value[kYaw] = frame.own.yaw_rad + m.value[2];
  box.value[kLength] = m.value[3], box.value[kWidth] = m.value[4];
  return box;
}

Box residual_of(const BoxDetection& box, const Track& track) {
  Box residual{};
  for (std::size_t i = 0; i < box.size; ++i) residual[i] = box.value[i] - track.x[i];
  residual[kYaw] = std::remainder(residual[kYaw], std::numbers::pi);  // AB3DMOT turns the box
  return residual;
}

using BoxMatrix = std::array<Box, kBoxValues>;

// Of the upper left part of P, plus R.
BoxMatrix box_factor(const PaperParams& params, std::size_t size, const Track& track) {
  return factor<kBoxValues>(size, [&](std::size_t i, std::size_t j) {
    return track.p[i][j] + (i == j ? params.measurement_variance : 0.0);
  });
}

double box_distance(const PaperParams& params, const BoxDetection& box, const Track& track) {
  const Box y = solved(box_factor(params, box.size, track), box.size, residual_of(box, track));
  double sum = 0.0;
  for (std::size_t i = 0; i < box.size; ++i) sum += y[i] * y[i];
  return sum;
}

void update_box(const PaperParams& params, const BoxDetection& box, Track& track) {
  const BoxMatrix l = box_factor(params, box.size, track);
  const Box y = solved(l, box.size, residual_of(box, track));
  std::array<Box, kStates> gain{};
  for (std::size_t i = 0; i < kStates; ++i) {
    Box row{};
    std::copy_n(track.p[i].begin(), box.size, row.begin());
    gain[i] = solved(l, box.size, row);
  }
  for (std::size_t i = 0; i < kStates; ++i)
    for (std::size_t k = 0; k < box.size; ++k) {
      track.x[i] += gain[i][k] * y[k];
      for (std::size_t j = 0; j < kStates; ++j) track.p[i][j] -= gain[i][k] * gain[j][k];
    }
  track.x[kYaw] = wrap_pi(track.x[kYaw]);
  track.length_m = track.x[kLength], track.width_m = track.x[kWidth];
}

// A position alone begins a track too; the published detector's boxes all have a size.
Track first_box(const PaperParams& params, const Frame& frame, const BoxDetection& box,
                std::size_t index) {
  constexpr double kLengthGuess_m = 4.9, kWidthGuess_m = 1.9;  // AV-21
  Track track;
  note_first(frame, index, track);
  std::copy_n(box.value.begin(), kBoxValues, track.x.begin());
  if (box.size < kBoxValues)
    track.x[kYaw] = frame.own.yaw_rad, track.x[kLength] = kLengthGuess_m,
    track.x[kWidth] = kWidthGuess_m;
  for (std::size_t i = 0; i < kStates; ++i)
    track.p[i][i] = i < kBoxValues ? params.start_variance : params.start_speed_variance;
  track.length_m = track.x[kLength], track.width_m = track.x[kWidth];
  return track;
}

}  // namespace

void predict_paper(const PaperParams& params, double dt_s, Track& track) {
  StateMatrix& p = track.p;
  for (std::size_t i = 0; i < 2; ++i) track.x[i] += dt_s * track.x[kVx + i];
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < kStates; ++j) p[i][j] += dt_s * p[kVx + i][j];
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < kStates; ++j) p[j][i] += dt_s * p[j][kVx + i];
  const double share = dt_s / params.frame_s;
  for (std::size_t i = 0; i < kStates; ++i)
    p[i][i] +=
        share * (i < kBoxValues ? params.variance_per_frame : params.speed_variance_per_frame);
}

void filter_paper(const PaperParams& params, Duration coast, const Frame& frame, Tracks& tracks) {
  end_unseen(frame, coast, tracks);
  const bool newer = !tracks.started || frame.key.at > tracks.at;
  if (tracks.started && newer)
    for (Track& track : tracks.list)
      predict_paper(params, (frame.key.at - tracks.at).seconds(), track);
  if (newer) tracks.at = frame.key.at;
  tracks.started = true;
  Costs costs;
  costs.tracks = tracks.list.size(), costs.detections = frame.measurements.size();
  std::array<BoxDetection, kMeasurementsMax> boxes;
  for (std::size_t d = 0; d < costs.detections; ++d) {
    boxes[d] = box_of(frame, frame.measurements[d]);
    for (std::size_t t = 0; t < costs.tracks; ++t) {
      const double square = box_distance(params, boxes[d], tracks.list[t]);
      costs.cost[t][d] = square <= params.gate ? square : Costs::kOutside;
    }
  }
  const Assignment a = assign(costs, Search::kGreedy);
  for (std::size_t t = 0; t < costs.tracks; ++t) {
    if (a.of_track[t] == kNone) continue;
    update_box(params, boxes[a.of_track[t]], tracks.list[t]);
    note_detection(frame, a.of_track[t], tracks.list[t]);
  }
  for (std::size_t d = 0; d < costs.detections; ++d)
    if (a.of_detection[d] == kNone && std::isfinite(boxes[d].value[kX]))
      add_track(first_box(params, frame, boxes[d], d), tracks);
  end_tracks(frame, coast, tracks);
}

// Direction and speed are functions of vx, vy; on a standing car the direction is that of the box.
world::Opponent paper_opponent(const world::TrackMap* map, const Track& track) {
  const StateVector& x = track.x;
  const double speed_mps = std::hypot(x[kVx], x[kVy]);
  const bool moves = speed_mps > kStanding_mps;
  world::Opponent car{.x_m = x[kX],
                      .y_m = x[kY],
                      .yaw_rad = moves ? std::atan2(x[kVy], x[kVx]) : x[kYaw],
                      .speed_mps = speed_mps,
                      .accel_mps2 = 0.0,
                      .yaw_rate_rad_per_s = 0.0};
  if (map != nullptr) {
    const world::Curvilinear c = map->project(car.x_m, car.y_m);
    car.s_m = c.s_m, car.n_m = c.n_m;
  }
  car.length_m = track.length_m, car.width_m = track.width_m;
  const double cos_yaw = std::cos(car.yaw_rad), sin_yaw = std::sin(car.yaw_rad);
  std::array<StateVector, 4> jacobian{};
  jacobian[0][kX] = jacobian[1][kY] = 1.0;
  if (moves)
    jacobian[2][kVx] = -sin_yaw / speed_mps, jacobian[2][kVy] = cos_yaw / speed_mps;
  else
    jacobian[2][kYaw] = 1.0;
  jacobian[3][kVx] = cos_yaw, jacobian[3][kVy] = sin_yaw;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < kStates; ++k)
        for (std::size_t l = 0; l < kStates; ++l)
          sum += jacobian[i][k] * track.p[k][l] * jacobian[j][l];
      car.covariance[4 * i + j] = sum;
    }
  car.born_at = track.born_at;
  car.measured_at = track.newest.frame.at;
  car.confidence = track.confidence;
  return car;
}

}  // namespace pitwall::tracking
