// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/road_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vehicle/autonomy/tracking/filter/association.hpp"
#include "vehicle/autonomy/tracking/filter/life.hpp"
#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"
#include "vehicle/autonomy/tracking/filter/reidentification.hpp"

namespace pitwall::tracking {
namespace {

using world::DetectionSource;
using world::TrackMap;

constexpr double kTrialCost = 1e3;  // a confirmed track has the first choice
// A detection this many gates away from a track without another one is no new car.
constexpr double kNearGates = 2.0;
constexpr double kBackwards_mps = 2.0;     // faster than that a car does not roll back
constexpr double kPlaneHeading_rad = 0.6;  // without map and box: about our own direction

// What the gates of a frame found; reused for the updates.
struct Gates {
  std::array<Expectation, kTracksMax> expected;
  std::array<Position, kTracksMax> place;
  std::array<Innovation, kMeasurementsMax> reading;
  std::array<std::array<bool, kMeasurementsMax>, kTracksMax> near;
  Costs costs;
};

double gate_of(const RoadParams& p, std::size_t values) {
  return values == 1 ? p.gate_1 : values == 2 ? p.gate_2 : p.gate_3;
}

void judge_lost(std::size_t detections, std::size_t t, Gates& g) {
  for (std::size_t d = 0; d < detections; ++d)
    g.near[t][d] = false, g.costs.cost[t][d] = Costs::kOutside;
}

// The gates are those of a car that has begun a maneuver: the mean of the modes would shut it out
// after a gap, since it is one normal distribution.
void judge_seen(const RoadParams& params, const Frame& frame, const Place& place,
                const Track& track, std::size_t t, Gates& g) {
  g.expected[t] = expectation_of(frame.key.source, frame.own, place);
  const Spread spread = spread_of(g.expected[t], kLaneChange, track.modes);
  for (std::size_t d = 0; d < frame.measurements.size(); ++d) {
    const Innovation in = innovation_of(frame.key.source, g.reading[d], g.expected[t]);
    const double gate = gate_of(params, in.size);
    const Distance distance = distance_of(spread, in, kNearGates * gate);
    g.near[t][d] = distance.square <= kNearGates * gate;
    g.costs.cost[t][d] = distance.square <= gate ? distance.square + distance.log_det +
                                                       (track.confirmed ? 0.0 : kTrialCost)
                                                 : Costs::kOutside;
  }
}

void judge_pairs(const RoadParams& params, const TrackMap* map, const Frame& frame,
                 const Tracks& tracks, Gates& g) {
  g.costs.tracks = tracks.list.size(), g.costs.detections = frame.measurements.size();
  for (std::size_t d = 0; d < frame.measurements.size(); ++d)
    g.reading[d] = reading_of(params, frame.key, frame.own, frame.measurements[d]);
  for (std::size_t t = 0; t < tracks.list.size(); ++t) {
    const Track& track = tracks.list[t];
    const Place place = place_of(map, track.x);
    g.place[t] = {place.x_m, place.y_m};
    if (is_lost(frame, track))
      judge_lost(frame.measurements.size(), t, g);
    else
      judge_seen(params, frame, place, track, t, g);
  }
}

void average_size(const RoadParams& params, const Measurement& m, Track& track) {
  const double length_m = m.value[3], width_m = m.value[4];
  if (!std::isfinite(length_m) || !std::isfinite(width_m)) return;
  ++track.sizes;
  const double share = std::max(1.0 / static_cast<double>(track.sizes), params.size_share);
  if (track.sizes == 1) track.length_m = length_m, track.width_m = width_m;
  track.length_m += share * (length_m - track.length_m);
  track.width_m += share * (width_m - track.width_m);
}

// The box that began the track was turned around.
void turn_around(Track& track) {
  if (track.x[kSpeed] > -kBackwards_mps) return;
  track.x[kHeading] = wrap_pi(track.x[kHeading] + std::numbers::pi);
  for (const std::size_t i : {kSpeed, kAccel}) {
    track.x[i] = -track.x[i];
    for (RoadVector& apart : track.modes.apart) apart[i] = -apart[i];
    for (RoadMatrix& p : track.modes.p)
      for (std::size_t j = 0; j < kRoadStates; ++j) {
        p[i][j] = -p[i][j];
        p[j][i] = -p[j][i];
      }
  }
}

void update_track(const RoadParams& params, const TrackMap* map, const Frame& frame, const Gates& g,
                  const Expectation& expected, std::size_t d, Track& track) {
  update(expected, innovation_of(frame.key.source, g.reading[d], expected), map, track);
  if (map == nullptr) turn_around(track);
  if (frame.key.source == DetectionSource::kLidar)
    average_size(params, frame.measurements[d], track);
}

void update_tracks(const RoadParams& params, const TrackMap* map, const Frame& frame,
                   const Gates& g, const Assignment& a, Tracks& tracks) {
  for (std::size_t t = 0; t < g.costs.tracks; ++t) {
    Track& track = tracks.list[t];
    const std::size_t d = a.of_track[t];
    if (d == kNone) continue;
    update_track(params, map, frame, g, g.expected[t], d, track);
    note_detection(frame, d, track);
  }
}

// Whether a detection without a track belongs all the same to a car that is in sight.
bool is_known(const RoadParams& params, const Frame& frame, const Gates& g, const Assignment& a,
              const Tracks& tracks, std::size_t d, const Position& at) {
  for (std::size_t t = 0; t < g.costs.tracks; ++t) {
    if (!tracks.list[t].confirmed || is_lost(frame, tracks.list[t])) continue;
    if (a.of_track[t] == kNone && g.near[t][d]) return true;
    if (std::hypot(at.x_m - g.place[t].x_m, at.y_m - g.place[t].y_m) < params.apart_m) return true;
  }
  return false;
}

void begin_tracks(const RoadParams& params, const TrackMap* map, const Frame& frame, const Gates& g,
                  const Assignment& a, Tracks& tracks) {
  for (std::size_t d = 0; d < frame.measurements.size(); ++d) {
    if (a.of_detection[d] != kNone) continue;
    const std::optional<Track> track = first_track(params, map, frame, d);
    if (!track) continue;
    const Position at = position_of(frame.key.source, frame.own, frame.measurements[d]);
    if (!is_known(params, frame, g, a, tracks, d, at)) add_track(*track, tracks);
  }
}

// Covariance of the position in Map along and across the direction `yaw_rad`.
void set_position_covariance(const SightSigma& sight, double turn_rad, double left,
                             StateMatrix& p) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  const double along = sight.along_m * sight.along_m, across = sight.across_m * sight.across_m;
  p[kAlong][kAlong] = (c * c * along + s * s * across) / (left * left);
  p[kAcross][kAcross] = s * s * along + c * c * across;
  p[kAlong][kAcross] = p[kAcross][kAlong] = c * s * (along - across) / left;
}

// Direction of the box, turned to that of the road or of our car; without a box, about that.
void set_heading(const RoadParams& params, const TrackMap* map, const Frame& frame,
                 const Measurement& m, double road_rad, Track& track) {
  const bool box = frame.key.source == DetectionSource::kLidar && std::isfinite(m.value[2]);
  const double likely_rad = map != nullptr ? road_rad : frame.own.yaw_rad;
  const double turned_rad =
      box ? std::remainder(frame.own.yaw_rad + m.value[2] - likely_rad, std::numbers::pi) : 0.0;
  const double guess_rad = map != nullptr ? params.start_heading_sigma_rad : kPlaneHeading_rad;
  const double sigma_rad = box ? params.lidar_yaw_sigma_rad : guess_rad;
  track.x[kHeading] = wrap_pi(likely_rad - road_rad + turned_rad);
  track.p[kHeading][kHeading] = sigma_rad * sigma_rad;
}

// The range rate is the first that is known of the speed.
void use_range_rate(const RoadParams& params, const TrackMap* map, const Frame& frame,
                    const Measurement& m, Track& track) {
  const Expectation e = expectation_of(DetectionSource::kRadar, frame.own, place_of(map, track.x));
  const Innovation all =
      innovation_of(DetectionSource::kRadar, reading_of(params, frame.key, frame.own, m), e);
  if (all.size < kValuesMax) return;
  Expectation rate;
  rate.jacobian[0] = e.jacobian[2];
  Innovation in{.size = 1};
  in.value[0] = all.value[2], in.variance[0] = all.variance[2];
  update(rate, in, map, track);
}

}  // namespace

