// The samples of the receivers: positions, velocities, headings and attitudes.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/localization/intake.hpp"

namespace pitwall::localization {
namespace {

using Residual = std::array<double, 3>;
constexpr double kNisBeyondChance = 120.0;  // of up to three degrees of freedom
constexpr double kReported = 3.0;  // sigmas that two units may differ by beside their limit

double from_north(double clockwise_rad) { return wrap_pi(0.5 * std::numbers::pi - clockwise_rad); }

double magnitude(const Residual& r) { return std::hypot(r[0], r[1]); }

double apart_max(const CheckParams& p, Source source) {
  switch (source) {
    case Source::kPosition:
      return p.agree_position_m;
    case Source::kVelocity:
      return p.agree_velocity_mps;
    default:
      return p.agree_heading_rad;
  }
}

// Against the prediction and against the other unit. `sigma` is the sample's, `predicted_sigma`
// the filter's.
void compare(const Intake& in, std::uint8_t unit, Instant at, const Residual& residual,
             double sigma, double predicted_sigma, double stray, Evidence& e) {
  const CheckParams& checks = in.params.checks;
  e.residual = magnitude(residual);
  e.jump_sigma_max = checks.jump_sigmas * std::hypot(sigma, predicted_sigma);
  e.stray = stray;
  for (std::uint8_t u = 0; u < world::kGnssUnits; ++u) {
    const Stream& other = in.stream(e.source, u);
    const double apart_s = std::abs((at - other.residual_at).seconds());
    const double within_s = std::max(checks.agree_within_s, gap_max_s(checks, e.source));
    if (u == unit || !other.comparable || apart_s > within_s) continue;
    e.apart = magnitude({residual[0] - other.residual[0], residual[1] - other.residual[1], 0.0});
    e.apart_max = apart_max(checks, e.source) + kReported * std::hypot(sigma, other.residual_sigma);
    e.other_stray = other.stray;
    if (in_use(in, e.source, u)) e.other_sigma = other.residual_sigma;
  }
}

void store(Stream& stream, Instant at, const Residual& residual, double sigma, const Evidence& e) {
  stream.comparable = std::isfinite(e.residual);
  stream.residual_at = at;
  stream.residual = residual;
  stream.residual_sigma = sigma;
  stream.stray = e.stray;
  stream.rank = e.rank;
}

// Whether its form, time and solution are right: only then it may be held against anything.
bool comparable(const Intake& in, const Evidence& e) {
  return judge(e, in.params.checks, {}).gate == Gate::kAccepted;
}

bool prefers_other(Preference preference, std::uint8_t unit) {
  return preference != Preference::kBoth &&
         static_cast<std::size_t>(preference) - 1 != static_cast<std::size_t>(unit);
}

Preference preference_for(const Priorities& p, Source source) {
  if (source == Source::kPosition) return p.position;
  return source == Source::kVelocity ? p.velocity : p.heading;
}

// Healthy, but the other one is preferred, or of a better kind.
bool stands_by(const Intake& in, Source source, std::uint8_t unit, double rank) {
  if (!other_in_use(in, source, unit)) return false;
  if (prefers_other(preference_for(in.params.priorities, source), unit)) return true;
  for (std::uint8_t u = 0; u < world::kGnssUnits; ++u)
    if (u != unit && in_use(in, source, u) && in.stream(source, u).rank > rank) return true;
  return false;
}

template <class Sample>
bool excluded(const Intake& in, Source source, const Sample& sample) {
  if (sample.unit >= world::kGnssUnits) return false;
  const auto which = sample.unit == 0 ? world::Excludable::kGnss0 : world::Excludable::kGnss1;
  if (in.use.uses(which)) return false;
  record_verdict(in, source, sample.unit, sample.at, Gate::kExcluded);
  return true;
}

template <class Sample>
Evidence begin(const Intake& in, const Sample& sample) {
  Evidence e = evidence_of(in.params, in.datum, sample);
  if (!e.known_unit) return e;
  complete(in, in.stream(e.source, sample.unit), content_of(sample), sample.at, e);
  const world::ReceiverHealth& own = in.state.receivers[sample.unit];
  e.receiver_well = !own.error && own.time_valid;
  for (std::uint8_t u = 0; u < world::kGnssUnits; ++u) {
    const world::ReceiverHealth& other = in.state.receivers[u];
    if (u != sample.unit)
      e.other_well = !other.error && other.time_valid && in_use(in, e.source, u);
  }
  return e;
}

// From the judgement to the filter. True if the sample may be started from: nothing is wrong with
// it, whether the filter runs or not.
template <class Sample>
bool conclude(const Intake& in, const Evidence& e, const Sample& sample, const Measurement& m) {
  Gate gate = admit(in, e, sample.unit, content_of(sample), sample.at);
  if (gate == Gate::kAccepted && stands_by(in, e.source, sample.unit, e.rank))
    gate = Gate::kStandby;
  if (gate != Gate::kAccepted)
    return record_verdict(in, e.source, sample.unit, sample.at, gate), false;
  if (fuse(in, e.source, m) || !in.state.started) return true;
  // The filter itself refused what had passed: a jump that only it can see.
  Stream& stream = in.stream(e.source, sample.unit);
  const Verdict& reported = in.out.verdicts[in.out.verdicts.size() - 1];
  if (reported.gate == Gate::kOutlier) count_jump(in, stream, reported.nis > kNisBeyondChance);
  stream.trust.refuse(in.params.checks);
  return true;
}

Measurement measurement(const Intake& in, const world::GnssVelocity& v) {
  return {.kind = Kind::kVelocity,
          .unit = v.unit,
          .at = v.at,
          .a = v.horizontal_mps * std::sin(v.track_over_ground_rad),
          .b = v.horizontal_mps * std::cos(v.track_over_ground_rad),
          .c = v.vertical_mps,
          .sigma_a = v.sigma_mps,
          .sigma_b = v.sigma_mps,
          .sigma_c = v.sigma_mps,
          .arm = in.params.units[v.unit].antenna};
}

Measurement measurement(const world::InsAttitude& a) {
  return {.kind = Kind::kAttitude,
          .unit = a.unit,
          .at = a.at,
          .a = a.roll_rad,
          .b = a.pitch_rad,
          .c = from_north(a.heading_rad),
          .sigma_a = a.roll_sigma_rad,
          .sigma_b = a.pitch_sigma_rad,
          .sigma_c = a.heading_sigma_rad};
}

// Positions that are refused for long although they come: the filter is wrong, not the receivers.
void count_refusals(const Intake& in, Gate gate, Instant at) {
  State& s = in.state;
  if (gate == Gate::kAccepted) s.refusing = false;
  if (gate != Gate::kOutlier) return;
  if (!s.refusing) s.refusing = true, s.refused_since = at;
  if ((at - s.refused_since).seconds() < in.params.reset_after_s) return;
  s.started = false;
  s.refusing = false;
  s.trail = {};
  forget(s.drift);
  for (auto& units : s.streams)
    for (Stream& stream : units) stream.comparable = false;
  ++s.restarts;
}

// While the car reckons the prediction is not worth more than a position: the filter decides.
bool reckoning(const Intake& in) {
  for (std::size_t u = 0; u < world::kGnssUnits; ++u) {
    const Tally& t = in.tally(Source::kPosition, u);
    if (t.ever_accepted && (in.now - t.last_accepted).seconds() <= in.params.good_age_max_s)
      return false;
  }
  return true;
}

// A heading across the way of the car is wrong unless the filter has it as well: then it slides.
double course_error(const Intake& in, double yaw_rad, double residual_rad) {
  const CheckParams& p = in.params.checks;
  if (const Moment* moment = in.state.trail.newest()) {
    if (moment->speed_mps < p.course_speed_min_mps || residual_rad <= p.jump_heading_rad)
      return kUnset;
    return wrap_pi(yaw_rad - moment->course_rad());
  }
  const world::GnssVelocity& v = in.state.seed_velocity;
  const bool moving = in.state.have_velocity && v.horizontal_mps >= p.course_speed_min_mps &&
                      (in.now - v.at).seconds() <= p.rate_window_s;
  return moving ? wrap_pi(yaw_rad - from_north(v.track_over_ground_rad)) : kUnset;
}

}  // namespace

Measurement measurement(const Intake& in, const world::GnssPosition& p) {
  const auto place = in.datum.to_map(p.latitude_deg, p.longitude_deg, p.height_m);
  if (!place) return {.unit = p.unit, .at = p.at};  // refused by its form
  return {.kind = Kind::kPosition,
          .unit = p.unit,
          .at = p.at,
          .a = place->x_m,
          .b = place->y_m,
          .c = place->z_m,
          .sigma_a = p.longitude_sigma_m,
          .sigma_b = p.latitude_sigma_m,
          .sigma_c = p.height_sigma_m,
          .arm = in.params.units[p.unit].antenna};
}

Measurement measurement(const Intake& in, const world::GnssHeading& h) {
  const double direction_rad = in.params.units[h.unit].baseline_yaw_rad;
  return {.kind = Kind::kHeading,
          .unit = h.unit,
          .at = h.at,
          .a = wrap_pi(from_north(h.heading_rad) - direction_rad),
          .sigma_a = h.heading_sigma_rad,
          .direction_rad = direction_rad};
}

void take(const Intake& in, const world::GnssPosition& p) {
  if (excluded(in, Source::kPosition, p)) return;
  Evidence e = begin(in, p);
  if (!e.known_unit) return record_verdict(in, e.source, p.unit, p.at, Gate::kUnknownUnit);
  Stream& stream = in.stream(e.source, p.unit);
  stream.comparable = false;
  const Measurement m = measurement(in, p);
  double cg_x_m = kUnset, cg_y_m = kUnset;
  if (comparable(in, e)) {
    if (const auto moment = in.state.trail.at(p.at)) {
      const Moment::Vector arm = moment->arm_m(m.arm);
      cg_x_m = m.a - arm.x, cg_y_m = m.b - arm.y;
      const Residual residual{cg_x_m - moment->x_m, cg_y_m - moment->y_m, 0.0};
      compare(in, p.unit, p.at, residual, e.sigma, moment->position_sigma_m,
              stray_m(in.state.drift, p.unit, cg_x_m, cg_y_m, p.at), e);
      store(stream, p.at, residual, e.sigma, e);
      if (reckoning(in)) e.jump_min = kUnset;
    }
  }
  const bool good = conclude(in, e, p, m);
  const Gate gate = stream.verdict;
  if (gate == Gate::kAccepted && std::isfinite(cg_x_m))
    learn(in.params.checks, in.state.drift, p.unit, cg_x_m, cg_y_m, p.at);
  if (good) in.state.seed_position = p, in.state.have_position = true;
  if (in.state.started) count_refusals(in, gate, p.at);
}

void take(const Intake& in, const world::GnssVelocity& v) {
  if (excluded(in, Source::kVelocity, v)) return;
  Evidence e = begin(in, v);
  if (!e.known_unit) return record_verdict(in, e.source, v.unit, v.at, Gate::kUnknownUnit);
  Stream& stream = in.stream(e.source, v.unit);
  stream.comparable = false;
  const Measurement m = measurement(in, v);
  if (comparable(in, e)) {
    if (const auto moment = in.state.trail.at(v.at)) {
      const Moment::Vector expected = moment->antenna_mps(m.arm);
      const Residual residual{m.a - expected.x, m.b - expected.y, 0.0};
      const double sigma = std::isfinite(v.sigma_mps) ? v.sigma_mps : 0.0;
      compare(in, v.unit, v.at, residual, sigma, moment->speed_sigma_mps, magnitude(residual), e);
      store(stream, v.at, residual, sigma, e);
    }
  }
  if (!conclude(in, e, v, m)) return;
  in.state.seed_velocity = v;
  in.state.have_velocity = true;
  if (stream.verdict == Gate::kAccepted &&
      v.horizontal_mps >= in.params.checks.course_speed_min_mps)
    note_course(in.state.imu, v.unit, v.at, std::atan2(m.b, m.a));
}

void take(const Intake& in, const world::GnssHeading& h) {
  if (excluded(in, Source::kHeading, h)) return;
  Evidence e = begin(in, h);
  if (!e.known_unit) return record_verdict(in, e.source, h.unit, h.at, Gate::kUnknownUnit);
  Stream& stream = in.stream(e.source, h.unit);
  stream.comparable = false;
  const Measurement m = measurement(in, h);
  if (comparable(in, e)) {
    double expected_rad = kUnset, sigma_rad = kUnset;
    if (const auto moment = in.state.trail.at(h.at)) {
      expected_rad = moment->azimuth_rad(m.direction_rad) - m.direction_rad;
      sigma_rad = moment->yaw_sigma_rad;
    }
    const Residual residual{wrap_pi(m.a - expected_rad), 0.0, 0.0};
    compare(in, h.unit, h.at, residual, e.sigma, sigma_rad, std::abs(residual[0]), e);
    store(stream, h.at, residual, e.sigma, e);
    e.course_error_rad = course_error(in, m.a, e.residual);
  }
  if (conclude(in, e, h, m)) in.state.seed_heading = h, in.state.have_heading = true;
}

// The receiver's own attitude stands by while its antennas say where they point.
void take(const Intake& in, const world::InsAttitude& a) {
  if (excluded(in, Source::kAttitude, a)) return;
  Evidence e = begin(in, a);
  if (!e.known_unit) return record_verdict(in, e.source, a.unit, a.at, Gate::kUnknownUnit);
  const Measurement m = measurement(a);
  if (comparable(in, e)) {
    if (const auto moment = in.state.trail.at(a.at)) {
      const Residual residual{wrap_pi(m.c - moment->yaw_rad), 0.0, 0.0};
      compare(in, a.unit, a.at, residual, a.heading_sigma_rad, moment->yaw_sigma_rad,
              std::abs(residual[0]), e);
      e.course_error_rad = course_error(in, m.c, e.residual);
    }
  }
  const Gate gate = admit(in, e, a.unit, content_of(a), a.at);
  if (gate != Gate::kAccepted) return record_verdict(in, e.source, a.unit, a.at, gate);
  for (std::size_t u = 0; u < world::kGnssUnits; ++u)
    if (in_use(in, Source::kHeading, u))
      return record_verdict(in, e.source, a.unit, a.at, Gate::kStandby);
  (void)fuse(in, e.source, m);
}

}  // namespace pitwall::localization
