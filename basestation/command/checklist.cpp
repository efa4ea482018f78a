// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/checklist.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "basestation/state/value_text.hpp"

namespace pitwall::command {
namespace {

using state::BaseField;
using state::FieldView;
using state::label_text;
using state::number_text;
using telemetry::field;

FieldView own(double value) {  // of the base itself: always known
  return {.value = value, .age = {}, .quality = state::Quality::kFresh};
}

bool known(const FieldView& seen) { return state::usable(seen) && !std::isnan(seen.value); }

// Who looks at everything once.
class Checker {
 public:
  explicit Checker(const CheckInputs& in) : in_(in) {}

  std::vector<Check> all() {
    link();
    software();
    clocks();
    disk();
    settings();
    authority();
    joystick();
    corrections();
    tyres();
    fuel();
    stop();
    alarms();
    return std::move(checks_);
  }

 private:
  FieldView see(telemetry::FieldIndex index) const { return in_.vehicle.view(index, in_.now); }
  FieldView see(BaseField base) const {
    return in_.evaluator.view(in_.vehicle, state::id_of(base), in_.now);
  }
  // Known, and neither a warning nor bad by the limits in force.
  bool good(BaseField base) const {
    const FieldView seen = see(base);
    const alarms::Evaluation judged = in_.evaluator.evaluate(state::id_of(base), seen);
    return known(seen) && judged != alarms::Evaluation::kWarning &&
           judged != alarms::Evaluation::kBad;
  }

  // `go` counts only where all of `seen` is known and not stale; the age is that of the oldest.
  void add(CheckKind kind, std::initializer_list<FieldView> seen, bool go, std::string text) {
    Check check{.kind = kind, .known = true, .text = std::move(text)};
    bool never = false;
    for (const FieldView& one : seen) {
      check.known = check.known && known(one);
      never = never || one.quality == state::Quality::kNever || std::isnan(one.value);
      check.age = std::max(check.age, one.age);
    }
    if (!check.known) {
      check.text = (never ? "not known" : "too old: " + number_text(check.age.seconds(), "s")) +
                   std::string{"; "} + check.text;
    }
    check.go = check.known && go;
    checks_.push_back(std::move(check));
  }

  void link() {
    const state::LinkState state = in_.evaluator.link_state();
    FieldView seen = own(static_cast<double>(state));
    const FieldView silence = see(BaseField::kLinkSilence);
    if (known(silence)) seen.age = milliseconds(static_cast<std::int64_t>(silence.value));
    const FieldView loss = see(BaseField::kDownLoss);
    add(CheckKind::kLink, {seen}, state == state::LinkState::kGood,
        label_text(state::kLinkStates, seen.value) +
            (known(loss) ? ", " + number_text(100.0 * loss.value, "% lost") : ""));
  }

  void software() {
    const FieldView car = see(field("uplink.schema_agrees"));
    const FieldView base = see(BaseField::kSchemaDiffers);
    const bool agree = car.value == 1.0 && base.value == 0.0;
    add(CheckKind::kSoftware, {car, base}, agree,
        agree ? "car and base agree on the packets" : "car and base differ on the packets");
  }

  void clocks() {
    const FieldView offset = see(BaseField::kClockOffset);
    add(CheckKind::kClocks, {offset}, good(BaseField::kClockOffset),
        "base " + number_text(offset.value, "ms") + " from UTC at the most");
  }

  void disk() {
    const FieldView recording = see(BaseField::kRecording);
    const FieldView minutes = see(BaseField::kDiskMinutes);
    constexpr double kOn = 1.0;  // of state::kRecordingStates
    const std::string state = "recording " + label_text(state::kRecordingStates, recording.value);
    if (recording.value != kOn) return add(CheckKind::kDisk, {recording}, false, state);
    add(CheckKind::kDisk, {recording, minutes}, good(BaseField::kDiskMinutes),
        state + ", room for " + number_text(minutes.value, "min"));
  }

  void settings() {
    const SettingsState& is = in_.settings;
    const char* const file = !is.readable ? ", the file is unreadable: built-in limits"
                             : is.kept    ? ", of the file"
                                          : ", no file keeps them";
    add(CheckKind::kSettings, {own(0.0)}, is.kept && is.readable, "version " + is.version + file);
  }

  void authority() {
    add(CheckKind::kAuthority, {own(in_.holder)}, in_.holder != 0,
        in_.holder == 0 ? "nobody holds it" : "held by " + in_.holder_name);
  }

  void joystick() {
    constexpr std::array<const char*, 4> kTexts{"none connected", "connected, released",
                                                "a hand is on it", "silent or unplugged"};
    const auto state = static_cast<std::size_t>(in_.joystick);
    add(CheckKind::kJoystick, {own(static_cast<double>(state))},
        in_.joystick == JoystickState::kNone || in_.joystick == JoystickState::kReleased,
        kTexts.at(state));
  }

  void corrections() {
    const FieldView conflict = see(BaseField::kCorrectionConflict);
    const FieldView age = see(BaseField::kCorrectionAge);
    add(CheckKind::kCorrections, {conflict, age},
        conflict.value == 0.0 && good(BaseField::kCorrectionAge),
        (conflict.value > 0.0 ? "somebody else uses the login, " : "one login, ") +
            std::string{"corrections "} + number_text(age.value, "s") + " old");
  }

  void tyres() {
    const FieldView pressure = see(BaseField::kTyrePressureMin);
    const FieldView coldest = see(BaseField::kTyreMin);
    add(CheckKind::kTyres, {pressure, coldest}, good(BaseField::kTyrePressureMin),
        "softest " + number_text(pressure.value, "kPa") + ", coldest " +
            number_text(coldest.value, "\u00b0C"));
  }

  void fuel() {
    const FieldView attempts = see(BaseField::kFuelAttempts);
    const bool estimated = see(BaseField::kFuelEstimated).value > 0.0;
    add(CheckKind::kFuel, {attempts}, attempts.value >= 1.0,
        number_text(see(BaseField::kFuelLaps).value, "laps") + ", " +
            number_text(attempts.value, "attempts") + (estimated ? " (estimate)" : ""));
  }

  void stop() {
    const FieldView seen = see(BaseField::kStop);
    add(CheckKind::kStop, {seen}, seen.value == 0.0,
        label_text(telemetry::kStopLevels, seen.value));
  }

  void alarms() {
    const auto high = in_.evaluator.alarms().count(alarms::Priority::kHigh);
    add(CheckKind::kAlarms, {own(0.0)}, high == 0, std::to_string(high) + " high");
  }

  const CheckInputs& in_;
  std::vector<Check> checks_;
};

}  // namespace

std::string_view text_of(CheckKind kind) {
  constexpr std::array<std::string_view, kChecks> kTexts{
      "link",      "software", "clocks",          "disk",  "limits and alarms",
      "authority", "joystick", "RTK corrections", "tyres", "fuel",
      "stop",      "alarms"};
  return kTexts.at(static_cast<std::size_t>(kind));
}

std::vector<Check> checks_of(const CheckInputs& inputs) { return Checker{inputs}.all(); }

bool all_go(const std::vector<Check>& checks) {
  return !checks.empty() && std::ranges::all_of(checks, &Check::go);
}

}  // namespace pitwall::command
