// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/tracking_run.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "hil/sensors/gauss_markov.hpp"
#include "tests/benchmarks/tracking/clear_mot.hpp"
#include "tests/benchmarks/tracking/ellipsoid.hpp"

namespace pitwall::tracking_bench {
namespace {

using plant::CarPose;
using world::EgoState, world::Opponent, world::Opponents;

constexpr Duration kTick = milliseconds(10), kDt = milliseconds(2);
constexpr int kScoredEvery = 5;  // ticks
constexpr std::uint64_t kOwnStream = 1;

// Our own car as localization has it.
class OwnView {
 public:
  OwnView(const OwnError& error, std::uint64_t seed) : sigma_(error), noise_(seed, kOwnStream) {
    wander_.begin(noise_);
  }

  EgoState at(Instant now, const CarPose& car, const Motion& motion) {
    wander_.advance(noise_, kTick.seconds(), sigma_.correlation_s);
    const auto& w = wander_.value;
    EgoState ego;
    ego.at = now, ego.validity = world::Validity::kGood;
    ego.x_m = car.x_m + sigma_.position_sigma_m * w[0];
    ego.y_m = car.y_m + sigma_.position_sigma_m * w[1];
    ego.yaw_rad = wrap_pi(car.yaw_rad + sigma_.yaw_sigma_rad * w[2]);
    ego.vx_mps = motion.speed_mps + sigma_.speed_sigma_mps * w[3], ego.vy_mps = 0.0;
    const double turned_rad = has_last_ ? wrap_pi(car.yaw_rad - last_yaw_rad_) : 0.0;
    ego.yaw_rate_rad_per_s = turned_rad / kTick.seconds();
    ego.ax_mps2 = motion.accel_mps2, ego.ay_mps2 = ego.vx_mps * ego.yaw_rate_rad_per_s;
    ego.position_sigma_m = sigma_.position_sigma_m, ego.yaw_sigma_rad = sigma_.yaw_sigma_rad;
    last_yaw_rad_ = car.yaw_rad, has_last_ = true;
    return ego;
  }

 private:
  OwnError sigma_;
  sensors::Noise noise_;
  sensors::GaussMarkov<4> wander_;
  double last_yaw_rad_ = 0.0;
  bool has_last_ = false;
};

struct Moment {
  CarPose ours;
  std::vector<CarPose> others;

  sensors::TrueCars cars() const { return {ours, others}; }
};

struct Offset {
  double along_m = 0.0, across_m = 0.0;
};

Offset in_body(double x_m, double y_m, double from_x_m, double from_y_m, double yaw_rad) {
  const double dx_m = x_m - from_x_m, dy_m = y_m - from_y_m;
  return {dx_m * std::cos(yaw_rad) + dy_m * std::sin(yaw_rad),
          dy_m * std::cos(yaw_rad) - dx_m * std::sin(yaw_rad)};
}

// Error of a track in our car's axes.
struct TrackError {
  double along_m = 0.0, across_m = 0.0, yaw_rad = 0.0, speed_mps = 0.0, in_map_m = 0.0;
  double distance_m = 0.0;

  double position_m() const { return std::hypot(along_m, across_m); }
};

TrackError error_of(const Opponent& track, const CarPose& car, const EgoState& ego,
                    const CarPose& ours) {
  const Offset known = in_body(track.x_m, track.y_m, ego.x_m, ego.y_m, ego.yaw_rad);
  const Offset is = in_body(car.x_m, car.y_m, ours.x_m, ours.y_m, ours.yaw_rad);
  return {.along_m = known.along_m - is.along_m,
          .across_m = known.across_m - is.across_m,
          .yaw_rad = wrap_pi(track.yaw_rad - ego.yaw_rad - (car.yaw_rad - ours.yaw_rad)),
          .speed_mps = track.speed_mps - std::hypot(car.vx_mps, car.vy_mps),
          .in_map_m = std::hypot(track.x_m - car.x_m, track.y_m - car.y_m),
          .distance_m = std::hypot(is.along_m, is.across_m)};
}

// In Map, where the covariance is, without the error of our own place.
double nees_of(const TrackError& e, const Opponent& track, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return squared_distance<4>(
      {c * e.along_m - s * e.across_m, s * e.along_m + c * e.across_m, e.yaw_rad, e.speed_mps},
      track.covariance);
}

class Scorer {
 public:
  Scorer(const Scene& scene, TrackingRow& row)
      : scene_(&scene), row_(&row), seen_(scene.traffic.others.size()) {}

