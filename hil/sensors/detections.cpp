// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/detections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "hil/sensors/arrival.hpp"
#include "hil/sensors/streams.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::sensors {
namespace {

static_assert(std::is_trivially_copyable_v<DetectionState>);

using plant::CarPose;
using world::Detection, world::DetectionFrame, world::DetectionSource;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kAcross_m = 20.0;   // to either side: false LiDAR boxes lie on the road
constexpr int kBearings = 32;        // that are looked along to a car
constexpr double kNearest_m = 1e-3;  // of a car that stands on us

double at_range(const RangeTable& table, double range_m) {
  if (range_m <= table.front().range_m) return table.front().value;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const RangeRow &a = table[i - 1], &b = table[i];
    if (range_m > b.range_m) continue;
    return a.value + (b.value - a.value) * (range_m - a.range_m) / (b.range_m - a.range_m);
  }
  return table.back().value;
}

bool is_between(double angle_rad, const Sector& sector) {
  const auto turn = [&](double to_rad) {
    const double wrapped = std::fmod(to_rad - sector.from_rad, kTwoPi);
    return wrapped < 0.0 ? wrapped + kTwoPi : wrapped;
  };
  return turn(angle_rad) <= turn(sector.to_rad);
}

bool is_in_any(std::span<const Sector> sectors, double bearing_rad) {
  return std::ranges::any_of(sectors, [&](const Sector& s) { return is_between(bearing_rad, s); });
}

bool is_in_view(const View& view, double bearing_rad) {
  if (2.0 * std::abs(wrap_pi(bearing_rad - view.facing_rad)) > view.width_rad) return false;
  return !is_in_any(view.blind.span(), bearing_rad);
}

// Another car as our sensors have it.
struct Seen {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;  // Body
  double range_m = 0.0, bearing_rad = 0.0, half_rad = 0.0;
  double range_rate_mps = 0.0;
  double length_m = 0.0, width_m = 0.0;
};

struct Velocity {
  double east_mps = 0.0, north_mps = 0.0;
};

Velocity velocity_in_map(const CarPose& car) {
  const double c = std::cos(car.yaw_rad), s = std::sin(car.yaw_rad);
  return {c * car.vx_mps - s * car.vy_mps, s * car.vx_mps + c * car.vy_mps};
}

Seen seen_from(const CarPose& ours, const CarPose& car) {
  const double east_m = car.x_m - ours.x_m, north_m = car.y_m - ours.y_m;
  const double cos_yaw = std::cos(ours.yaw_rad), sin_yaw = std::sin(ours.yaw_rad);
  Seen s{.x_m = east_m * cos_yaw + north_m * sin_yaw,
         .y_m = north_m * cos_yaw - east_m * sin_yaw,
         .yaw_rad = wrap_pi(car.yaw_rad - ours.yaw_rad),
         .range_m = std::max(kNearest_m, std::hypot(east_m, north_m)),
         .length_m = car.length_m,
         .width_m = car.width_m};
  s.bearing_rad = std::atan2(s.y_m, s.x_m);
  const Velocity own = velocity_in_map(ours), its = velocity_in_map(car);
  s.range_rate_mps =
      ((its.east_mps - own.east_mps) * east_m + (its.north_mps - own.north_mps) * north_m) /
      s.range_m;
  // Half of the angle under which the corners of the box lie.
  for (const double along : {-0.5, 0.5}) {
    for (const double across : {-0.5, 0.5}) {
      const double a_m = along * s.length_m, b_m = across * s.width_m;
      const double x_m = s.x_m + a_m * std::cos(s.yaw_rad) - b_m * std::sin(s.yaw_rad);
      const double y_m = s.y_m + a_m * std::sin(s.yaw_rad) + b_m * std::cos(s.yaw_rad);
      s.half_rad = std::max(s.half_rad, std::abs(wrap_pi(std::atan2(y_m, x_m) - s.bearing_rad)));
    }
  }
  return s;
}

// Share of the bearings to a car along which no nearer one stands.
double visible_share(std::span<const Seen> all, const Seen& car) {
  int free = 0;
  for (int i = 0; i < kBearings; ++i) {
    const double share = (2.0 * i + 1.0) / kBearings - 1.0;
    const double bearing_rad = car.bearing_rad + share * car.half_rad;
    free += std::ranges::none_of(all, [&](const Seen& other) {
      return other.range_m < car.range_m &&
             std::abs(wrap_pi(bearing_rad - other.bearing_rad)) < other.half_rad;
    });
  }
  return static_cast<double>(free) / kBearings;
}

