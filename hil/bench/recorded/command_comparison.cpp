// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/command_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "basestation/state/value_text.hpp"
#include "protocol/vocabulary/text.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/io/black_box.hpp"

namespace pitwall::bench {
namespace {

using Samples = std::span<const CommandSample>;
constexpr double kPercent = 100.0;
constexpr const char* kModeSignal = "mode.mode";

std::string mode_text(double mode) {
  return state::value_text(telemetry::kFields[telemetry::field(kModeSignal)], mode);
}

std::string name_of(std::size_t actuator) {
  const auto [message, signal] = kCommandSignals[actuator];
  return std::string(message) + "." + std::string(signal);
}

// The samples from `from` to `to`, both included.
Samples between(Samples samples, Duration from, Duration to) {
  const auto first = std::ranges::lower_bound(samples, from, {}, &CommandSample::at);
  const auto end = std::ranges::upper_bound(samples, to, {}, &CommandSample::at);
  return first < end ? Samples{first, end} : Samples{};
}

double mode_at(Samples modes, Duration at) {
  const auto after = std::ranges::upper_bound(modes, at, {}, &CommandSample::at);
  return after == modes.begin() ? kUnset : std::prev(after)->value;
}

class Finder {
 public:
  Finder(const CommandTrace& recorded, const CommandTrace& again,
         const CommandTolerances& tolerances)
      : recorded_(recorded), again_(again), tolerances_(tolerances) {
    out_.compared = std::min(recorded.length, again.length);
  }

  CommandComparison find() {
    compare_lengths();
    compare_modes();
    for (std::size_t i = 0; i < kActuators; ++i) compare_commands(i);
    std::ranges::stable_sort(out_.differences, {},
                             [](const SignalDifference& d) { return d.first.at.ns; });
    return std::move(out_);
  }

 private:
  void compare_lengths() {
    if (recorded_.length - again_.length <= tolerances_.lag()) return;
    note("run (seconds)", again_.length, recorded_.length.seconds(), again_.length.seconds());
  }

  // Of both sequences, place by place: after a mode that is not the same the rest says nothing.
  void compare_modes() {
    const std::vector<CommandSample> recorded = lasting(within(recorded_.modes));
    const std::vector<CommandSample> again = lasting(within(again_.modes));
    const std::size_t both = std::min(recorded.size(), again.size());
    for (std::size_t i = 0; i < both; ++i, ++out_.modes) {
      const Duration lag = again[i].at - recorded[i].at;
      if (recorded[i].value != again[i].value)
        return note(kModeSignal, std::min(recorded[i].at, again[i].at), recorded[i].value,
                    again[i].value);
      if (std::max(lag, -lag) > tolerances_.mode_lag())
        note("mode.mode (seconds)", recorded[i].at, recorded[i].at.seconds(),
             again[i].at.seconds());
    }
    const bool is_missing = recorded.size() > both;
    if (recorded.size() == again.size()) return;
    const CommandSample& more = is_missing ? recorded[both] : again[both];
    if (out_.compared - more.at <= tolerances_.mode_lag()) return;  // it may come yet
    const double before = both == 0 ? kUnset : recorded[both - 1].value;
    note(kModeSignal, more.at, is_missing ? more.value : before, is_missing ? before : more.value);
  }

  // Without the modes that ended within mode_lag: the other run may have left them out.
  std::vector<CommandSample> lasting(Samples modes) const {
    std::vector<CommandSample> out;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const bool is_last = i + 1 == modes.size();
      if (!is_last && modes[i + 1].at - modes[i].at <= tolerances_.mode_lag()) continue;
      if (out.empty() || out.back().value != modes[i].value) out.push_back(modes[i]);
    }
    return out;
  }

  void compare_commands(std::size_t actuator) {
    const Samples recorded = within(recorded_.commands[actuator]);
    const Samples again = within(again_.commands[actuator]);
    const double tolerance = tolerances_.command[actuator];
    for (const CommandSample& sample : recorded) {
      const auto nearest = nearest_to(sample, again);
      ++out_.commands;
      if (!nearest) {
        note(name_of(actuator) + " (frame)", sample.at, 1.0, 0.0);
      } else if (std::abs(*nearest - sample.value) > tolerance) {
        note(name_of(actuator), sample.at, sample.value, *nearest);
      }
    }
    for (const CommandSample& sample : again)
      if (!nearest_to(sample, recorded)) note(name_of(actuator) + " (frame)", sample.at, 0.0, 1.0);
  }

  std::optional<double> nearest_to(const CommandSample& sample, Samples others) const {
    std::optional<double> nearest;
    for (const CommandSample& other : between(others, sample.at - tolerances_.command_lag(),
                                              sample.at + tolerances_.command_lag()))
      if (!nearest || std::abs(other.value - sample.value) < std::abs(*nearest - sample.value))
        nearest = other.value;
    return nearest;
  }

  // What both runs have; near the end the other's answer may lie behind it.
  Samples within(const std::vector<CommandSample>& samples) const {
    return between(samples, Duration{}, out_.compared);
  }

  void note(const std::string& signal, Duration at, double recorded, double again) {
    const Divergence here{.tick = static_cast<std::uint64_t>(at / tolerances_.tick),
                          .at = Instant{} + at,
                          .recorded = recorded,
                          .again = again};
    auto found = std::ranges::find(out_.differences, signal, &SignalDifference::signal);
    if (found == out_.differences.end())
      found = out_.differences.insert(
          found, {.signal = signal,
                  .first = here,
                  .largest = here,
                  .context = "in mode " + mode_text(mode_at(recorded_.modes, at))});
    ++found->values;
    if (here.size() > found->largest.size()) found->largest = here;
  }

  const CommandTrace &recorded_, &again_;
  const CommandTolerances& tolerances_;
  CommandComparison out_;
};

double step_of(const can::Database& database, std::size_t actuator) {
  const auto [message_name, signal_name] = kCommandSignals[actuator];
  const can::Message* const message = database.find(message_name);
  const can::Signal* const signal = message == nullptr ? nullptr : message->find(signal_name);
  return signal == nullptr ? 0.0 : signal->layout.scale;
}

}  // namespace

Duration CommandTolerances::mode_lag() const {
  return lag() + tick * static_cast<std::int64_t>(io::BlackBox::kStateEvery);
}

CommandTolerances tolerances_of(const pipeline::CarParams& params, const can::Database& database) {
  const safety::SupervisorParams& slews = params.supervisor;
  const control::LongitudinalParams& speed = params.control.longitudinal;
  const std::array<double, kActuators> per_s{
      kPercent * std::max(slews.throttle_rise_per_s, speed.throttle_fall_per_s),
      std::max(slews.brake_rise_kpa_per_s, slews.brake_fall_kpa_per_s),
      to_deg(slews.steer_slew_rad_per_s) * slews.steering_ratio, 0.0};
  CommandTolerances out{.tick = params.rates.tick, .planning = params.rates.planning};
  for (std::size_t i = 0; i < kActuators; ++i)
    out.command[i] = per_s[i] == 0.0 ? 0.0 : per_s[i] * out.tick.seconds() + step_of(database, i);
  return out;
}

CommandComparison compare(const CommandTrace& recorded, const CommandTrace& again,
                          const CommandTolerances& tolerances) {
  return Finder{recorded, again, tolerances}.find();
}

}  // namespace pitwall::bench