void filter_road(const RoadParams& params, const TrackMap* map, Duration coast_for,
                 const Frame& frame, Tracks& tracks) {
  const Duration known_for = std::max(coast_for, from_seconds(params.remembered_s));
  end_unseen(frame, known_for, tracks);
  make_room(frame, coast_for, tracks);
  if (tracks.started) coast(params, map, frame.key.at - tracks.at, tracks);
  tracks.started = true;
  tracks.at = frame.key.at;
  Gates g;
  judge_pairs(params, map, frame, tracks, g);
  const Assignment a = assign(g.costs, Search::kBestTwo);
  update_tracks(params, map, frame, g, a, tracks);
  begin_tracks(params, map, frame, g, a, tracks);
  end_tracks(frame, known_for, tracks);
  identify(params, map, coast_for, frame, tracks);
}

std::optional<Track> first_track(const RoadParams& params, const TrackMap* map, const Frame& frame,
                                 std::size_t index) {
  const DetectionSource source = frame.key.source;
  const OwnMotion& own = frame.own;
  const Measurement& m = frame.measurements[index];
  const Position at = position_of(source, own, m);
  if (!std::isfinite(at.x_m) || !std::isfinite(at.y_m)) return std::nullopt;
  Track track;
  note_first(frame, index, track);
  track.undecided = true;
  double road_rad = 0.0, left = 1.0;  // direction of the first state, and its scale
  track.x[kAlong] = at.x_m, track.x[kAcross] = at.y_m;
  if (map != nullptr) {
    const world::Curvilinear c = station_of(*map, own, at);
    const world::TrackPoint line = map->at(c.s_m);
    track.x[kAlong] = c.s_m, track.x[kAcross] = c.n_m;
    road_rad = line.yaw_rad;
    left = 1.0 - line.curvature_per_m * c.n_m;
  }
  set_heading(params, map, frame, m, road_rad, track);
  const double sight_rad = std::atan2(at.y_m - own.y_m, at.x_m - own.x_m);
  const double distance_m = std::hypot(at.x_m - own.x_m, at.y_m - own.y_m);
  set_position_covariance(sight_sigma(params, frame.key, m, distance_m), sight_rad - road_rad, left,
                          track.p);
  track.x[kSpeed] = std::hypot(own.vx_mps, own.vy_mps);
  track.p[kSpeed][kSpeed] = params.start_speed_sigma_mps * params.start_speed_sigma_mps;
  track.p[kAccel][kAccel] = params.accel_sigma_mps2 * params.accel_sigma_mps2;
  const double turn_sigma =
      map != nullptr ? params.turn_sigma_rad_per_s : params.plane_turn_sigma_rad_per_s;
  track.p[kTurn][kTurn] = turn_sigma * turn_sigma;
  begin_modes(params, track);
  if (source == DetectionSource::kLidar) average_size(params, m, track);
  if (source == DetectionSource::kRadar) use_range_rate(params, map, frame, m, track);
  return track;
}

world::Opponent road_opponent(const TrackMap* map, const Track& track) {
  const Place p = place_of(map, track.x);
  world::Opponent car{.x_m = p.x_m, .y_m = p.y_m, .yaw_rad = p.yaw_rad, .speed_mps = p.speed_mps};
  car.accel_mps2 = track.x[kAccel];
  car.yaw_rate_rad_per_s = track.x[kTurn];
  if (map != nullptr) {
    car.s_m = track.x[kAlong], car.n_m = track.x[kAcross];
    car.yaw_rate_rad_per_s += road_turn_of(p.curvature_per_m, track.x);
  }
  car.length_m = track.length_m, car.width_m = track.width_m;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<double, 4> row{};  // of J P
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l) row[l] += p.jacobian[i][k] * track.p[k][l];
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t l = 0; l < 4; ++l) car.covariance[4 * i + j] += row[l] * p.jacobian[j][l];
  }
  car.born_at = track.born_at;
  car.measured_at = track.newest.frame.at;
  car.confidence = track.confidence;
  return car;
}

}  // namespace pitwall::tracking
