// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hil/bench/signals.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

using json::Array;
using json::Object;

constexpr double kControlledStop = 3.0, kEmergencyStop = 4.0, kCoast = 6.0;  // of kModes

// Which flag binds the car more, in the car's own order.
int restriction_of(world::TrackFlag flag) {
  constexpr std::array kRestriction{2, 6, 5, 3, 1, 0, 4, 7};
  return kRestriction.at(static_cast<std::size_t>(flag));
}
int restriction_of(world::VehicleFlag flag) {
  using enum world::VehicleFlag;
  switch (flag) {
    case kBlackPitIn:
      return 4;
    case kStop:
    case kEngineKill:
    case kPurpleEmergency:
    case kUnknown:
      return 7;
    default:
      return 0;
  }
}

std::string mode_text(double mode) {
  if (!(mode >= 0.0)) return {};
  return std::string{telemetry::label_at(telemetry::kModes, static_cast<std::size_t>(mode))};
}

std::string fault_text(const scenario::Fault& fault) {
  std::string text = fault.kind;
  if (fault.unit != 0) text += " unit " + std::to_string(fault.unit);
  if (fault.can_id != 0) text += " id " + std::to_string(fault.can_id);
  if (!std::isnan(fault.value)) text += " " + formatted("%g", fault.value);
  return text;
}

std::string flags_text(const race::Flags& flags, double round_mph) {
  std::string text = scenario::name_of(flags.track);
  if (flags.vehicle != world::VehicleFlag::kNone)
    text += std::string{" + "} + scenario::name_of(flags.vehicle);
  if (round_mph > 0.0) text += " " + formatted("%g", round_mph) + " mph";
  return text;
}

// Which of the paper's figures the mean error keeps within.
std::string beats_text(const grading::ErrorStatistics& seen, double best_m, double mean_m) {
  if (seen.samples == 0) return "null";
  const double error_m = seen.mean_m();
  return json::quoted(error_m <= best_m ? "best" : error_m <= mean_m ? "mean" : "neither");
}

std::string brackets_text(const grading::CrossTrack& cross_track) {
  Array rows;
  for (std::size_t i = 0; i < grading::kBrackets.size(); ++i) {
    const grading::ErrorStatistics& seen = cross_track.by_bracket[i];
    const grading::Bracket& bracket = grading::kBrackets[i];
    rows.json(Object{}
                  .number("from_mps", bracket.from_mps)
                  .number("to_mps", bracket.to_mps > 1e6 ? kUnset : bracket.to_mps)
                  .number("paper_best_m", bracket.paper_best_m)
                  .number("paper_mean_m", bracket.paper_mean_m)
                  .number("samples", seen.samples)
                  .number("mean_m", seen.mean_m())
                  .number("max_m", seen.samples == 0 ? kUnset : seen.max_m)
                  .json("beats", beats_text(seen, bracket.paper_best_m, bracket.paper_mean_m))
                  .str());
  }
  return rows.str();
}

std::string overall_text(const grading::ErrorStatistics& overall) {
  return Object{}
      .number("paper_best_m", grading::kPaperBestOverall_m)
      .number("paper_mean_m", grading::kPaperMeanOverall_m)
      .number("samples", overall.samples)
      .number("mean_m", overall.mean_m())
      .number("max_m", overall.samples == 0 ? kUnset : overall.max_m)
      .json("beats",
            beats_text(overall, grading::kPaperBestOverall_m, grading::kPaperMeanOverall_m))
      .str();
}

std::string states_text(const std::vector<grading::ExpectationState>& expectation_states) {
  constexpr std::array kWords{"open", "holds", "failed"};
  Array words;
  for (const grading::ExpectationState state : expectation_states)
    words.json(json::quoted(kWords.at(static_cast<std::size_t>(state))));
  return words.str();
}

std::string reactions_text(const grading::ReactionMonitor& monitor) {
  Array rows;
  for (const grading::Reaction& one : monitor.reactions()) {
    rows.json(Object{}
                  .text("to", one.to)
                  .number("at_s", one.at.seconds())
                  .number("speed_mps", one.speed_mps)
                  .number("reaction_ms", one.reaction ? one.reaction->milliseconds() : kUnset)
                  .number("stop_m", one.stop_m.value_or(kUnset))
                  .str());
  }
  return rows.str();
}

grading::ReactionTick tick_of(const RunView& run, const race::Flags& flags) {
  const plant::Truth& truth = run.rig.truth();
  const bool by_vehicle = restriction_of(flags.vehicle) > restriction_of(flags.track);
  const bool stops =
      run.mode == kControlledStop || run.mode == kEmergencyStop || run.mode == kCoast;
  return {.at = run.now,
          .restriction = std::max(restriction_of(flags.track), restriction_of(flags.vehicle)),
          .flag = by_vehicle ? scenario::name_of(flags.vehicle) : scenario::name_of(flags.track),
          .stop = stops ? telemetry::label_at(telemetry::kModes, static_cast<std::size_t>(run.mode))
                        : std::string_view{},
          .speed_mps = truth.speed_mps,
          .throttle = truth.throttle_fraction,
          .brake_kpa = truth.brake_front_kpa};
}

}  // namespace

Progress::Progress(const scenario::Scenario& scenario, std::string_view mode, Print print)
    : scenario_(scenario), print_(std::move(print)) {
  plan_events();
  print_plan(mode);
}

