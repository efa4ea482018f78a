// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/match_run.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

constexpr std::uint8_t kOwn = 0, kRival = 1;

template <class T>
T nth_or_last(const std::vector<T>& list, std::size_t i) {
  return list[std::min(i, list.size() - 1)];
}

grading::Verdict verdict(const scenario::MatchPlan& plan, std::string text, bool pass,
                         std::string reason) {
  grading::Verdict v;
  v.name = plan.place;
  v.text = std::move(text);
  v.pass = pass;
  if (!pass) v.reason = std::move(reason);
  return v;
}

}  // namespace

MatchRun::MatchRun(const scenario::MatchPlan& plan, const Field& field,
                   const world::TrackMap& track)
    : plan_(plan),
      cars_{0, field.index_of(plan.rival)},
      params_{.rules = plan.rules,
              .track_length_m = track.length_m(),
              .begins = Instant{} + plan.begins,
              .first_attacker = plan.rival_first ? kRival : kOwn},
      before_(race::begin_judging(params_)),
      state_(before_),
      track_length_m_(track.length_m()) {}

void MatchRun::step(Field& field, std::span<const bool> declines, Instant now) {
  const race::JudgeView view{
      .cars = {judged(field, declines, kOwn), judged(field, declines, kRival)},
      .contact = contact(field)};
  before_ = state_;
  state_ = race::step(params_, before_, view, now);
  if (state_.stage == race::Stage::kOver && !over_since_) over_since_ = now;
  order_ghost(field);
}

bool MatchRun::is_inside(const plant::CarPose& pose) const {
  return pose.n_m > 0.5 * (plan_.lanes.inside_m + plan_.lanes.outside_m);
}

race::JudgedCar MatchRun::judged(const Field& field, std::span<const bool> declines,
                                 std::size_t car) const {
  const std::size_t i = cars_[car];
  const plant::CarPose& pose = field.car(i).pose;
  return {.station_m = pose.s_m,
          .speed_mps = traffic::speed_mps(pose),
          .length_m = pose.length_m,
          .inside = is_inside(pose),
          .declines = i < declines.size() ? declines[i] : rival_declines_};
}

std::optional<race::JudgedContact> MatchRun::contact(const Field& field) const {
  for (const FieldContact& c : field.contacts()) {
    if (c.first != std::min(cars_[0], cars_[1]) || c.second != std::max(cars_[0], cars_[1]))
      continue;
    return race::JudgedContact{.caused = {c.is_caused_by(cars_[0]), c.is_caused_by(cars_[1])}};
  }
  return std::nullopt;
}

std::size_t MatchRun::attempts_by(std::uint8_t car) const {
  return static_cast<std::size_t>(std::ranges::count(
      state_.attempts, car,
      [](const race::AttemptRecord& attempt) { return attempt.assignment.attacker; }));
}

void MatchRun::order_ghost(Field& field) {
  const auto shown = race::shown_to(state_, kRival);
  if (!shown || !field.is_ghost(cars_[kRival])) return;
  if (state_.stage == race::Stage::kOver) return field.order(cars_[kRival], {.speed_mps = 0.0});
  const plant::CarPose &own = field.car(cars_[kOwn]).pose, &rival = field.car(cars_[kRival]).pose;
  const bool attacks = state_.match.attacker == kRival;
  const traffic::DriverOrder order =
      traffic::order_of(nth_or_last(plan_.attempts, attempts_by(kRival)),
                        nth_or_last(plan_.defends, attempts_by(kOwn)),
                        {.role = attacks ? rules::Role::kAttacker : rules::Role::kDefender,
                         .is_cautioned = shown->flags.vehicle == world::VehicleFlag::kYellow,
                         .pass_allowed = shown->flags.track == world::TrackFlag::kWavingGreen,
                         .round_speed_mps = from_mph(shown->round_speed_mph),
                         .lead_m = std::remainder(rival.s_m - own.s_m, track_length_m_),
                         .length_m = 0.5 * (own.length_m + rival.length_m),
                         .other_mps = traffic::speed_mps(own),
                         .is_inside = is_inside(rival),
                         .is_other_inside = is_inside(own)});
  rival_declines_ = order.declines;
  field.order(cars_[kRival], {.inside = order.inside, .speed_mps = order.speed_mps});
}

std::optional<race::Call> MatchRun::call_for(std::size_t car, Instant now) const {
  for (std::uint8_t i = 0; i < rules::kCars; ++i)
    if (cars_[i] == car) return race::call_between(before_, state_, i, now);
  return std::nullopt;
}

std::optional<std::string> MatchRun::ended_attempt() const {
  if (state_.attempts.size() == before_.attempts.size()) return std::nullopt;
  return to_text(sheet(), state_.attempts.size() - 1);
}

bool MatchRun::is_over(Instant now) const {
  return over_since_ && now - *over_since_ >= kAfterMatch;
}

race::MatchSheet MatchRun::sheet() const {
  return race::sheet_of(state_, {scenario::kOwnCar, plan_.rival});
}

void judge_match(const scenario::MatchPlan& plan, RunResult& result) {
  const race::MatchSheet& sheet = *result.match;
  for (std::size_t i = 0; i < plan.expect.size(); ++i) {
    const bool made = i < sheet.attempts.size();
    if (!made && plan.is_cut) break;
    const bool pass = made && sheet.attempts[i].ending == plan.expect[i];
    result.verdicts.push_back(verdict(
        plan, formatted("attempt %zu ends as %s", i + 1, rules::name_of(plan.expect[i])), pass,
        made ? "it ended as " + std::string{rules::name_of(sheet.attempts[i].ending)}
             : std::string{"it was not made"}));
  }
  if (plan.result.empty() || plan.is_cut) return;
  const std::string result_is = result_text(sheet);
  result.verdicts.push_back(verdict(plan, "the match ends as " + plan.result,
                                    result_is == plan.result, "it ended as " + result_is));
}

}  // namespace pitwall::bench