  void score(const Moment& moment, const EgoState& ego, const Opponents& known, Instant now) {
    note_sight(moment, now);
    if ((now - Instant{}).seconds() < kWarmUp_s) return;
    std::vector<Spot> objects, tracks;
    for (std::size_t i = 0; i < moment.others.size(); ++i) {
      const CarPose& car = moment.others[i];
      const double distance_m = std::hypot(car.x_m - moment.ours.x_m, car.y_m - moment.ours.y_m);
      const bool is_required = distance_m <= kRequired_m && seen_[i].since_s < kInSight_s;
      const auto id = static_cast<std::uint32_t>(i);
      if (seen_[i].since_s > kForgotten_s && !seen_[i].is_forgotten) {
        mot_.let_go(id);
        seen_[i].is_forgotten = true;
        ++row_->reborn;
      }
      objects.push_back({id, car.x_m, car.y_m, is_required});
    }
    std::vector<Opponent> claimed;
    std::ranges::copy_if(known.cars, std::back_inserter(claimed), [now](const Opponent& track) {
      return (now - track.measured_at).seconds() <= kClaimed_s;
    });
    for (const Opponent& track : claimed) tracks.push_back({track.id, track.x_m, track.y_m});
    for (const SpotPair& pair : mot_.add(objects, tracks)) {
      const Opponent& track = claimed[pair.track];
      const bool is_settled = (now - track.born_at).seconds() >= kSettled_s;
      if (seen_[pair.object].since_s < kInSight_s && is_settled)
        add_error(error_of(track, moment.others[pair.object], ego, moment.ours), track, ego);
    }
    for (const std::uint32_t car : mot_.switched()) row_->switches_hidden += was_hidden(car);
    row_->objects = mot_.objects(), row_->misses = mot_.misses();
    row_->false_tracks = mot_.false_tracks(), row_->switches = mot_.switches();
    row_->mota = mot_.mota();
  }

  // All sensors have been blind since blind_for.
  void end_of_blindness(const Moment& moment, const EgoState& ego, const Opponents& known) {
    for (const CarPose& car : moment.others) {
      std::optional<double> nearest_m;
      for (const Opponent& track : known.cars) {
        const double d_m = error_of(track, car, ego, moment.ours).position_m();
        if (!nearest_m || d_m < *nearest_m) nearest_m = d_m;
      }
      ++row_->blind_times;
      if (!nearest_m) ++row_->blind_lost;
      row_->blind_worst_m = std::max(row_->blind_worst_m, nearest_m.value_or(0.0));
    }
  }

 private:
  struct Sight {
    double since_s = kForgotten_s;  // some LiDAR or camera could see it
    double unseen_s = kForgotten_s, hidden_s = 0.0,
           back_s = 0.0;  // by radars too: now, last, since
    double side = 0.0;    // ahead of us or behind
    bool is_forgotten = false;
  };

  bool was_hidden(std::uint32_t car) const {
    const Sight& sight = seen_[car];
    return sight.unseen_s > kHidden_s || (sight.hidden_s > kHidden_s && sight.back_s < kBack_s);
  }

  void note_sight(const Moment& moment, Instant now) {
    const double dt_s = kScoredEvery * kTick.seconds();
    for (std::size_t i = 0; i < moment.others.size(); ++i) {
      Sight& sight = seen_[i];
      sight.since_s += dt_s, sight.unseen_s += dt_s, sight.back_s += dt_s;
      for (const sensors::DetectionSensor& sensor : scene_->sensors) {
        if (!sensors::is_in_sight(sensor, moment.cars(), i)) continue;
        if (sight.unseen_s > kHidden_s) sight.hidden_s = sight.unseen_s, sight.back_s = 0.0;
        sight.unseen_s = 0.0;
        if (sensor.source == world::DetectionSource::kRadar) continue;
        sight.since_s = 0.0, sight.is_forgotten = false;
        break;
      }
      const CarPose& car = moment.others[i];
      const double ahead_m =
          in_body(car.x_m, car.y_m, moment.ours.x_m, moment.ours.y_m, moment.ours.yaw_rad).along_m;
      if (sight.side * ahead_m < 0.0 && now > Instant{}) ++row_->passes;
      sight.side = ahead_m;
    }
  }

