// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/judge.hpp"

#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::race {
namespace {

using rules::Ending;
using rules::Phase;
using world::TrackFlag;
using world::VehicleFlag;

const JudgedCar& attacker_of(const JudgeState& state, const JudgeView& view) {
  return view.cars[state.match.attacker];
}

const JudgedCar& defender_of(const JudgeState& state, const JudgeView& view) {
  return view.cars[1U - state.match.attacker];
}

double mean_length_m(const JudgeView& view) {
  return 0.5 * (view.cars[0].length_m + view.cars[1].length_m);
}

double round_speed_mps(const JudgeState& state) {
  return from_mph(state.current.assignment.round_speed_mph);
}

// Adds the way since the last tick; a car without a place has an unknown way from then on.
void travel(const JudgeParams& params, const JudgeView& view, JudgeState& state) {
  for (std::size_t car = 0; car < rules::kCars; ++car) {
    const double station_m = view.cars[car].station_m;
    const double way_m = std::remainder(station_m - state.station_m[car], params.track_length_m);
    const bool first = std::isnan(state.station_m[car]) && state.travelled_m[car] == 0.0;
    if (!first) {
      state.travelled_m[car] += way_m;
      state.lead_m += car == state.match.attacker ? way_m : -way_m;
    }
    state.station_m[car] = station_m;
  }
}

void assign(const JudgeParams& params, JudgeState& state, Instant now) {
  const auto assignment = rules::due(params.rules, state.match);
  state.attempt = {};
  state.trails_since.reset();
  state.stands_since = {};
  state.lead_m = kUnset;
  if (!assignment) {
    state.stage = Stage::kOver;
    return;
  }
  state.stage = Stage::kForming;
  state.current = {.assignment = *assignment, .formed = now};
}

void finish(const JudgeParams& params, JudgeState& state, Ending ending, Instant now) {
  state.current.ended = now;
  state.current.ending = ending;
  state.current.score = rules::score_of(params.rules, ending, state.match.repeats);
  CHECK(state.attempts.push(state.current));
  const std::uint8_t attacker = state.match.attacker;
  if (ending == Ending::kContactByAttacker) state.is_black[attacker] = true;
  if (ending == Ending::kContactByDefender) state.is_black[1U - attacker] = true;
  state.match = rules::record(params.rules, state.match, ending);
  assign(params, state, now);
}

std::optional<rules::ContactCause> cause_of(const JudgeState& state, const JudgeView& view) {
  if (!view.contact) return std::nullopt;
  const bool attacker = view.contact->caused[state.match.attacker];
  const bool defender = view.contact->caused[1U - state.match.attacker];
  if (attacker == defender) return rules::ContactCause::kShared;
  return attacker ? rules::ContactCause::kAttacker : rules::ContactCause::kDefender;
}

// The attacker is behind by less than half a lap, with a gap to the defender.
void form(const JudgeParams& params, const JudgeView& view, JudgeState& state, Instant now) {
  if (const auto cause = cause_of(state, view)) {
    const rules::AttemptState contact =
        rules::step(params.rules, 0.0, params.track_length_m, {}, {.contact = cause});
    return finish(params, state, *contact.ending, now);
  }
  const double lead_m =
      std::remainder(attacker_of(state, view).station_m - defender_of(state, view).station_m,
                     params.track_length_m);
  if (now - state.current.formed > params.forming || std::isnan(lead_m))
    return finish(params, state, Ending::kStopped, now);
  if (!(lead_m <= -mean_length_m(view) - params.start_gap_m)) return;
  state.stage = Stage::kAttempt;
  state.lead_m = lead_m;
  state.current.green = now;
}

// Waving green has to be earned by both; the rules keep it from then on.
bool waves(const JudgeParams& params, const JudgeView& view, JudgeState& state, Instant now) {
  const rules::Situation attacker{.lead_m = state.lead_m, .length_m = mean_length_m(view)};
  const JudgedCar& defender = defender_of(state, view);
  const bool trails =
      rules::is_behind(attacker) && rules::gap_behind_m(attacker) <= params.trail_m &&
      std::abs(attacker_of(state, view).speed_mps - defender.speed_mps) <= params.trails_mps &&
      rules::keeps_rule(params.rules, round_speed_mps(state), defender.speed_mps, defender.inside);
  if (!trails) state.trails_since.reset();
  if (trails && !state.trails_since) state.trails_since = now;
  return trails && now - *state.trails_since >= params.trails;
}

void note(const JudgeParams& params, const JudgeView& view, Phase before, JudgeState& state,
          Instant now) {
  AttemptRecord& record = state.current;
  const Phase phase = state.attempt.phase;
  const bool waved = !std::isnan(state.attempt.waving_at_m);
  if (before == Phase::kClosingUp && waved) record.waving = now;
  if (before <= Phase::kPassing && !std::isnan(state.attempt.clear_at_m)) record.clear = now;
  if (before <= Phase::kPassing)
    record.laps_used = rules::laps_used(state.attempt, params.track_length_m,
                                        state.travelled_m[state.match.attacker]);
  record.most_lead_m = state.attempt.most_lead_m;
  if (!waved || before == Phase::kEnded || phase == Phase::kClosingUp) return;
  const double speed_mps = defender_of(state, view).speed_mps;
  record.defender_least_mps = std::fmin(record.defender_least_mps, speed_mps);
  record.defender_most_mps = std::fmax(record.defender_most_mps, speed_mps);
}

// A car that has stopped on the track.
bool stands(const JudgeParams& params, const JudgeView& view, JudgeState& state, Instant now) {
  bool stands = false;
  for (std::size_t car = 0; car < rules::kCars; ++car) {
    std::optional<Instant>& since = state.stands_since[car];
    if (!(view.cars[car].speed_mps <= params.stands_mps))
      since.reset();
    else if (!since)
      since = now;
    stands = stands || (since && now - *since >= params.stands);
  }
  return stands;
}

void judge(const JudgeParams& params, const JudgeView& view, JudgeState& state, Instant now) {
  if (stands(params, view, state, now)) return finish(params, state, Ending::kStopped, now);
  const Phase before = state.attempt.phase;
  const JudgedCar &attacker = attacker_of(state, view), &defender = defender_of(state, view);
  state.attempt =
      rules::step(params.rules, round_speed_mps(state), params.track_length_m, state.attempt,
                  {.pass_allowed = waves(params, view, state, now),
                   .lead_m = state.lead_m,
                   .length_m = mean_length_m(view),
                   .attacker_travelled_m = state.travelled_m[state.match.attacker],
                   .defender_mps = defender.speed_mps,
                   .attacker_inside = attacker.inside,
                   .defender_inside = defender.inside,
                   .contact = cause_of(state, view),
                   .declined = attacker.declines});
  note(params, view, before, state, now);
  if (state.attempt.ending) finish(params, state, *state.attempt.ending, now);
}

}  // namespace

