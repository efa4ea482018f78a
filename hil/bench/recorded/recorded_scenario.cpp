// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/recorded_scenario.hpp"

#include <algorithm>
#include <cmath>

#include "hil/bench/recorded/operator_texts.hpp"
#include "protocol/vocabulary/text.hpp"
#include "vehicle/world/mode.hpp"

namespace pitwall::bench {
namespace {

constexpr double kMoving_mps = 1.0;

std::string quoted(const std::string& path) {
  std::string text = "\"";
  for (const char c : path) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

std::string header(const RunFacts& facts, const ScenarioSource& source) {
  std::string path = source.recording;
  std::ranges::replace_if(
      path, [](char c) { return c == '\n' || c == '\r'; }, '?');
  std::string text =
      "# Made of the recording " + path + ": a run of its car's black box.\n" +
      formatted(
          "# Time begins with the first frame that the car received, %.2f s "
          "after its first tick.\n",
          facts.first_frame.seconds()) +
      formatted("# Start: as the car knew it after %.2f s.\n", facts.start.known_at.seconds()) +
      "# Flags: when the car had decoded them.\n"
      "# No recording tells the seed, the wind, what the true car and track are "
      "like, or what failed:\n"
      "# the bench's own are used, and no fault.\n";
  if (!std::isfinite(facts.tyres_c))
    text += "# Tyres: the car never knew all four temperatures; the bench's own is used.\n";
  if (facts.joystick_ticks > 0)
    text += formatted("# Not here: the joystick was used in %llu ticks.\n",
                      static_cast<unsigned long long>(facts.joystick_ticks));
  if (facts.guardian_ticks > 0)
    text +=
        formatted("# Not here: the guardian drove in %llu ticks; name the fault that made it.\n",
                  static_cast<unsigned long long>(facts.guardian_ticks));
  return text;
}

std::string flags_text(const RunFacts& facts) {
  std::string text;
  for (const scenario::FlagChange& change : facts.flags) {
    text += formatted("  - {at_s: %.2f, track: %s", change.at.seconds(),
                      scenario::name_of(change.track));
    if (change.vehicle != world::VehicleFlag::kNone)
      text += formatted(", vehicle: %s", scenario::name_of(change.vehicle));
    if (change.round_target_speed_mph > 0.0)
      text += formatted(", round_target_speed_mph: %.0f", change.round_target_speed_mph);
    text += "}\n";
  }
  return text.empty() ? text : "race_control:\n" + text;
}

// A console takes the authority before the first command and keeps it until after the last.
std::string operator_text(const RunFacts& facts) {
  if (facts.operator_texts.empty()) return {};
  const AuthorityClaim claim = authority_for(facts.operator_texts);
  std::string text = formatted(
      "operator:\n  - {at_s: %.2f, say: %s, every_s: %.1f, until_s: %.2f}\n", claim.from.seconds(),
      AuthorityClaim::kText, AuthorityClaim::kEvery.seconds(), claim.until.seconds());
  for (const scenario::OperatorText& one : facts.operator_texts)
    text += formatted("  - {at_s: %.2f, say: %s}\n", one.at.seconds(), one.text.c_str());
  return text;
}

std::string within_text(const std::string& condition, double from_s, double until_s) {
  return formatted("  - {kind: within, %s, from_s: %.2f, until_s: %.2f}\n", condition.c_str(),
                   from_s, until_s);
}

std::string modes_text(const RunFacts& facts) {
  std::string text;
  const double end_s = facts.length.seconds(), slack_s = kModeSlack.seconds();
  for (std::size_t i = 1; i < facts.modes.size(); ++i) {
    const double at_s = facts.modes[i].at.seconds();
    if (at_s + slack_s > end_s) continue;  // the run is too short to show it
    text += within_text(formatted("signal: mode, is: \"==\", value: %.0f", facts.modes[i].value),
                        std::max(0.0, at_s - slack_s), at_s + slack_s);
  }
  for (std::size_t mode = 0; mode < world::kModes; ++mode)
    if (std::ranges::find(facts.modes, static_cast<double>(mode), &CommandSample::value) ==
        facts.modes.end())
      text += formatted("  - {kind: never, signal: mode, is: \"==\", value: %zu}\n", mode);
  return text;
}

std::string expectations_text(const RunFacts& facts) {
  std::string text = "expect:\n" + modes_text(facts);
  if (facts.speed_max_mps > kMoving_mps) {
    text += within_text(formatted("signal: speed_mps, is: \">\", value: %.2f",
                                  facts.speed_max_mps * (1.0 - kSpeedShare)),
                        0.0, facts.length.seconds());
    text += formatted("  - {kind: never, signal: speed_mps, is: \">\", value: %.2f}\n",
                      facts.speed_max_mps * (1.0 + kSpeedShare));
  }
  return text + formatted("  - {kind: always, signal: abs_cross_track_m, is: \"<\", value: %.2f}\n",
                          facts.off_line_max_m + kLineSlack_m);
}

}  // namespace

std::string scenario_text(const RunFacts& facts, const ScenarioSource& source) {
  std::string text =
      header(facts, source) +
      formatted("schema: 1\nname: recorded\nseed: 1\nduration_s: %.2f\n", facts.length.seconds()) +
      "track: " + quoted(source.files.track) + "\ncar: " + quoted(source.files.car) +
      formatted("\nstart: {s_m: %.2f, n_m: %.2f, speed_mps: %.2f}\n", facts.start.s_m,
                facts.start.n_m, facts.start.speed_mps);
  if (std::isfinite(facts.tyres_c))
    text += formatted("tyres: {temperature_c: %.1f}\n",
                      std::clamp(facts.tyres_c, scenario::kColdest_c, scenario::kHottest_c));
  return text + flags_text(facts) + operator_text(facts) + expectations_text(facts);
}

}  // namespace pitwall::bench