bool is_in_burst(const Bursts& bursts, BurstState& state, Instant now, Noise& noise) {
  if (!(bursts.per_s > 0.0)) return false;
  while (now >= state.until) {
    state.from = state.until + from_seconds(exponential(noise) / bursts.per_s);
    state.until = state.from + from_seconds(exponential(noise) * bursts.mean_s);
  }
  return now >= state.from;
}

// Knuth's method; the means are far below 1.
int poisson(double mean, Noise& noise) {
  const double least = std::exp(-mean);
  int n = 0;
  for (double product = noise.uniform(); product > least; product *= noise.uniform()) ++n;
  return n;
}

double between(double low, double high, Noise& noise) {
  return low + (high - low) * noise.uniform();
}

Detection box_of(const LidarNoise& errors, const Seen& car, Noise& noise) {
  const double sigma_m = at_range(errors.position_sigma_m, car.range_m);
  Detection d;
  d.x_m = car.x_m + sigma_m * noise.normal();
  d.y_m = car.y_m + sigma_m * noise.normal();
  d.yaw_rad = car.yaw_rad + errors.yaw_sigma_rad * noise.normal();
  if (noise.uniform() < errors.flip) d.yaw_rad += std::numbers::pi;
  d.yaw_rad = wrap_pi(d.yaw_rad);
  d.length_m = car.length_m + errors.length_sigma_m * noise.normal();
  d.width_m = car.width_m + errors.width_sigma_m * noise.normal();
  return d;
}

Detection image_of(const CameraNoise& errors, double bearing_rad, double range_m, Noise& noise) {
  const double scale_px_m = errors.focal_px * errors.height_m;
  Detection d;
  d.bearing_rad = wrap_pi(bearing_rad + errors.bearing_sigma_rad * noise.normal());
  d.inverse_depth_per_m = 1.0 / range_m + errors.height_sigma_px / scale_px_m * noise.normal();
  return d;
}

Detection echo_of(const RadarNoise& errors, const Seen& car, Noise& noise) {
  Detection d;
  d.range_m = car.range_m + errors.range_sigma_m * noise.normal();
  d.bearing_rad = wrap_pi(car.bearing_rad + errors.bearing_sigma_rad * noise.normal());
  d.range_rate_mps = car.range_rate_mps + errors.rate_sigma_mps * noise.normal();
  return d;
}

Detection measured(const DetectionSensor& sensor, const Seen& car, Noise& noise) {
  switch (sensor.source) {
    case DetectionSource::kCamera:
      return image_of(sensor.camera, car.bearing_rad, car.range_m, noise);
    case DetectionSource::kRadar:
      return echo_of(sensor.radar, car, noise);
    case DetectionSource::kLidar:
      break;
  }
  return box_of(sensor.lidar, car, noise);
}

// A place for what is not there: boxes on the road ahead and behind, the rest anywhere in view.
// What a radar sees falsely stands still.
Seen phantom(const DetectionSensor& sensor, const CarPose& ours, Noise& noise) {
  const View& view = sensor.view;
  Seen s{.yaw_rad = between(-std::numbers::pi, std::numbers::pi, noise),
         .length_m = between(2.0, 6.0, noise),
         .width_m = between(0.8, 2.5, noise)};
  if (sensor.source == DetectionSource::kLidar) {
    s.x_m = between(-view.most_m, view.most_m, noise);
    s.y_m = between(-kAcross_m, kAcross_m, noise);
  } else {
    const double bearing_rad =
        view.facing_rad + between(-0.5 * view.width_rad, 0.5 * view.width_rad, noise);
    const double range_m = between(view.least_m, view.most_m, noise);
    s.x_m = range_m * std::cos(bearing_rad), s.y_m = range_m * std::sin(bearing_rad);
  }
  s.range_m = std::max(kNearest_m, std::hypot(s.x_m, s.y_m));
  s.bearing_rad = std::atan2(s.y_m, s.x_m);
  const double heading_rad = ours.yaw_rad + s.bearing_rad;
  const Velocity own = velocity_in_map(ours);
  s.range_rate_mps =
      -(own.east_mps * std::cos(heading_rad) + own.north_mps * std::sin(heading_rad));
  return s;
}

bool is_within(const View& view, const Seen& car) {
  return car.range_m >= view.least_m && car.range_m <= view.most_m &&
         is_in_view(view, car.bearing_rad);
}

using Surroundings = FixedVector<Seen, kTrueCarsMax>;

Surroundings surroundings(const TrueCars& cars) {
  Surroundings all;
  for (const CarPose& car : cars.others) CHECK(all.push(seen_from(cars.ours, car)));
  return all;
}

bool is_seen(const View& view, const Surroundings& all, const Seen& car) {
  return is_within(view, car) && visible_share(all.span(), car) >= view.visible_share;
}

