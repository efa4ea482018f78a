// Two ghosts on the oval in a match, as they drive by what the judge has them shown.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "hil/nodes/judge.hpp"
#include "hil/traffic/ghost_builder.hpp"
#include "hil/traffic/ghost_driver.hpp"
#include "hil/traffic/motion_trace.hpp"
#include "hil/traffic/rectangle.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::race {

using traffic::Defence;
using traffic::Manner;

inline constexpr Duration kTick = milliseconds(10);
inline constexpr double kStart_mps = 30.0, kInside_m = 3.5, kOutside_m = -3.5;

struct Driver {
  Manner manner = Manner::kPass;
  Defence defence = Defence::kHold;
  double start_s_m = 0.0;
};

using Watch = std::function<void(const JudgeState& before, const JudgeState& after,
                                 const JudgeView& view, Instant now)>;
using Change = std::function<void(JudgeView& view, Instant now)>;

class GhostMatch {
 public:
  GhostMatch(const std::array<Driver, rules::kCars>& drivers, JudgeParams params)
      : drivers_(drivers), params_(std::move(params)) {
    params_.track_length_m = traffic::oval().length_m();
    state_ = begin_judging(params_);
    for (std::size_t car = 0; car < rules::kCars; ++car) {
      traffic::GhostPlan plan;
      plan.start_s_m = drivers[car].start_s_m, plan.start_mps = kStart_mps;
      plan.line.offset_m = kInside_m, plan.speed.mps = kStart_mps;
      plan.lanes = {.inside_m = kInside_m, .outside_m = kOutside_m};
      auto ghost = traffic::build_ghost(plan, traffic::oval(), nullptr);
      if (!ghost) ADD_FAILURE() << to_string(ghost.error());
      ghosts_[car] = *std::move(ghost);
      cars_[car] = traffic::begin(ghosts_[car], traffic::oval(), Instant{});
    }
  }

  const JudgeState& drive(Duration at_most, const Watch& watch = {}, const Change& change = {}) {
    for (Instant now{}; now - Instant{} < at_most && state_.stage != Stage::kOver; now += kTick)
      step(now, watch, change);
    return state_;
  }

 private:
  void step(Instant now, const Watch& watch, const Change& change) {
    JudgeView view{.cars = {judged(0), judged(1)}, .contact = contact()};
    if (change) change(view, now);
    const JudgeState before = state_;
    state_ = race::step(params_, before, view, now);
    if (watch) watch(before, state_, view, now);
    move(now);
  }

  void move(Instant now) {
    const std::array poses{cars_[0].pose, cars_[1].pose};
    for (std::uint8_t car = 0; car < rules::kCars; ++car) {
      traffic::Surroundings around;
      if (const auto shown = shown_to(state_, car)) {
        const plant::CarPose &own = poses[car], &other = poses[1U - car];
        const traffic::DriverOrder order = traffic::order_of(
            drivers_[car].manner, drivers_[car].defence,
            {.role = car == state_.match.attacker ? rules::Role::kAttacker : rules::Role::kDefender,
             .is_cautioned = shown->flags.vehicle == world::VehicleFlag::kYellow,
             .pass_allowed = shown->flags.track == world::TrackFlag::kWavingGreen,
             .round_speed_mps = from_mph(shown->round_speed_mph),
             .lead_m = std::remainder(own.s_m - other.s_m, params_.track_length_m),
             .length_m = own.length_m,
             .other_mps = traffic::speed_mps(other),
             .is_inside = own.n_m > 0.0,
             .is_other_inside = other.n_m > 0.0});
        around.order = {.inside = order.inside, .speed_mps = order.speed_mps};
        declines_[car] = order.declines;
      }
      cars_[car] = traffic::step(ghosts_[car], traffic::oval(), cars_[car], around, now + kTick);
    }
  }

  JudgedCar judged(std::size_t car) const {
    const plant::CarPose& pose = cars_[car].pose;
    return {.station_m = pose.s_m,
            .speed_mps = traffic::speed_mps(pose),
            .length_m = pose.length_m,
            .inside = pose.n_m > 0.0,
            .declines = declines_[car]};
  }

  // Whoever is behind drove into the other one.
  std::optional<JudgedContact> contact() const {
    const plant::CarPose &a = cars_[0].pose, &b = cars_[1].pose;
    if (std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) > 10.0) return std::nullopt;
    const auto gap = traffic::gap_between(traffic::rectangle_of(a), traffic::rectangle_of(b));
    if (gap.distance_m > 0.0) return std::nullopt;
    const bool first = std::remainder(a.s_m - b.s_m, params_.track_length_m) < 0.0;
    return JudgedContact{.caused = {first, !first}};
  }

  std::array<Driver, rules::kCars> drivers_;
  JudgeParams params_;
  JudgeState state_;
  std::array<traffic::Ghost, rules::kCars> ghosts_;
  std::array<traffic::GhostState, rules::kCars> cars_;
  std::array<bool, rules::kCars> declines_{};
};

inline constexpr Driver kAhead{.start_s_m = 100.0}, kBehind{.start_s_m = 40.0};

inline Driver with(Driver driver, Manner manner, Defence defence = Defence::kHold) {
  driver.manner = manner;
  driver.defence = defence;
  return driver;
}

// One round, in which the first car attacks first.
inline JudgeParams one_round(double speed_mph) {
  JudgeParams params;
  params.rules.round_speeds_mph.clear();
  EXPECT_TRUE(params.rules.round_speeds_mph.push(speed_mph));
  return params;
}

}  // namespace pitwall::race