  void add_error(const TrackError& e, const Opponent& track, const EgoState& ego) {
    row_->speed.add(e.speed_mps);
    const double nees = nees_of(e, track, ego.yaw_rad);
    row_->nees_sum += nees, ++row_->nees_count;
    if (nees <= kNees95) ++row_->nees_within_95;
    for (std::size_t i = 0; i + 1 < kDistances_m.size(); ++i) {
      if (e.distance_m < kDistances_m[i] || e.distance_m >= kDistances_m[i + 1]) continue;
      DistanceErrors& d = row_->by_distance[i];
      d.position.add(e.position_m()), d.along.add(e.along_m), d.across.add(e.across_m);
      d.in_map.add(e.in_map_m), d.speed.add(e.speed_mps), d.yaw.add(e.yaw_rad);
    }
  }

  const Scene* scene_;
  TrackingRow* row_;
  std::vector<Sight> seen_;
  ClearMot mot_{kGate_m};
};

bool is_blind(const Scene& scene, Instant at) {
  if (scene.blind_for.ns == 0) return false;
  const std::int64_t into_ns = (at - Instant{}).ns % scene.blind_every.ns;
  return into_ns >= scene.blind_every.ns - scene.blind_for.ns;
}

// Removes what was seen in blind times; counts frames that a younger one has overtaken.
void hand_over(const Scene& scene, sensors::Arrivals& arrived, Instant& newest, TrackingRow& row) {
  for (world::DetectionFrame& frame : arrived) {
    if (is_blind(scene, frame.at)) frame.detections.clear();
    ++row.frames;
    if (frame.at < newest) ++row.frames_overtaken;
    newest = std::max(newest, frame.at);
  }
}

class World {
 public:
  explicit World(const Scene& scene)
      : scene_(&scene),
        lanes_(las_vegas()),
        traffic_(scene.traffic, scene.seed),
        detections_(sensors::make_detections(scene.sensors, scene.seed, Instant{})) {
    moment_.others.resize(traffic_.size() - 1);
  }

  // Up to `now`; what arrives on the way.
  void advance(Instant now, sensors::Arrivals& arrived) {
    while (at_ < now) {
      traffic_.step(lanes_, kDt);
      at_ += kDt;
      place();
      sensors::step_detections(scene_->sensors, detections_, moment_.cars(), at_, arrived);
    }
  }
  const Moment& moment() const { return moment_; }
  const Motion& our_motion() const { return traffic_.motion(0); }

 private:
  void place() {
    moment_.ours = lanes_.placed(traffic_.motion(0));
    for (std::size_t i = 0; i < moment_.others.size(); ++i)
      moment_.others[i] = lanes_.placed(traffic_.motion(i + 1));
  }

  const Scene* scene_;
  RaceLanes lanes_;
  RaceTraffic traffic_;
  sensors::DetectionState detections_;
  Moment moment_;
  Instant at_{};
};

}  // namespace

TrackingRow run_tracking(const Scene& scene, const tracking::Params& params, const Watch& watch) {
  TrackingRow row;
  row.scene = scene.name;
  row.method = tracking::kMethodNames[static_cast<std::size_t>(params.method)];
  World world(scene);
  OwnView own(scene.own, scene.seed);
  Scorer scorer(scene, row);
  const auto state = std::make_unique<tracking::State>();
  Instant newest{};
  int tick = 0;
  for (Instant now = Instant{} + kTick; now <= Instant{} + scene.span; now += kTick, ++tick) {
    sensors::Arrivals arrived;
    world.advance(now, arrived);
    hand_over(scene, arrived, newest, row);
    const EgoState ego = own.at(now, world.moment().ours, world.our_motion());
    const tracking::Inputs in{
        .frames = arrived.span(), .ego = ego, .track = &las_vegas(), .now = now};
    if (watch) watch(*state, in);
    const tracking::Output out = tracking::step(params, *state, in);
    row.frames_refused = row.frames - out.counters.frames;
    const bool blindness_ends = is_blind(scene, now - kTick) && !is_blind(scene, now);
    if (blindness_ends) scorer.end_of_blindness(world.moment(), ego, out.opponents);
    if (tick % kScoredEvery == 0) scorer.score(world.moment(), ego, out.opponents, now);
  }
  return row;
}

}  // namespace pitwall::tracking_bench