void add(DetectionFrame& frame, Detection d, double confidence, std::uint32_t& overflows) {
  d.confidence = confidence;
  if (!frame.detections.push(d)) ++overflows;
}

void add_false(DetectionFrame& frame, const DetectionSensor& sensor, const CarPose& ours,
               double mean, Noise& noise, std::uint32_t& overflows) {
  for (int n = poisson(mean, noise); n > 0; --n) {
    const Seen false_one = phantom(sensor, ours, noise);
    if (!is_within(sensor.view, false_one)) continue;
    const Detection d = measured(sensor, false_one, noise);
    const double most = sensor.confidence_false;
    add(frame, d, between(0.5 * most, most, noise), overflows);
  }
}

DetectionFrame frame_of(const DetectionSensor& sensor, DetectionSensorState& state,
                        const Surroundings& all, const CarPose& ours, Instant now,
                        std::uint32_t& overflows) {
  Noise& noise = state.noise;
  DetectionFrame frame;
  frame.source = sensor.source, frame.unit = sensor.unit, frame.at = now;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Seen& car = all[i];
    const bool missed = is_in_burst(sensor.miss, state.miss[i], now, noise);
    if (missed || !is_seen(sensor.view, all, car)) continue;
    if (noise.uniform() >= at_range(sensor.hit_rate, car.range_m)) continue;
    const Detection d = measured(sensor, car, noise);
    const double confidence = between(sensor.confidence_least, 1.0, noise);
    if (!is_in_any(state.fault.blind.span(), car.bearing_rad)) add(frame, d, confidence, overflows);
  }
  add_false(frame, sensor, ours, sensor.false_per_frame, noise, overflows);
  const double added = state.fault.false_per_s * sensor.cadence.period.seconds();
  if (added > 0.0) add_false(frame, sensor, ours, added, state.fault_noise, overflows);
  return frame;
}

// The queue is sorted: the next arrival is last.
template <std::size_t Room>
bool insert(FixedVector<DetectionFrame, Room>& queue, const DetectionFrame& frame) {
  if (!queue.push(frame)) return false;
  for (std::size_t i = queue.size() - 1; i > 0 && queue[i - 1].received <= frame.received; --i)
    std::swap(queue[i - 1], queue[i]);
  return true;
}

template <std::size_t Room>
void remove_last(FixedVector<DetectionFrame, Room>& queue) {
  FixedVector<DetectionFrame, Room> rest;
  for (std::size_t i = 0; i + 1 < queue.size(); ++i) CHECK(rest.push(queue[i]));
  queue = rest;
}

// Of all that is due the earliest.
DetectionSensorState* next_arrival(DetectionState& state, Instant now) {
  DetectionSensorState* found = nullptr;
  for (DetectionSensorState& s : state.sensor) {
    if (s.queue.empty() || s.queue.back().received > now) continue;
    if (!found || s.queue.back().received < found->queue.back().received) found = &s;
  }
  return found;
}

}  // namespace

DetectionState make_detections(const DetectionSensors& sensors, std::uint64_t seed, Instant start) {
  DetectionState state;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    DetectionSensorState s;
    s.noise = Noise(seed, kDetectionStream + i);
    s.fault_noise = Noise(seed, kDetectionFaultStream + i);
    s.next = start + sensors[i].phase;
    s.outage.until = start;
    for (BurstState& miss : s.miss) miss.until = start;
    CHECK(state.sensor.push(s));
  }
  return state;
}

bool is_in_sight(const DetectionSensor& sensor, const TrueCars& cars, std::size_t other) {
  const Surroundings all = surroundings(cars);
  return is_seen(sensor.view, all, all[other]);
}

void step_detections(const DetectionSensors& sensors, DetectionState& state, const TrueCars& cars,
                     Instant now, Arrivals& out) {
  CHECK(sensors.size() == state.sensor.size());
  Surroundings all;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    DetectionSensorState& s = state.sensor[i];
    if (!due(now, sensors[i].cadence.period, s.next)) continue;
    if (all.empty()) all = surroundings(cars);
    DetectionFrame frame = frame_of(sensors[i], s, all, cars.ours, now, state.overflows);
    frame.received = now + latency(sensors[i].cadence, s.noise) + s.fault.added_latency;
    const bool lost = s.noise.uniform() < sensors[i].frame_loss;
    if (is_in_burst(sensors[i].outage, s.outage, now, s.noise) || lost || s.fault.outage) continue;
    if (!insert(s.queue, frame)) ++state.overflows;
  }
  while (DetectionSensorState* const s = next_arrival(state, now)) {
    if (!out.push(s->queue.back())) return;
    remove_last(s->queue);
  }
}

}  // namespace pitwall::sensors
