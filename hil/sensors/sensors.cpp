// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/sensors.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "hil/sensors/arrival.hpp"

namespace pitwall::sensors {
namespace {

static_assert(std::is_trivially_copyable_v<State>);

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Duration kSkyPeriod = milliseconds(50);
constexpr Duration kApart = milliseconds(2);  // of two messages of a stream on the line

// One epoch of one unit.
struct Epoch {
  std::size_t unit = 0;
  Instant now{};
  const UnitFault& fault;
  Noise& arrival;
  std::uint32_t& overflows;
};

// Drawn always, so that no fault changes what comes after it.
struct Passage {
  Duration takes{};
  bool lost = false;
};

Passage passage(const Cadence& cadence, const Epoch& e) {
  const Duration takes = latency(cadence, e.arrival);
  return {takes, e.arrival.uniform() < e.fault.stream.gaps};
}

template <class Box, class Sample>
void post(Box& box, Sample sample, Duration takes, const Epoch& e) {
  Instant arrives = e.now + takes;
  if (!box.queue.empty()) arrives = std::max(arrives, box.queue.back().deliver_at + kApart);
  sample.unit = static_cast<std::uint8_t>(e.unit);
  if (!box.queue.push({sample, arrives})) ++e.overflows;
}

// What comes of the satellites: its clock and its way may be faulty.
template <class Box, class Sample>
void post_solution(Box& box, Sample sample, const Cadence& cadence, const Epoch& e) {
  const StreamFault& f = e.fault.stream;
  const Passage way = passage(cadence, e);
  if (!f.stamp_frozen) box.stamp = e.now + f.stamp_shift;
  sample.at = box.stamp;
  if (!f.outage && !way.lost) post(box, sample, way.takes + f.added_latency, e);
}

void apply_fault(const StreamFault& f, world::GnssPosition& s) {
  if (f.not_a_number) s.latitude_deg = s.height_m = kNan;
  if (!f.negative_sigma) return;
  s.latitude_sigma_m = -s.latitude_sigma_m, s.longitude_sigma_m = -s.longitude_sigma_m;
  s.height_sigma_m = -s.height_sigma_m;
}

void apply_fault(const StreamFault& f, world::GnssVelocity& s) {
  if (f.not_a_number) s.horizontal_mps = s.vertical_mps = kNan;
}

void apply_fault(const StreamFault& f, world::GnssHeading& s) {
  if (f.not_a_number) s.heading_rad = kNan;
  if (f.negative_sigma) s.heading_sigma_rad = -s.heading_sigma_rad;
}

void at_position_epoch(const Params& p, const plant::Truth& t, const Sky& sky, const Epoch& e,
                       UnitState& u) {
  const UnitParams& up = p.unit[e.unit];
  const SolutionFault& wrong = e.fault.solution;
  const GeographicLib::LocalCartesian datum(p.datum_latitude_deg, p.datum_longitude_deg,
                                            p.datum_height_m);
  const double period_s = p.position.period.seconds();
  auto position = measure_position(up, wrong, datum, t, sky, period_s, u.gnss);
  auto velocity = measure_velocity(up, wrong, t, u.gnss);
  const auto attitude = measure_attitude(up, wrong, t, period_s, u.gnss);
  if (e.fault.stream.position_frozen && u.gnss.has_last_position) position = u.gnss.last_position;
  u.gnss.last_position = position;
  u.gnss.has_last_position = true;
  apply_fault(e.fault.stream, position);
  apply_fault(e.fault.stream, velocity);
  post_solution(u.positions, position, p.position, e);
  post_solution(u.velocities, velocity, p.velocity, e);
  post_solution(u.attitudes, attitude, p.attitude, e);
}

void at_heading_epoch(const Params& p, const plant::Truth& t, const Epoch& e, UnitState& u) {
  auto heading =
      measure_heading(p.unit[e.unit], e.fault.solution, t, p.heading.period.seconds(), u.gnss);
  apply_fault(e.fault.stream, heading);
  UnitFault fault = e.fault;
  fault.stream.outage = fault.stream.outage || fault.stream.heading_outage;
  post_solution(u.headings, heading, p.heading, {e.unit, e.now, fault, e.arrival, e.overflows});
}

void at_imu_epoch(const Params& p, const Inertial& body, const Epoch& e, UnitState& u) {
  auto sample = measure(p.unit[e.unit], e.fault.imu, body, p.imu.period.seconds(), u.imu,
                        u.bias_noise, u.imu_noise);
  const Passage way = passage(p.imu, {e.unit, e.now, e.fault, u.imu_noise, e.overflows});
  sample.at = e.now;
  if (!e.fault.stream.outage && !e.fault.imu.outage) post(u.imu_samples, sample, way.takes, e);
}

void at_health_epoch(const Params& p, const Epoch& e, UnitState& u) {
  world::ReceiverHealth health;
  health.at = e.now;
  const Passage way = passage(p.health, e);
  if (!e.fault.stream.outage) post(u.health, health, way.takes, e);
}

// What was on its way is lost with the connection.
void disconnect(UnitState& u) {
  u.positions.queue = {};
  u.velocities.queue = {};
  u.headings.queue = {};
  u.imu_samples.queue = {};
  u.attitudes.queue = {};
  u.health.queue = {};
}

void measure_unit(const Params& p, std::size_t unit, const plant::Truth& t, const Inertial& body,
                  Instant now, State& state, world::SensorInput& out) {
  UnitState& u = state.unit[unit];
  const Epoch e{unit, now, state.fault[unit], u.gnss.of(UnitStream::kArrival), out.overflows};
  if (due(now, p.position.period, u.next_position)) at_position_epoch(p, t, state.sky, e, u);
  if (due(now, p.heading.period, u.next_heading)) at_heading_epoch(p, t, e, u);
  if (due(now, p.imu.period, u.next_imu)) at_imu_epoch(p, body, e, u);
  if (due(now, p.health.period, u.next_health)) at_health_epoch(p, e, u);
  if (e.fault.stream.outage) disconnect(u);
}

// The angular acceleration by the difference from the last call.
Inertial inertial_of(const plant::Truth& t, Instant now, State& state) {
  Inertial body{.rate_rad_per_s = t.rate_rad_per_s,
                .change_rad_per_s2 = {},
                .specific_force_mps2 = t.specific_force_mps2};
  const double dt_s = (now - state.rate_at).seconds();
  if (state.has_rate && dt_s > 0.0)
    body.change_rad_per_s2 =
        times(1.0 / dt_s, plus(t.rate_rad_per_s, times(-1.0, state.rate_rad_per_s)));
  state.rate_rad_per_s = t.rate_rad_per_s;
  state.rate_at = now;
  state.has_rate = true;
  return body;
}

void advance_sky(const Params& p, Instant now, State& state) {
  if (due(now, kSkyPeriod, state.next_sky))
    state.sky.wander.advance(state.sky_noise, kSkyPeriod.seconds(),
                             p.unit[0].noise.position.correlation_s);
  state.sky.seconds = (now - state.start).seconds();
}

template <class Queue>
void drop_front(Queue& queue) {
  Queue rest;
  for (std::size_t i = 1; i < queue.size(); ++i) (void)rest.push(queue[i]);
  queue = rest;
}

// Moves what has arrived by `now` from the units' boxes into one list, earliest first.
template <class Box, class List>
void deliver(State& state, Box UnitState::*box, Instant now, List& list, std::uint32_t& overflows) {
  for (;;) {
    Box* first = nullptr;
    for (UnitState& u : state.unit) {
      Box& b = u.*box;
      if (b.queue.empty() || b.queue[0].deliver_at > now) continue;
      if (first == nullptr || b.queue[0].deliver_at < first->queue[0].deliver_at) first = &b;
    }
    if (first == nullptr) return;
    if (!list.push(first->queue[0].sample)) ++overflows;
    drop_front(first->queue);
  }
}

UnitState make_unit(const Params& params, std::uint64_t seed, std::size_t unit, Instant start) {
  UnitState u;
  u.gnss = make_gnss(seed, unit);
  u.imu_noise = Noise(seed, stream_of(unit, UnitStream::kImu));
  u.bias_noise = Noise(seed, stream_of(unit, UnitStream::kInertialBias));
  u.imu = turn_on(params.unit[unit].noise.imu, u.bias_noise);
  u.next_position = u.next_heading = u.next_health = start + params.unit[unit].position_phase;
  u.next_imu = start + params.unit[unit].imu_phase;
  return u;
}

}  // namespace

Params params_for(const world::TrackMap& track) {
  Params p;
  p.datum_latitude_deg = track.datum_latitude_deg();
  p.datum_longitude_deg = track.datum_longitude_deg();
  p.datum_height_m = track.datum_height_m();
  return p;
}

State make_state(const Params& params, std::uint64_t seed, Instant start) {
  State state;
  for (std::size_t i = 0; i < world::kGnssUnits; ++i)
    state.unit[i] = make_unit(params, seed, i, start);
  state.sky_noise = Noise(seed, kSkyStream);
  state.sky.wander.begin(state.sky_noise);
  state.start = state.next_sky = start;
  return state;
}

void step(const Params& params, State& state, const plant::Truth& truth, Instant now,
          world::SensorInput& out) {
  advance_sky(params, now, state);
  const Inertial body = inertial_of(truth, now, state);
  for (std::size_t unit = 0; unit < world::kGnssUnits; ++unit)
    measure_unit(params, unit, truth, body, now, state, out);
  deliver(state, &UnitState::positions, now, out.positions, out.overflows);
  deliver(state, &UnitState::velocities, now, out.velocities, out.overflows);
  deliver(state, &UnitState::headings, now, out.headings, out.overflows);
  deliver(state, &UnitState::imu_samples, now, out.imu, out.overflows);
  deliver(state, &UnitState::attitudes, now, out.attitudes, out.overflows);
  deliver(state, &UnitState::health, now, out.receivers, out.overflows);
}

}  // namespace pitwall::sensors
