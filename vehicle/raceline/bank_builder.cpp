// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_builder.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "vehicle/raceline/lanes/apexes.hpp"
#include "vehicle/raceline/optimum/minimum_curvature.hpp"
#include "vehicle/raceline/optimum/minimum_time.hpp"
#include "vehicle/raceline/track_fingerprint.hpp"

namespace pitwall::raceline {
namespace {

constexpr std::array kSides{std::pair{Side::kInside, "inside"}, std::pair{Side::kCentre, "centre"},
                            std::pair{Side::kOutside, "outside"}};

class BankBuilder {
 public:
  BankBuilder(const world::TrackMap& track, const BankParams& params)
      : lanes_(track),
        margin_m_(0.5 * params.car_width_m + params.clearance_m),
        step_m_(params.step_m) {}

  std::optional<Problem> add_lane(Region region, const std::vector<Waypoint>& chosen) {
    Raceline centre;
    for (const auto& [side, name] : kSides) {
      auto problem = add(region, name, parallel_waypoints(lanes_, region, side, margin_m_));
      if (problem) return problem;
      if (side == Side::kCentre) centre = lines_.back();
    }
    return add(region, "apex", apex_waypoints(lanes_, region, centre, margin_m_, chosen));
  }

  std::optional<Problem> add_pit() {
    return add(Region::kPitLane, "centre", pit_waypoints(lanes_, margin_m_));
  }

  std::optional<Problem> add_minimum_curvature() {
    return add(Region::kTrack, "minimum_curvature", minimum_curvature(lanes_, margin_m_));
  }

  std::optional<Problem> add_minimum_time(const envelope::EnvelopeTable& table) {
    return add(Region::kTrack, "minimum_time", minimum_time(lanes_, margin_m_, table));
  }

  std::vector<Raceline> take() { return std::move(lines_); }

 private:
  std::optional<Problem> add(Region region, const char* name,
                             const Result<std::vector<Waypoint>, Problem>& waypoints) {
    if (!waypoints) return waypoints.error();
    const auto spline = fit_between(lanes_, region, margin_m_, *waypoints);
    if (!spline) return spline.error();
    Raceline line = sample_raceline(*spline, lanes_.track(), step_m_);
    line.region = region;
    line.name = std::string{text_of(region)} + "/" + name;
    lines_.push_back(std::move(line));
    return std::nullopt;
  }

  Lanes lanes_;
  double margin_m_, step_m_;
  std::vector<Raceline> lines_;
};

}  // namespace

Result<RacelineBank, Problem> build_bank(const world::TrackDescription& description,
                                         const world::TrackMap& track, const BankParams& params,
                                         const ChosenApexes& chosen) {
  BankBuilder builder{track, params};
  if (auto problem = builder.add_lane(Region::kInnerLane, chosen.inner))
    return Unexpected{*std::move(problem)};
  if (auto problem = builder.add_lane(Region::kOuterLane, chosen.outer))
    return Unexpected{*std::move(problem)};
  if (auto problem = builder.add_minimum_curvature()) return Unexpected{*std::move(problem)};
  if (params.fastest_for != nullptr)
    if (auto problem = builder.add_minimum_time(*params.fastest_for))
      return Unexpected{*std::move(problem)};
  if (track.pit())
    if (auto problem = builder.add_pit()) return Unexpected{*std::move(problem)};
  return RacelineBank{track.name(), fingerprint_of(description), builder.take()};
}

}  // namespace pitwall::raceline
