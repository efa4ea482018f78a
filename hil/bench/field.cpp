// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {

bool FieldContact::is_caused_by(std::size_t car) const {
  using traffic::Cause;
  if (contact.cause == Cause::kBoth) return true;
  return contact.cause == (car == first ? Cause::kFirst : Cause::kSecond);
}

std::optional<Problem> difference(const Runner& first, const Runner& car) {
  const auto other = [&](const char* what) {
    return Problem{car.scenario.name,
                   std::string{"cannot share the run of the first car: "} + what};
  };
  if (car.setup.track.name() != first.setup.track.name()) return other("another track");
  if (car.scenario.duration != first.scenario.duration) return other("another duration");
  if (car.scenario.race_control != first.scenario.race_control)
    return other("other flags of race control");
  if (car.setup.params.rates.tick != first.setup.params.rates.tick) return other("another tick");
  return std::nullopt;
}

Field::Field(std::span<const Runner> runners, std::span<const FieldGhost> ghosts)
    : track_(runners.front().setup.track),
      cars_(runners.size() + ghosts.size()),
      traces_(cars_.size()),
      least_gap_m_(cars_.size(), kUnset),
      ghosts_(ghosts),
      orders_(ghosts.size()) {
  CHECK(cars_.size() <= kFieldMax);
  for (const Runner& runner : runners) {
    names_.push_back(runner.name);
    numbers_.push_back(runner.setup.params.outbound.vehicle_number);
  }
  for (const FieldGhost& ghost : ghosts) {
    names_.push_back(ghost.name);
    numbers_.push_back(ghost.number);
    ghost_states_.push_back(traffic::begin(ghost.ghost, track_, Instant{}));
  }
  for (std::size_t i = 0; i < cars_.size(); ++i) in_order_.push_back(i);
  std::ranges::sort(in_order_, {}, [&](std::size_t i) {
    return std::pair{numbers_[i], names_[i]};
  });
}

void Field::step(std::span<const FieldCar> stacks, Instant now) {
  CHECK(stacks.size() + ghosts_.size() == cars_.size());
  std::ranges::copy(stacks, cars_.begin());
  move_ghosts(now);
  for (std::size_t i = 0; i < cars_.size(); ++i) traces_[i].record(cars_[i].pose, now);
  for (std::size_t second = 1; second < cars_.size(); ++second)
    for (std::size_t first = 0; first < std::min(second, stacks.size()); ++first)
      judge_pair(first, second, now);
}

// A ghost starts with the run and has no laps to count before it has passed the start line.
void Field::move_ghosts(Instant now) {
  const std::size_t first = cars_.size() - ghosts_.size();
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    traffic::GhostState& state = ghost_states_[i];
    state =
        traffic::step(ghosts_[i].ghost, track_, state, {cars_.front().pose.s_m, orders_[i]}, now);
    cars_[first + i] = {.pose = state.pose,
                        .laps = static_cast<std::uint32_t>(state.travelled_m / track_.length_m()),
                        .told_to_slow = cars_.front().told_to_slow};
  }
}

std::size_t Field::index_of(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  CHECK(found != names_.end());
  return static_cast<std::size_t>(found - names_.begin());
}

void Field::order(std::size_t ghost, const traffic::GhostOrder& order) {
  CHECK(is_ghost(ghost));
  orders_[ghost - (cars_.size() - ghosts_.size())] = order;
}

std::span<const plant::CarPose> Field::others_of(std::size_t car) {
  others_.clear();
  for (const std::size_t other : in_order_)
    if (other != car) CHECK(others_.push(cars_[other].pose));
  return others_.span();
}

void Field::judge_pair(std::size_t first, std::size_t second, Instant now) {
  const FieldCar &one = cars_[first], &other = cars_[second];
  if (!(std::hypot(one.pose.x_m - other.pose.x_m, one.pose.y_m - other.pose.y_m) < kNear_m)) return;
  const double gap_m =
      traffic::gap_between(traffic::rectangle_of(one.pose), traffic::rectangle_of(other.pose))
          .distance_m;
  for (const std::size_t car : {first, second})
    least_gap_m_[car] = std::fmin(least_gap_m_[car], gap_m);
  if (!(gap_m <= 0.0)) return;
  const auto is_known = [&](const FieldContact& c) {
    return c.first == first && c.second == second;
  };
  if (std::ranges::any_of(contacts_, is_known)) return;
  const auto contact = traffic::contact_between({one.pose, traces_[first], one.told_to_slow},
                                                {other.pose, traces_[second], other.told_to_slow},
                                                track_.at(one.pose.s_m).yaw_rad, now);
  if (contact) contacts_.push_back({first, second, *contact, one.pose.s_m, one.pose, other.pose});
}

std::optional<CarContact> Field::contact_of(std::size_t car) const {
  for (const FieldContact& c : contacts_) {
    if (c.first != car && c.second != car) continue;
    const bool is_first = c.first == car;
    const std::size_t other = is_first ? c.second : c.first;
    return CarContact{.at = c.contact.at,
                      .with = names_[other],
                      .with_number = numbers_[other],
                      .kind = c.contact.kind,
                      .rule = c.contact.rule,
                      .is_caused = c.is_caused_by(car),
                      .is_caused_by_other = c.is_caused_by(other),
                      .closing_mps = c.contact.closing_mps,
                      .s_m = c.s_m,
                      .point_m = c.contact.gap.point_m,
                      .own = is_first ? c.first_pose : c.second_pose,
                      .other = is_first ? c.second_pose : c.first_pose};
  }
  return std::nullopt;
}

double Field::progress_m(std::size_t car) const {
  return cars_[car].laps * track_.length_m() + cars_[car].pose.s_m;
}

std::optional<race::Rival> Field::rival_of(std::size_t car) const {
  const auto apart_m = [&](std::size_t other) {
    return std::abs(std::remainder(cars_[other].pose.s_m - cars_[car].pose.s_m, track_.length_m()));
  };
  std::optional<std::size_t> nearest;
  std::uint8_t ahead = 0;
  for (std::size_t other = 0; other < cars_.size(); ++other) {
    if (other == car) continue;
    if (!nearest || apart_m(other) < apart_m(*nearest)) nearest = other;
  }
  if (!nearest) return std::nullopt;
  for (std::size_t other = 0; other < cars_.size(); ++other)
    if (progress_m(other) > progress_m(*nearest)) ++ahead;
  const FieldCar& rival = cars_[*nearest];
  return race::Rival{.number = numbers_[*nearest],
                     .rank = static_cast<std::uint8_t>(ahead + 1),
                     .laps = static_cast<std::uint8_t>(rival.laps & 0xFF),
                     .distance_m = rival.pose.s_m,
                     .speed_mps = traffic::speed_mps(rival.pose)};
}

FieldCar car_of(const Rig& rig) {
  const plant::Truth& truth = rig.truth();
  const bool green = rig.flags().track == world::TrackFlag::kGreen ||
                     rig.flags().track == world::TrackFlag::kWavingGreen;
  return {.pose = {.x_m = truth.x_m,
                   .y_m = truth.y_m,
                   .yaw_rad = truth.yaw_rad,
                   .vx_mps = truth.vx_mps,
                   .vy_mps = truth.vy_mps,
                   .yaw_rate_rad_per_s = truth.yaw_rate_rad_per_s,
                   .s_m = rig.road().s_m,
                   .n_m = rig.road().n_m,
                   .length_m = rig.length_m(),
                   .width_m = rig.width_m()},
          .laps = rig.laps().finished,
          .told_to_slow = !green};
}

}  // namespace pitwall::bench
