// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/race_fields.hpp"

#include <array>
#include <cmath>

#include "basestation/state/derived/gap.hpp"

namespace pitwall::state {
namespace {

using telemetry::field;
using telemetry::FieldIndex;

struct OpponentFields {
  FieldIndex station, speed;
};
constexpr std::array kOpponents{
    OpponentFields{field("opponent_1.station"), field("opponent_1.speed")},
    OpponentFields{field("opponent_2.station"), field("opponent_2.speed")},
    OpponentFields{field("opponent_3.station"), field("opponent_3.speed")},
    OpponentFields{field("opponent_4.station"), field("opponent_4.speed")}};
constexpr FieldIndex kOwnStation = field("track.station"), kOwnSpeed = field("ego.vx");

double value_at(const VehicleState& vehicle, FieldIndex index, Instant now) {
  return vehicle.view(index, now).value;
}
double usable_at(const VehicleState& vehicle, FieldIndex index, Instant now) {
  const FieldView view = vehicle.view(index, now);
  return usable(view) ? view.value : kUnset;
}

// Of those opponents that are known now; where none is, by what was last known of the first.
struct Opponents {
  Gaps gaps;
  FieldIndex source = kOpponents[0].station;
  bool now = false;
};
Opponents opponents_of(const VehicleState& vehicle, const Course* course, Instant now) {
  Opponents found;
  std::array<Runner, kOpponents.size()> runners{};
  for (std::size_t i = 0; i < kOpponents.size(); ++i) {
    runners[i] = {.station_m = usable_at(vehicle, kOpponents[i].station, now),
                  .speed_mps = usable_at(vehicle, kOpponents[i].speed, now)};
    if (std::isnan(runners[i].station_m) || found.now) continue;
    found.now = true;
    found.source = kOpponents[i].station;
  }
  if (!found.now) runners[0].station_m = value_at(vehicle, found.source, now);
  found.gaps = gaps_of({.station_m = value_at(vehicle, kOwnStation, now),
                        .speed_mps = value_at(vehicle, kOwnSpeed, now)},
                       runners, course != nullptr ? course->length_m() : kUnset);
  return found;
}

}  // namespace

void derive_race(const Pass& pass, const Known& known, const MonitorState& monitors,
                 const rules::FuelPlan& plan, const Course* course) {
  using enum BaseField;
  constexpr FieldIndex kVehicle = field("flags.vehicle"), kPlanned = field("planner.role"),
                       kLap = field("track.lap");
  pass.put(kFlagRelayed, known.expected.track_flag);
  const auto role = role_of_flag(pass.value(kVehicle));
  const double shown = role ? static_cast<double>(*role) : kUnset;
  const double differs = pass.value(kPlanned) - shown;
  pass.put(kRole, shown, {kVehicle});
  pass.put(kRoleConflict, std::isnan(differs) ? kUnset : (differs != 0.0 ? 1.0 : 0.0),
           {kVehicle, kPlanned});
  const Attempt attempt = monitors.attempts.attempt();
  pass.put(kAttempt, attempt.number, {field("flags.track")});
  pass.put(kAttemptState, std::isnan(attempt.number) ? kUnset : static_cast<double>(attempt.state),
           {field("flags.track")});
  pass.put(kAttemptLaps, attempt.laps, {kLap});
  pass.put(kAttemptLapsLeft, std::fmax(0.0, plan.attempt_laps - attempt.laps), {kLap});
  if (std::isnan(attempt.laps)) pass.put(kAttemptLapsLeft, kUnset);
  const Opponents seen = opponents_of(pass.vehicle, course, pass.now);
  const Gaps& gaps = seen.gaps;
  const bool behind_is_nearer =
      !(gaps.ahead.metres <= gaps.behind.metres) && !std::isnan(gaps.behind.metres);
  pass.put(kGapAhead, gaps.ahead.metres, {seen.source, kOwnStation});
  pass.put(kGapBehind, gaps.behind.metres, {seen.source, kOwnStation});
  pass.put(kGapClosing, (behind_is_nearer ? gaps.behind : gaps.ahead).closing_mps,
           {seen.source, kOwnSpeed});
}

void MonitorState::step_race(const VehicleState& vehicle, const rules::FuelPlan& plan,
                             const Course* course, Instant now) {
  const auto value = [&](FieldIndex index) { return usable_at(vehicle, index, now); };
  const Opponents seen = opponents_of(vehicle, course, now);
  attempts.receive({.track_flag = value(field("flags.track")),
                    .vehicle_flag = value(field("flags.vehicle")),
                    .lap = value(field("track.lap")),
                    .station_m = value(kOwnStation),
                    .course_m = course != nullptr ? course->length_m() : kUnset,
                    .gap_ahead_m = seen.now ? seen.gaps.ahead.metres : kUnset,
                    .gap_behind_m = seen.now ? seen.gaps.behind.metres : kUnset},
                   plan.attempt_laps, now);
}

}  // namespace pitwall::state
