// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/gates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "basestation/state/derived/flags.hpp"
#include "basestation/state/derived/tyre_gate.hpp"
#include "basestation/state/value_text.hpp"

namespace pitwall::command {
namespace {

using state::BaseField;
using state::FieldView;
using state::label_text;
using state::number_text;
using telemetry::CommandType;
using telemetry::field;

// Values of enumerations, as telemetry/registry/labels.hpp has them.
constexpr double kYellow = 3.0, kGreen = 4.0, kWavingGreen = 5.0;
constexpr std::array kVehicleFlagsThatAllow{0.0, 2.0, 9.0, 10.0};  // none, blue, the two roles
constexpr double kAttacker = 2.0;

// The judge of one command at one moment.
class Judge {
 public:
  Judge(const telemetry::Command& command, const GateParams& params, const GateInputs& in)
      : command_(command), params_(params), in_(in) {}

  std::vector<Gate> all() {
    using enum GateKind;
    link();
    if (telemetry::row_of(command_.type).needs_authority) authority();
    switch (command_.type) {
      case CommandType::kSpeedLimit:
        if (!slower()) faster();
        break;
      case CommandType::kArm:
        if (command_.argument > 0.0) stop(), alarms();
        break;
      case CommandType::kRole:
        if (command_.argument == kAttacker) stop(), flag(kUnset), fuel(), alarms();
        break;
      case CommandType::kTrackFlag:
        source();
        break;
      case CommandType::kReset:
      case CommandType::kReleaseStop:
      case CommandType::kEndRun:
        standing();
        break;
      case CommandType::kRaceLine:
        alarms();
        break;
      case CommandType::kSensorsExcluded:
      case CommandType::kFuelEntered:
      case CommandType::kSendParameters:
        break;
    }
    return std::move(gates_);
  }

 private:
  FieldView see(telemetry::FieldIndex index) const { return in_.vehicle.view(index, in_.now); }
  FieldView see(BaseField base) const {
    return in_.evaluator.view(in_.vehicle, state::id_of(base), in_.now);
  }

  // What the value is called: by its unit, or by a word of its own.
  struct Shown {
    std::string_view unit = {};
    std::string word = {};
  };
  // `ok` counts only where the value is known and not stale.
  void add(GateKind kind, const FieldView& seen, bool ok, Shown shown, std::string text) {
    const bool known = state::usable(seen) && !std::isnan(seen.value);
    if (!known) {
      const bool never = seen.quality == state::Quality::kNever || std::isnan(seen.value);
      text = (never ? "not received yet" : "too old: " + number_text(seen.age.seconds(), "s")) +
             std::string{"; "} + text;
    }
    gates_.push_back({.kind = kind,
                      .ok = known && ok,
                      .value = seen.value,
                      .unit = shown.unit,
                      .word = std::move(shown.word),
                      .age = seen.age,
                      .known = known,
                      .text = std::move(text)});
  }
  static FieldView own(double value) {  // of the base itself: always known
    return {.value = value, .age = {}, .quality = state::Quality::kFresh};
  }

  // What the car may drive now; without a limit of ours, what it drives.
  FieldView present_limit() const {
    const FieldView limit = see(field("planner.operator_limit"));
    return limit.quality == state::Quality::kNever ? see(field("ego.vx")) : limit;
  }
  // Also by a limit that was told long ago: lowering it must always be possible.
  bool slower() const {
    const double limit_mps = see(field("planner.operator_limit")).value;
    if (!std::isnan(limit_mps)) return command_.argument <= limit_mps;
    const FieldView speed = see(field("ego.vx"));
    return state::usable(speed) && command_.argument <= speed.value;
  }

  void faster() {
    stop();
    flag(command_.argument);
    tyres();
    step();
    corner();
    fuel();
    alarms();
  }

  void link() {
    using state::LinkState;
    const LinkState state = in_.evaluator.link_state();
    const bool enough = state == LinkState::kGood || (state == LinkState::kDegraded && harmless());
    FieldView seen = own(static_cast<double>(state));
    const FieldView silence = see(BaseField::kLinkSilence);
    if (state::usable(silence)) {
      seen.age = {static_cast<std::int64_t>(silence.value * 1e6)};  // of the newest packet
    }
    const std::string word = label_text(state::kLinkStates, seen.value);
    add(GateKind::kLink, seen, enough, {.word = word}, "link " + word);
  }
  bool harmless() const { return command_.type != CommandType::kSpeedLimit || slower(); }

  void authority() {
    add(GateKind::kAuthority, own(in_.holder),
        command_.issuer != 0 && in_.holder == command_.issuer,
        {.word = in_.holder == 0 ? "nobody" : "console " + std::to_string(in_.holder)},
        in_.holder == 0 ? "nobody holds it" : "held by console " + std::to_string(in_.holder));
  }

  void stop() {
    const FieldView seen = see(BaseField::kStop);
    const std::string word = label_text(telemetry::kStopLevels, seen.value);
    add(GateKind::kStop, seen, seen.value == 0.0, {.word = word}, word);
  }