JudgeState begin_judging(const JudgeParams& params) {
  JudgeState state;
  state.match = rules::begin_match(params.first_attacker);
  return state;
}

JudgeState step(const JudgeParams& params, const JudgeState& state, const JudgeView& view,
                Instant now) {
  JudgeState next = state;
  travel(params, view, next);
  if (next.stage == Stage::kWaiting && now >= params.begins) assign(params, next, now);
  if (next.stage == Stage::kAttempt) judge(params, view, next, now);
  if (next.stage == Stage::kForming) form(params, view, next, now);
  return next;
}

std::optional<Shown> shown_to(const JudgeState& state, std::uint8_t car) {
  const bool attacks = car == state.match.attacker;
  Shown shown{
      .flags = {TrackFlag::kGreen, attacks ? VehicleFlag::kAttacker : VehicleFlag::kDefender},
      .round_speed_mph = state.current.assignment.round_speed_mph};
  switch (state.stage) {
    case Stage::kWaiting:
      return std::nullopt;
    case Stage::kForming:
      if (attacks) shown.flags.vehicle = VehicleFlag::kYellow;
      break;
    case Stage::kAttempt:
      if (state.attempt.phase != Phase::kClosingUp) shown.flags.track = TrackFlag::kWavingGreen;
      break;
    case Stage::kOver:
      shown.flags = {TrackFlag::kChequered,
                     state.is_black[car] ? VehicleFlag::kBlackPitIn : VehicleFlag::kNone};
      break;
  }
  return shown;
}

std::optional<Call> call_between(const JudgeState& before, const JudgeState& after,
                                 std::uint8_t car, Instant now) {
  const auto old = shown_to(before, car), fresh = shown_to(after, car);
  if (!fresh || old == fresh) return std::nullopt;
  return Call{.at = now,
              .track = fresh->flags.track,
              .vehicle = fresh->flags.vehicle,
              .round_target_speed_mph = fresh->round_speed_mph};
}

}  // namespace pitwall::race
