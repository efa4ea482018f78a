// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/waypoints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kWalkStep_m = 1.0;          // of the walk along the track
constexpr double kStraightSpacing_m = 60.0;  // of waypoints where the track is straight
constexpr double kTurnSpacing_rad = 0.35;    // and at most so much turn between two
constexpr double kSampleStep_m = 1.0;        // at which a spline is compared with its lane
constexpr double kNearShare = 0.4;  // of the spacing: a second waypoint so near would make waves
constexpr int kRoundsMax = 60;

// Between waypoints: shorter in turns.
double spacing_at(const world::TrackMap& track, double s_m) {
  const double curvature = std::abs(track.at(s_m).curvature_per_m);
  return 1.0 / (1.0 / kStraightSpacing_m + curvature / kTurnSpacing_rad);
}

// Stations at that spacing.
std::vector<double> stations_of(const world::TrackMap& track) {
  const auto steps = static_cast<std::size_t>(std::ceil(track.length_m() / kWalkStep_m));
  const double step_m = track.length_m() / static_cast<double>(steps);
  std::vector<double> measure{0.0};
  for (std::size_t i = 0; i < steps; ++i) {
    measure.push_back(measure.back() + step_m / spacing_at(track, static_cast<double>(i) * step_m));
  }
  const double count = std::ceil(measure.back());
  std::vector<double> stations;
  std::size_t i = 0;
  for (double k = 0.0; k < count; ++k) {
    const double wanted = measure.back() * k / count;
    while (measure[i + 1] <= wanted) ++i;
    const double share = (wanted - measure[i]) / (measure[i + 1] - measure[i]);
    stations.push_back((static_cast<double>(i) + share) * step_m);
  }
  return stations;
}

Unexpected<Problem> too_narrow(const Lanes& lanes, Region region, double s_m, double margin_m) {
  const double width_m = lanes.band(region, s_m).width_m();
  return refuse(formatted("%s: s = %.1f m", lanes.track().name().c_str(), s_m),
                formatted("the %s is %.2f m wide, at least %.2f m expected", words_of(region),
                          width_m, 2.0 * margin_m));
}

struct Excess {
  double s_m = kUnset;
  double bound_m = kUnset;  // the offset that is allowed there
  double over_m = kUnset;   // from there to the line, positive left
};

// The worst place of each stretch along which the spline comes too close to a side of its region.
std::vector<Excess> excesses_of(const SpiroSpline& spline, const Lanes& lanes, Region region,
                                double margin_m, double station_m) {
  const auto samples = static_cast<std::size_t>(spline.length_m() / kSampleStep_m);
  std::vector<Excess> worst;
  bool is_outside = false;
  for (std::size_t i = 0; i < samples; ++i) {
    const SplinePoint p =
        spline.at(spline.length_m() * static_cast<double>(i) / static_cast<double>(samples));
    const world::Curvilinear place = lanes.track().project(p.x_m, p.y_m, station_m);
    station_m = place.s_m;
    const Band free = lanes.band(region, station_m).narrowed(margin_m);
    const double bound_m = place.n_m > free.middle_m() ? free.left_m : free.right_m;
    const bool was_outside = is_outside;
    is_outside = std::abs(place.n_m - free.middle_m()) > 0.5 * free.width_m() + kExcessAllowed_m;
    if (!is_outside) continue;
    const Excess here{station_m, bound_m, place.n_m - bound_m};
    if (!was_outside) worst.push_back(here);
    if (std::abs(here.over_m) > std::abs(worst.back().over_m)) worst.back() = here;
  }
  return worst;
}

// The nearest waypoint gives way by the excess; where none is near, one is set at the bound.
void pull_in(const world::TrackMap& track, const Excess& excess, std::vector<Waypoint>& waypoints) {
  const auto apart_m = [&](const Waypoint& w) {
    return std::abs(std::remainder(w.s_m - excess.s_m, track.length_m()));
  };
  const auto nearest = std::ranges::min_element(waypoints, {}, apart_m);
  if (apart_m(*nearest) < kNearShare * spacing_at(track, excess.s_m)) {
    nearest->n_m -= excess.over_m;
    return;
  }
  const auto after = std::ranges::upper_bound(waypoints, excess.s_m, {}, &Waypoint::s_m);
  waypoints.insert(after, {excess.s_m, excess.bound_m});
}

std::vector<Place> places_of(const world::TrackMap& track, const std::vector<Waypoint>& waypoints) {
  std::vector<Place> places;
  for (const Waypoint& w : waypoints) {
    const world::TrackPoint p = track.offset(w.s_m, w.n_m);
    places.push_back({p.x_m, p.y_m});
  }
  return places;
}

}  // namespace

Result<std::vector<Waypoint>, Problem> parallel_waypoints(const Lanes& lanes, Region region,
                                                          Side side, double margin_m) {
  const std::vector<double> stations = stations_of(lanes.track());
  std::vector<Waypoint> waypoints;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double s_m = stations[i];
    const double lap_m = i == 0 ? lanes.track().length_m() : 0.0;
    const double before_m = stations[i == 0 ? stations.size() - 1 : i - 1] - lap_m;
    const double half_m = 0.5 * (s_m - before_m);
    const Band free = lanes.narrowest(region, s_m - half_m, s_m + half_m).narrowed(margin_m);
    if (!(free.width_m() >= 0.0)) return too_narrow(lanes, region, s_m, margin_m);
    const bool is_left = (side == Side::kInside) == lanes.turns_left();
    waypoints.push_back({s_m, side == Side::kCentre ? free.middle_m()
                              : is_left             ? free.left_m
                                                    : free.right_m});
  }
  return waypoints;
}

Result<std::vector<Waypoint>, Problem> pit_waypoints(const Lanes& lanes, double margin_m) {
  CHECK(lanes.track().pit());
  const Region lane = lanes.lane_at_pit();
  const Side side = lane == Region::kInnerLane ? Side::kInside : Side::kOutside;
  auto waypoints = parallel_waypoints(lanes, lane, side, margin_m);
  if (!waypoints) return waypoints;
  std::vector<Waypoint> way;
  for (const Waypoint& w : *waypoints) {
    const auto along = lanes.along_pit(w.s_m);
    if (!along) {
      way.push_back(w);
    } else if (*along > world::kPitRampShare && *along < 1.0 - world::kPitRampShare) {
      way.push_back({w.s_m, lanes.track().pit()->offset_m});
    }
  }
  return way;
}

Result<SpiroSpline, Problem> fit_between(const Lanes& lanes, Region region, double margin_m,
                                         std::vector<Waypoint> waypoints) {
  for (int round = 0;; ++round) {
    auto spline = SpiroSpline::through(places_of(lanes.track(), waypoints));
    if (!spline) return spline;
    const std::vector<Excess> excesses =
        excesses_of(*spline, lanes, region, margin_m, waypoints.front().s_m);
    if (excesses.empty()) return spline;
    if (round == kRoundsMax)
      return refuse(formatted("%s: s = %.1f m", lanes.track().name().c_str(), excesses.front().s_m),
                    formatted("the line comes %.2f m too close to a side of the %s",
                              std::abs(excesses.front().over_m), words_of(region)));
    for (const Excess& excess : excesses) pull_in(lanes.track(), excess, waypoints);
  }
}

}  // namespace pitwall::raceline
