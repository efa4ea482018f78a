// Match of a run: puts the judge between the field and race control, and gives a ghost its orders.
//   in     the plan of the scenario; the field after every tick
//   out    calls for race control of each car; orders for a ghost; the match sheet, its verdicts
//   errors none: a scenario's match names a car of its field
//   cost   O(contacts) for a tick; it allocates at the end of an attempt
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "hil/bench/field.hpp"
#include "hil/bench/result.hpp"
#include "hil/nodes/judge.hpp"
#include "hil/nodes/match_sheet.hpp"
#include "hil/plant/car_pose.hpp"
#include "hil/scenario/match_section.hpp"
#include "protocol/rules/passing_rules.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

inline constexpr Duration kAfterMatch = seconds(20);  // the run goes on: the cars stop

class MatchRun {
 public:
  // The first car of the field is ours.
  MatchRun(const scenario::MatchPlan& plan, const Field& field, const world::TrackMap& track);

  // `declines`: whether a car with a stack does not make its attempt, as its team tells race
  // control; in the order of the field.
  void step(Field& field, std::span<const bool> declines, Instant now);
  // What the last step changed for a car of the field.
  std::optional<race::Call> call_for(std::size_t car, Instant now) const;
  // The attempt that ended in the last step, in one sentence.
  std::optional<std::string> ended_attempt() const;
  bool is_over(Instant now) const;
  race::MatchSheet sheet() const;

 private:
  bool is_inside(const plant::CarPose& pose) const;
  race::JudgedCar judged(const Field& field, std::span<const bool> declines, std::size_t car) const;
  std::optional<race::JudgedContact> contact(const Field& field) const;
  void order_ghost(Field& field);
  std::size_t attempts_by(std::uint8_t car) const;

  const scenario::MatchPlan& plan_;
  std::array<std::size_t, rules::kCars> cars_{};  // in the field
  race::JudgeParams params_;
  race::JudgeState before_, state_;
  double track_length_m_;
  bool rival_declines_ = false;
  std::optional<Instant> over_since_;
};

// The judge sees the field at the end of a tick; what it calls is sent from the next step on.
template <class Cars>
void step_match(MatchRun& match, Field& field, const Cars& cars, Instant at) {
  FixedVector<bool, kFieldMax> declines;
  for (const auto& car : cars) CHECK(declines.push(car->declines()));
  match.step(field, declines.span(), at);
  for (std::size_t i = 0; i < cars.size(); ++i)
    if (const auto call = match.call_for(i, at)) cars[i]->call_race_control(*call);
  if (const auto sentence = match.ended_attempt())
    for (const auto& car : cars) car->note_attempt(at, *sentence);
}

// Verdicts on what the scenario expects of its match.
void judge_match(const scenario::MatchPlan& plan, RunResult& result);

}  // namespace pitwall::bench