void Progress::plan_events() {
  const Instant end = Instant{} + scenario_.duration;
  for (const scenario::Fault& fault : scenario_.faults) {
    planned_.push_back({Instant{} + fault.at, "fault_begins", fault_text(fault)});
    const Instant over = Instant{} + fault.at + fault.lasts;
    if (fault.lasts.ns > 0 && over <= end)
      planned_.push_back({over, "fault_ends", fault_text(fault)});
  }
  for (const scenario::OperatorText& word : scenario_.operator_texts)
    planned_.push_back({Instant{} + word.at, "operator", word.text});
  std::ranges::stable_sort(planned_, {}, &Planned::at);
}

void Progress::print_plan(std::string_view mode) {
  Array faults, flags, words, expected;
  for (const scenario::Fault& fault : scenario_.faults)
    faults.json(Object{}
                    .text("what", fault_text(fault))
                    .number("at_s", fault.at.seconds())
                    .number("lasts_s", fault.lasts.seconds())
                    .str());
  for (const scenario::FlagChange& change : scenario_.race_control)
    flags.json(
        Object{}
            .text("what", flags_text({change.track, change.vehicle}, change.round_target_speed_mph))
            .text("track", scenario::name_of(change.track))
            .number("at_s", change.at.seconds())
            .str());
  for (const scenario::OperatorText& word : scenario_.operator_texts)
    words.json(Object{}.text("what", word.text).number("at_s", word.at.seconds()).str());
  if (const auto expectations = expectations_of(scenario_))
    for (const grading::Expectation& one : *expectations)
      expected.json(json::quoted(grading::to_string(one)));
  print_(Object{}
             .text("type", "plan")
             .text("scenario", scenario_.name)
             .number("seed", scenario_.seed)
             .text("mode", mode)
             .number("duration_s", scenario_.duration.seconds())
             .json("faults", faults.str())
             .json("flags", flags.str())
             .json("operator", words.str())
             .json("expect", expected.str())
             .str());
}

void Progress::observe(const RunView& run) {
  note_changes(run);
  reactions_.observe(tick_of(run, flags_));
  if (run.now < due_) return;
  due_ = run.now + kEvery;
  print_state(run);
}

void Progress::note_changes(const RunView& run) {
  for (; next_planned_ < planned_.size() && planned_[next_planned_].at <= run.now; ++next_planned_)
    print_event(planned_[next_planned_].at, planned_[next_planned_].kind,
                planned_[next_planned_].text);
  if (!(run.rig.flags() == flags_)) {
    flags_ = run.rig.flags();
    print_event(run.now, "flag", flags_text(flags_, run.rig.round_target_speed_mph()));
  }
  if (run.mode != mode_ && !std::isnan(run.mode)) {
    mode_ = run.mode;
    print_event(run.now, "mode", mode_text(mode_));
  }
  if (run.rig.laps().finished != laps_) {
    laps_ = run.rig.laps().finished;
    print_event(run.now, "lap", std::to_string(laps_));
  }
  for (; actions_published_ < run.result.done.size(); ++actions_published_)
    print_event(run.result.done[actions_published_].at, "done",
                run.result.done[actions_published_].what);
}

void Progress::print_state(const RunView& run) {
  const Laps& laps = run.rig.laps();
  const auto& nearest = run.result.outcome.nearest;
  print_(Object{}
             .text("type", "at")
             .number("t_s", run.now.seconds())
             .number("speed_mps", run.rig.truth().speed_mps)
             .text("mode", mode_text(run.mode))
             .text("flag", scenario::name_of(run.rig.flags().track))
             .number("laps", laps.finished)
             .number("last_lap_s", laps.last_s)
             .number("best_lap_s", laps.best_flying_s)
             .number("wall_gap_m", nearest ? nearest->wall_gap_m : kUnset)
             .flag("contact", run.result.outcome.last && run.result.outcome.last->contact)
             .json("overall", overall_text(run.result.cross_track.overall))
             .json("cross_track", brackets_text(run.result.cross_track))
             .json("expect", states_text(run.grader.expectation_states()))
             .json("reactions", reactions_text(reactions_))
             .number("reactions_left_out", reactions_.left_out())
             .number("events_left_out", events_ > kEventsMax ? events_ - kEventsMax : 0)
             .str());
}

void Progress::print_event(Instant at, std::string_view kind, const std::string& text) {
  if (++events_ > kEventsMax) return;
  print_(Object{}
             .text("type", "event")
             .number("t_s", at.seconds())
             .text("kind", kind)
             .text("text", text)
             .str());
}

void Progress::ended(const RunResult& result) {
  if (has_contact(result.outcome))
    print_event(result.outcome.last->at, "contact", to_text(result.outcome));
  if (result.car_contact)
    print_event(result.car_contact->at, "contact", to_text(*result.car_contact));
  print_(Object{}
             .text("type", "result")
             .flag("passed", result.passed())
             .flag("timely", result.timely())
             .json("reactions", reactions_text(reactions_))
             .json("result", to_json(result))
             .str());
}

void Progress::failed(const Problem& problem) {
  print_(Object{}.text("type", "failure").text("what", to_string(problem)).str());
}

}  // namespace pitwall::bench
