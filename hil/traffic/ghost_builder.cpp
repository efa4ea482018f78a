// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/ghost_builder.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::traffic {
namespace {

// Lines and speeds of a ghost, in the order in which its plan names them.
class Builder {
 public:
  Builder(const GhostPlan& plan, const world::TrackMap& track, const world::RacelineBank* bank)
      : plan_(plan), track_(track), bank_(bank) {}

  Result<Ghost, Problem> build() {
    if (auto problem = add_start()) return Unexpected{*problem};
    for (const ScriptPlan& entry : plan_.script)
      if (auto problem = add_entry(entry)) return Unexpected{*problem};
    if (auto problem = add_lanes()) return Unexpected{*problem};
    return std::move(ghost_);
  }

 private:
  std::optional<Problem> add_start() {
    GhostParams& params = ghost_.params;
    params.start_s_m = plan_.start_s_m, params.start_mps = plan_.start_mps;
    params.limits = plan_.limits;
    params.drift = plan_.drift, params.speed_drift = plan_.speed_drift;
    params.length_m = plan_.length_m, params.width_m = plan_.width_m;
    params.seed = plan_.seed;
    params.joins = plan_.start_n_m.has_value();
    if (plan_.start_s_m >= track_.length_m())
      return Problem{plan_.place, "start.s_m lies beyond the end of the track"};
    if (most_accel_mps2(plan_.drift) > plan_.limits.lateral_mps2)
      return Problem{plan_.place, "the drift needs more than the limit lateral_mps2"};
    const OffsetLine start(plan_.start_n_m.value_or(0.0));
    ghost_.lines.push_back(start);
    if (auto problem = add_line(plan_.line, plan_.place)) return problem;
    const world::TrackPoint road = track_.at(plan_.start_s_m);
    const double n_m = start.at(0.0).n_m, half_m = 0.5 * plan_.width_m;
    if (params.joins && (n_m + half_m >= road.width_left_m || half_m - n_m >= road.width_right_m))
      return Problem{plan_.place, "start.n_m puts the car into a wall"};
    return add_speed(plan_.speed, plan_.place);
  }

  std::optional<Problem> add_line(const LinePlan& line, const std::string& place) {
    raceline_ = nullptr;
    if (line.name.empty()) {
      ghost_.lines.emplace_back(line.offset_m);
    } else {
      if (bank_ == nullptr)
        return Problem{place,
                       "line \"" + line.name + "\": the car file names no bank of racelines"};
      const auto found =
          std::find_if(bank_->lines.begin(), bank_->lines.end(),
                       [&](const world::Raceline& l) { return l.name == line.name; });
      if (found == bank_->lines.end())
        return Problem{place, "line \"" + line.name + "\" is not in " + bank_->source};
      if (found->region == world::Region::kPitLane)
        return Problem{place, "line \"" + line.name + "\" leads through the pit lane"};
      auto made = OffsetLine::of(*found, track_, line.offset_m);
      if (!made) return Problem{place, "line " + to_string(made.error())};
      ghost_.lines.push_back(*std::move(made));
      raceline_ = &*found;
    }
    const double reach_m = 0.5 * plan_.width_m + plan_.drift.most_m;
    if (auto problem = touches_wall(ghost_.lines.back(), track_, reach_m))
      return Problem{place, problem->what};
    return std::nullopt;
  }

  std::optional<Problem> add_speed(const SpeedPlan& speed, const std::string& place) {
    lap_share_ = speed.lap_share;
    if (!std::isnan(speed.lap_share)) return add_lap(place);
    if (speed.by_station.empty()) {
      ghost_.speeds.emplace_back(speed.mps);
      return std::nullopt;
    }
    if (speed.by_station.back().s_m >= track_.length_m())
      return Problem{place, "a station of the speeds lies beyond the end of the track"};
    ghost_.speeds.emplace_back(speed.by_station, track_.length_m(), plan_.limits.brake_mps2);
    return std::nullopt;
  }

  std::optional<Problem> add_lap(const std::string& place) {
    if (raceline_ == nullptr || raceline_->lap.empty())
      return Problem{place, "lap_share needs a line of the bank with a speed profile"};
    ghost_.speeds.emplace_back(lap_of(*raceline_, track_, lap_share_), track_.length_m(),
                               plan_.limits.brake_mps2);
    return std::nullopt;
  }

  std::optional<Problem> add_lanes() {
    if (!plan_.lanes) return std::nullopt;
    for (const double offset_m : {plan_.lanes->inside_m, plan_.lanes->outside_m})
      if (auto problem = add_line({.offset_m = offset_m}, plan_.place)) return problem;
    ghost_.lanes = Lanes{.inside = ghost_.lines.size() - 2, .outside = ghost_.lines.size() - 1};
    return std::nullopt;
  }

  std::optional<Problem> add_entry(const ScriptPlan& entry) {
    if (spun_) return Problem{entry.place, "nothing can follow a spin"};
    if (entry.trigger == Trigger::kStation && entry.value >= track_.length_m())
      return Problem{entry.place, "the station lies beyond the end of the track"};
    if (entry.decel_mps2 > plan_.limits.brake_mps2)
      return Problem{entry.place, "decel_mps2 is above the limit brake_mps2"};
    ScriptEntry made{.trigger = entry.trigger,
                     .value = entry.value,
                     .action = entry.action,
                     .over_s = entry.over_s,
                     .decel_mps2 = entry.decel_mps2,
                     .to_mps = entry.to_mps,
                     .turn_rad = entry.turn_rad};
    std::optional<Problem> problem;
    switch (entry.action) {
      case Action::kSpeed:
        problem = add_speed(entry.speed, entry.place);
        break;
      case Action::kLine:
        problem = add_line(entry.line, entry.place);
        if (!problem && !std::isnan(lap_share_)) problem = add_lap(entry.place);
        break;
      case Action::kStand:
        made.decel_mps2 = plan_.limits.brake_mps2;
        break;
      case Action::kSpin:
        spun_ = true;
        break;
      case Action::kBrake:
        break;
    }
    if (problem) return problem;
    made.line = ghost_.lines.size() - 1, made.speed = ghost_.speeds.size() - 1;
    if (!ghost_.params.script.push(made)) return Problem{entry.place, "the script is too long"};
    return std::nullopt;
  }

  const GhostPlan& plan_;
  const world::TrackMap& track_;
  const world::RacelineBank* bank_;
  Ghost ghost_;
  const world::Raceline* raceline_ = nullptr;  // of the newest line
  double lap_share_ = kUnset;                  // of the newest speed
  bool spun_ = false;
};

}  // namespace

Result<Ghost, Problem> build_ghost(const GhostPlan& plan, const world::TrackMap& track,
                                   const world::RacelineBank* bank) {
  return Builder(plan, track, bank).build();
}

}  // namespace pitwall::traffic
