// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/rival.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "vehicle/receivers/receiver.hpp"

namespace pitwall::bench {
namespace {

struct Fix {
  UtcTime at;
  world::Curvilinear place;
  double speed_mps = kUnset;
};

bool is_solved(std::uint32_t status, std::uint32_t type) {
  return status == world::kSolutionComputed && type != world::kPositionNone;
}

// The positions of one receiver of one car, on the track.
class FixReader {
 public:
  FixReader(const pipeline::Setup& setup, std::size_t unit)
      : setup_(setup), receiver_(static_cast<std::uint8_t>(unit), setup.params.receivers[unit]) {}

  void read(const traffic::Record& record) {
    samples_ = {};
    receiver_.feed(record.bytes(), Instant{record.at.ns}, samples_);
    for (const world::GnssVelocity& velocity : samples_.velocities)
      if (is_solved(velocity.solution_status, velocity.velocity_type))
        speed_mps_ = velocity.horizontal_mps;
    for (const world::GnssPosition& position : samples_.positions) note(position);
  }
  std::vector<Fix> take() && { return std::move(fixes_); }

 private:
  void note(const world::GnssPosition& position) {
    if (!is_solved(position.solution_status, position.position_type)) return;
    const auto point =
        setup_.datum.to_map(position.latitude_deg, position.longitude_deg, position.height_m);
    if (!point) return;
    const world::Curvilinear place = setup_.track.project(point->x_m, point->y_m);
    const UtcTime at{position.at.ns};
    if (!std::isfinite(place.s_m) || (!fixes_.empty() && at <= fixes_.back().at)) return;
    fixes_.push_back({at, place, speed_mps_});
  }

  const pipeline::Setup& setup_;
  receivers::Receiver receiver_;
  world::SensorInput samples_;
  double speed_mps_ = kUnset;
  std::vector<Fix> fixes_;
};

std::vector<Fix> fixes_of(const traffic::Recording& both, const std::string& source,
                          const pipeline::Setup& setup, std::size_t unit) {
  FixReader reader{setup, unit};
  for (const traffic::Record& record : both.records)
    if (both.sources[record.source].name == source) reader.read(record);
  return std::move(reader).take();
}

Result<std::vector<Fix>, Problem> fixes_of(const traffic::Recording& both, const std::string& label,
                                           const pipeline::Setup& setup) {
  for (std::size_t unit = 0; unit < world::kGnssUnits; ++unit) {
    auto fixes = fixes_of(both, label + ":/gnss/" + std::to_string(unit), setup, unit);
    if (!fixes.empty()) return fixes;
  }
  return Unexpected{Problem{label, "no receiver of this car has a position"}};
}

// The shorter way from a to b, positive forward.
double way(const world::TrackMap& track, double from_s_m, double to_s_m) {
  const double ahead_m = track.station_ahead(from_s_m, to_s_m);
  return ahead_m > 0.5 * track.length_m() ? ahead_m - track.length_m() : ahead_m;
}

std::optional<world::Curvilinear> place_at(const world::TrackMap& track,
                                           const std::vector<Fix>& fixes, UtcTime at) {
  const auto after = std::ranges::lower_bound(fixes, at, {}, &Fix::at);
  if (after == fixes.end()) return std::nullopt;
  if (after->at == at) return after->place;
  if (after == fixes.begin()) return std::nullopt;
  const Fix &a = *std::prev(after), &b = *after;
  const std::int64_t gap_ns = b.at.ns - a.at.ns;
  if (gap_ns > kRivalGap.ns) return std::nullopt;
  const double share = static_cast<double>(at.ns - a.at.ns) / static_cast<double>(gap_ns);
  return world::Curvilinear{
      .s_m = track.wrap_station(a.place.s_m + share * way(track, a.place.s_m, b.place.s_m)),
      .n_m = std::lerp(a.place.n_m, b.place.n_m, share)};
}

}  // namespace

Result<RivalRows, Problem> rival_of(const traffic::Recording& both, const pipeline::Setup& setup) {
  const auto own = fixes_of(both, kOwnLabel, setup);
  if (!own) return Unexpected{own.error()};
  const auto rival = fixes_of(both, kRivalLabel, setup);
  if (!rival) return Unexpected{rival.error()};
  RivalRows out{.rows = {}, .own_positions = own->size(), .rival_positions = rival->size()};
  for (const Fix& fix : *own) {
    const auto place = place_at(setup.track, *rival, fix.at);
    if (!place) continue;
    RivalRow row{.at = fix.at, .own = fix.place, .rival = *place, .own_mps = fix.speed_mps};
    row.gap_m = way(setup.track, fix.place.s_m, place->s_m);
    if (fix.speed_mps >= kGapLeast_mps) row.gap_s = row.gap_m / fix.speed_mps;
    out.rows.push_back(row);
  }
  return out;
}

}  // namespace pitwall::bench