  void flag(double speed_mps) {
    const FieldView track = see(field("flags.track_acted_on"));
    const FieldView vehicle = see(field("flags.vehicle_acted_on"));
    const bool slow_enough = speed_mps <= params_.caution_speed_mps;
    const bool track_allows = track.value == kGreen || track.value == kWavingGreen ||
                              (track.value == kYellow && slow_enough);
    const bool vehicle_allows =
        state::usable(vehicle) &&
        std::find(kVehicleFlagsThatAllow.begin(), kVehicleFlagsThatAllow.end(), vehicle.value) !=
            kVehicleFlagsThatAllow.end();
    add(GateKind::kFlag, track, track_allows && vehicle_allows,
        {.word = label_text(telemetry::kTrackFlags, track.value)},
        "track " + label_text(telemetry::kTrackFlags, track.value) + ", vehicle " +
            label_text(telemetry::kVehicleFlags, vehicle.value));
  }

  void tyres() {
    const FieldView coldest = see(BaseField::kTyreMin);
    const double needed_c = state::tyre_needed_c(in_.evaluator.tyre_gate(), command_.argument);
    add(GateKind::kTyres, coldest, coldest.value >= needed_c, {.unit = "degC"},
        number_text(coldest.value, "degC") + ", " + number_text(needed_c, "degC") + " needed for " +
            number_text(command_.argument, "m/s"));
  }

  void step() {
    const FieldView now = present_limit();
    const double step_mps = command_.argument - now.value;
    FieldView seen = now;
    seen.value = step_mps;
    add(GateKind::kStep, seen, step_mps <= params_.step_max_mps, {.unit = "m/s"},
        (step_mps > 0.0 ? "+" : "") + number_text(step_mps, "m/s") + ", at most +" +
            number_text(params_.step_max_mps, "m/s"));
  }

  void corner() {
    const FieldView ahead = see(BaseField::kCornerIn);
    add(GateKind::kCorner, ahead, ahead.value > params_.corner_ahead.seconds(), {.unit = "s"},
        ahead.value == 0.0 ? "in a corner"
                           : "a corner in " + number_text(ahead.value, "s") + ", more than " +
                                 number_text(params_.corner_ahead.seconds(), "s") + " needed");
  }

  void fuel() {
    const FieldView attempts = see(BaseField::kFuelAttempts);
    add(GateKind::kFuel, attempts, attempts.value >= 1.0, {.unit = "attempts"},
        number_text(see(BaseField::kFuelLaps).value, "laps") +
            ", attempts: " + number_text(attempts.value, "") +
            (see(BaseField::kFuelEstimated).value > 0.0 ? " (estimate)" : ""));
  }

  void alarms() {
    const auto high = static_cast<double>(in_.evaluator.alarms().count(alarms::Priority::kHigh));
    std::string list;
    for (const alarms::ListedAlarm& alarm : in_.evaluator.alarms().active())
      if (alarm.priority == alarms::Priority::kHigh)
        list += (list.empty() ? ": " : ", ") + std::string{alarm.text};
    add(GateKind::kAlarms, own(high), high == 0.0, {.unit = "high alarms"},
        (high == 0.0 ? std::string{"no high alarm"} : "high alarms") + list);
  }

  void source() {
    const FieldView acted_on = see(field("flags.track_acted_on"));
    const FieldView reported = see(field("flags.track"));
    const double wanted = command_.argument;
    if (state::restriction_of_track_flag(wanted) >=
            state::restriction_of_track_flag(acted_on.value) &&
        state::usable(acted_on)) {
      add(GateKind::kSource, acted_on, true,
          {.word = label_text(telemetry::kTrackFlags, acted_on.value)},
          "not less restrictive than now");
      return;
    }
    const std::string word = label_text(telemetry::kTrackFlags, reported.value);
    add(GateKind::kSource, reported, reported.value == wanted, {.word = word},
        "race control shows " + word);
  }

  // The car opens its latch by its own judgement, which waits until it has stood for a while.
  void standing() {
    const FieldView stands = see(field("wheels.standstill"));
    const FieldView speed = see(field("ego.vx"));
    const bool denied = state::usable(stands) && stands.value == 0.0;
    add(GateKind::kStanding, speed, !denied && std::abs(speed.value) <= params_.standing_mps,
        {.unit = "m/s"},
        denied ? "the car does not report a standstill yet"
               : number_text(speed.value, "m/s") + ", at most " +
                     number_text(params_.standing_mps, "m/s"));
  }

  const telemetry::Command& command_;
  const GateParams& params_;
  const GateInputs& in_;
  std::vector<Gate> gates_;
};

}  // namespace

std::string_view text_of(GateKind kind) {
  constexpr std::array<std::string_view, 11> kTexts{"link",   "authority", "stop",    "flag",
                                                    "tyres",  "step",      "corner",  "fuel",
                                                    "alarms", "source",    "standing"};
  return kTexts.at(static_cast<std::size_t>(kind));
}

bool can_be_overridden(GateKind kind) {
  return kind != GateKind::kLink && kind != GateKind::kAuthority && kind != GateKind::kStop;
}

std::vector<Gate> gates_of(const telemetry::Command& command, const GateParams& params,
                           const GateInputs& inputs) {
  return Judge{command, params, inputs}.all();
}

std::string refusals_of(const std::vector<Gate>& gates) {
  std::string list;
  for (const Gate& gate : gates) {
    if (gate.ok) continue;
    list += (list.empty() ? "" : "; ") + std::string{text_of(gate.kind)} + ": " + gate.text;
  }
  return list;
}

bool all_pass(const std::vector<Gate>& gates) {
  return std::all_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.ok; });
}

}  // namespace pitwall::command
