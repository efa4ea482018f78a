// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/alarm_table.hpp"

#include <charconv>
#include <cmath>

#include "protocol/telemetry/session/link_threats.hpp"

namespace pitwall::alarms {
namespace {

using state::field_id;
using telemetry::describe;
using telemetry::Threat;

constexpr Situations in(std::initializer_list<Situation> list) {
  Situations set;
  for (const Situation one : list) set.set(one, true);
  return set;
}
constexpr Situations kAnywhere = in({});
constexpr Situations kReceived = in({Situation::kLinkLost});  // of the car, as long as it is heard
constexpr Situations kReceiverInUse = in({Situation::kLinkLost, Situation::kReceiverExcluded});
constexpr Situations kArmed = in({Situation::kLinkLost, Situation::kDisarmed});
constexpr Situations kDriving =
    in({Situation::kLinkLost, Situation::kDisarmed, Situation::kStanding, Situation::kInPit});
constexpr Situations kRunning = in({Situation::kLinkLost, Situation::kEngineOff});

constexpr Duration kAtOnce{}, kBlink = milliseconds(100), kShort = milliseconds(500);
constexpr Duration kSecond = seconds(1), kSteady = seconds(2), kLong = seconds(5);

// An alarm that overrules another stands before it.
constexpr auto kAlarmTable = [] {
  using enum Priority;
  constexpr Side kAbove = Side::kAbove, kBelow = Side::kBelow;
  constexpr double kYes = 0.5;
  return std::to_array<AlarmRow>({
      {"link_lost", "No packet from the car",
       "Tell race control. The car stops by its own rule. Check antenna and radios", kHigh,
       field_id("link.state"), kAbove, 2.5, 0.0, kAtOnce, kSteady, false, kAnywhere},
      {"link_degraded", "The radio is degraded",
       "Tell race control, with the figures of the notice. No call: the car drives on", kMedium,
       field_id("link.state"), kAbove, 1.5, 0.0, kAtOnce, kAtOnce, false, kAnywhere, "link_lost"},
      // Whoever sends can raise these, so none is high but the one that takes our keys:
      // a high alarm bars commands.
      {"second_peer", describe(Threat::kSecondPeer),
       "Switch the other one off: a spare base, a car on the bench. If it is not ours, the keys "
       "are stolen: new key files at both ends before the car drives",
       kHigh, field_id("link.second_peer"), kAbove, kYes, 0.0, kAtOnce, kLong, false, kAnywhere},
      {"wrong_key", describe(Threat::kWrongKey),
       "No link: copy both key files of one keygen again. Link good: find the sender in the "
       "recording",
       kMedium, field_id("link.wrong_key"), kAbove, kYes, 0.0, kAtOnce, kLong, false, kAnywhere},
      {"mode_mismatch", describe(Threat::kModeMismatch),
       "Set signed_only in the car file and --signed at the base alike; start that end again",
       kMedium, field_id("link.mode_mismatch"), kAbove, kYes, 0.0, kAtOnce, kLong, false,
       kAnywhere},
      {"replayed_openings", describe(Threat::kReplayedOpenings),
       "Find the sender in the recording; tell race control. Stops pass all the same", kMedium,
       field_id("link.replayed_openings"), kAbove, kYes, 0.0, kAtOnce, kLong, false, kAnywhere},
      {"relay", describe(Threat::kRelay),
       "Look for a loop between our radios. If there is none, tell race control; stop the car if "
       "the link gets worse",
       kMedium, field_id("link.relay"), kAbove, kYes, 0.0, kAtOnce, kLong, false, kAnywhere},
      {"refused_at_rate", describe(Threat::kRefusedAtRate),
       "Find the sender in the recording and block it at the router. Nothing of it has an effect",
       kMedium, field_id("link.refused_at_rate"), kAbove, kYes, 0.0, kAtOnce, kLong, false,
       kAnywhere},
      {"emergency_stop",
       "Emergency stop",
       "Tell race control. Nobody near the car before it is released at standstill",
       kHigh,
       field_id("derived.stop"),
       kAbove,
       1.5,
       0.0,
       kAtOnce,
       kAtOnce,
       true,
       kAnywhere,
       {},
       true},
      {"controlled_stop", "Controlled stop", "Tell race control where the car will stand", kHigh,
       field_id("derived.stop"), kAbove, kYes, 0.0, kAtOnce, kAtOnce, true, kAnywhere,
       "emergency_stop", true},
      {"watchdog_lost", "A watchdog of the car has tripped",
       "Confirm that the car stops; else controlled stop", kHigh,
       field_id("derived.watchdogs_lost"), kAbove, kYes, 0.0, kAtOnce, kSecond, false, kArmed},
      {"watchdog_late", "A stream of the car is late", "See which; be ready to stop", kMedium,
       field_id("derived.watchdogs_late"), kAbove, kYes, 0.0, kShort, kSecond, false, kArmed,
       "watchdog_lost"},
      {"gnss_both_bad", "Both GNSS receivers are bad", "Controlled stop, unless the car stops",
       kHigh, field_id("derived.gnss_good"), kBelow, kYes, 0.0, kBlink, kSecond, false, kReceived},
      {"gnss_one_bad", "One GNSS receiver is bad",
       "Decide whether to drive on with the other; exclude the bad one if it misleads", kMedium,
       field_id("derived.gnss_good"), kBelow, 1.5, 0.0, kShort, kSteady, false, kReceiverInUse,
       "gnss_both_bad"},
      {"position_lost", "The car does not know where it is", "Confirm that the car stops", kHigh,
       field_id("ego.validity"), kAbove, 2.5, 0.0, kAtOnce, kSecond, false, kArmed},
      {"dead_reckoning", "The car drives without a position fix", "Slow down; be ready to stop",
       kMedium, field_id("ego.validity"), kAbove, 1.5, 0.0, kShort, kSecond, false, kArmed,
       "position_lost"},
      {"corrections_missing", "No RTK corrections for long", "Slow down", kHigh,
       field_id("derived.correction_age"), kAbove, 15.0, 2.0, kAtOnce, kSteady, false, kReceived},
      {"corrections_old", "RTK corrections are old", "Check the caster and the modem", kMedium,
       field_id("derived.correction_age"), kAbove, 5.0, 1.0, kAtOnce, kSteady, false, kReceived,
       "corrections_missing"},
      {"correction_conflict", "RTK corrections come and go in both receivers",
       "Check who else is logged in with our RTK login", kMedium,
       field_id("derived.correction_conflict"), kAbove, kYes, 0.0, kAtOnce, kLong, false,
       kReceived},
      {"wheel_slip", "The rear wheels are faster than the car", "Lift: lower the speed limit now",
       kHigh, field_id("derived.slip"), kAbove, 0.08, 0.02, kBlink, kSecond, false, kReceived},
      {"tyres_cold", "Tyres are too cold for the speed asked", "Warm-up laps at a lower speed",
       kMedium, field_id("derived.tyre_margin"), kBelow, 0.0, 3.0, kSecond, kSteady, false,
       kDriving},
      {"tyre_pressure_low", "A tyre loses its air", "Controlled stop; look at the wheel", kMedium,
       field_id("derived.tyre_pressure_min"), kBelow, 100.0, 10.0, kSecond, kSteady, false,
       kDriving},
      {"off_line_far", "The car is far from its line", "Slow down; stop if it grows", kHigh,
       field_id("derived.cross_track"), kAbove, 2.0, 0.3, kBlink, kSecond, false, kDriving},
      {"off_line", "The car is off its line", "Slow down", kMedium, field_id("derived.cross_track"),
       kAbove, 1.25, 0.2, kBlink, kSecond, false, kDriving, "off_line_far"},
      {"sensor_gap", "A sensor was silent for half a second", "End the run, if it comes again",
       kHigh, field_id("derived.sensor_gap_ms"), kAbove, 500.0, 50.0, kAtOnce, kSteady, false,
       kArmed},
      {"sensor_rate_half", "A sensor comes at less than half its rate", "End the run", kHigh,
       field_id("derived.sensor_rate_share"), kBelow, 0.5, 0.05, kSecond, kSteady, false, kArmed},
      {"sensor_rate_low", "A sensor comes too seldom", "See which; look at the computer's load",
       kMedium, field_id("derived.sensor_rate_share"), kBelow, 0.8, 0.05, kSecond, kSteady, false,
       kArmed, "sensor_rate_half"},
      {"sensor_latency", "A sensor comes too late", "See which; look at the computer's load", kLow,
       field_id("derived.sensor_latency_share"), kAbove, 1.0, 0.1, kSecond, kSteady, false, kArmed},
      {"camera_offset", "A camera does not see cars where the LiDARs see them",
       "Look which; exclude it (exclude camera0) and calibrate it", kMedium,
       field_id("derived.camera_offset_share"), kAbove, 1.0, 0.2, kSecond, kSteady, false,
       kReceived},
      {"flag_conflict", "Race control, car and pit wall do not mean the same flag",
       "The most restrictive holds. Call race control", kHigh, field_id("derived.flag_conflict"),
       kAbove, kYes, 0.0, kSecond, kSecond, false, kReceived},
      {"round_speed_conflict", "The round speed is not what was announced",
       "Call race control before green", kHigh, field_id("derived.round_speed_conflict"), kAbove,
       kYes, 0.0, kSecond, kSecond, false, kReceived},
      {"fuel_home_now", "Fuel for less than the lap home", "Pit now, or stop at a safe place",
       kHigh, field_id("derived.fuel_state"), kAbove, 2.5, 0.0, kSecond, kSteady, false, kReceived},
      {"fuel_no_attempt", "No fuel for another attempt and home",
       "Do not accept the round; refuel first", kMedium, field_id("derived.fuel_state"), kAbove,
       1.5, 0.0, kSecond, kSteady, false, kReceived, "fuel_home_now"},
      {"oil_pressure_low", "Oil pressure is low", "Engine off after a controlled stop", kHigh,
       field_id("engine.oil_pressure"), kBelow, 100.0, 20.0, kSecond, kSteady, false, kRunning},
      {"coolant_hot", "Coolant is too hot", "Slow down; end the run if it rises", kMedium,
       field_id("engine.coolant"), kAbove, 110.0, 3.0, kSteady, kLong, false, kRunning},
      {"fuel_pressure_low", "Fuel pressure is low", "Slow down; into the pits", kMedium,
       field_id("engine.fuel_pressure"), kBelow, 150.0, 20.0, kSecond, kSteady, false, kRunning},
      {"transmission_hot", "Transmission is too hot", "Slow down", kLow,
       field_id("powertrain.transmission"), kAbove, 140.0, 3.0, kSteady, kLong, false, kRunning},
      {"battery_low", "Battery voltage is low", "Into the pits; look at the alternator", kMedium,
       field_id("electric.battery"), kBelow, 12.0, 0.3, kSteady, kLong, false, kReceived},
      {"steering_hot", "The steering motor is hot", "End the run after this lap", kLow,
       field_id("steering_unit.temperature"), kAbove, 90.0, 3.0, kSteady, kLong, false, kReceived},
      {"bus_off", "The car's CAN bus is off", "Confirm that the car stops", kHigh,
       field_id("bus.controller"), kAbove, 3.5, 0.0, kAtOnce, kSecond, false, kReceived},
      {"computer_hot", "The car's computer is hot", "Into the pits; look at the cooling", kMedium,
       field_id("computer.temperature"), kAbove, 90.0, 3.0, kSteady, kLong, false, kReceived},
      {"computer_busy", "The car's computer is busy", "Switch off what is not needed", kLow,
       field_id("computer.processor"), kAbove, 0.9, 0.05, kLong, kLong, false, kReceived},
      {"picture_old", "Parts of the picture are old",
       "Look at the link page; lower the budget of "
       "what is not needed",
       kLow, field_id("link.stale_groups"), kAbove, kYes, 0.0, kSteady, kSteady, false, kReceived},
      {"schema_differs", "Car and base do not speak the same telemetry",
       "Same version on both, before the run", kMedium, field_id("base.schema_differs"), kAbove,
       kYes, 0.0, kSecond, kAtOnce, false, kAnywhere},
      {"authority_lost", "Nobody holds the authority any more", "Take it, or drop it on purpose",
       kMedium, field_id("base.authority_lost"), kAbove, kYes, 0.0, kAtOnce, kAtOnce, false,
       kAnywhere},
      {"joystick_lost", "The joystick is silent", "Plug it in, or end its use", kMedium,
       field_id("base.joystick_lost"), kAbove, kYes, 0.0, kAtOnce, kSecond, false, kAnywhere},
      {"settings_unreadable", "Settings file unreadable: built-in limits in force",
       "Its line is told in the audit log. Mend it and start again, or change a setting: a new "
       "file "
       "is written, the broken one kept beside",
       kMedium, field_id("base.settings_unreadable"), kAbove, kYes, 0.0, kAtOnce, kAtOnce, false,
       kAnywhere},
      {"clock_offset", "The base's clock is off", "Look at the time service", kLow,
       field_id("base.clock_offset_ms"), kAbove, 5.0, 1.0, kLong, kLong, false, kAnywhere},
      {"disk_full", "The recorder's disk is nearly full", "Make room, or change the disk", kMedium,
       field_id("base.disk_minutes"), kBelow, 10.0, 5.0, kSecond, kLong, false, kAnywhere},
  });
}();

constexpr std::optional<AlarmIndex> find(std::string_view key) {
  for (AlarmIndex i = 0; i < kAlarmTable.size(); ++i)
    if (kAlarmTable[i].key == key) return i;
  return std::nullopt;
}

static_assert(
    [] {
      for (AlarmIndex i = 0; i < kAlarmTable.size(); ++i) {
        const AlarmRow& row = kAlarmTable[i];
        if (row.key.empty() || row.text.empty() || row.response.empty()) return false;
        if (find(row.key) != i || row.deadband < 0.0) return false;  // each key once
        if (!row.overruled_by.empty() && !(find(row.overruled_by) < i)) return false;
      }
      return true;
    }(),
    "every alarm has a key, a text, a response, and stands after the one that overrules it");

// FNV-1a, 64 bit: to tell tables apart, not to keep secrets.
class Fingerprint {
 public:
  void add(std::string_view text) {
    for (const char c : text) add_byte(static_cast<std::uint8_t>(c));
    add_byte(0);
  }
  void add(double number) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.begin(), text.end(), number).ptr;
    add(std::string_view{text.data(), static_cast<std::size_t>(end - text.data())});
  }
  std::uint64_t value() const { return value_; }

 private:
  void add_byte(std::uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3ULL; }
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

bool reasonable(Duration delay) { return delay >= Duration{} && delay <= seconds(600); }

}  // namespace

std::string_view text_of(Priority priority) {
  constexpr std::array<std::string_view, 3> kTexts{"low", "medium", "high"};
  return kTexts.at(static_cast<std::size_t>(priority));
}

std::size_t alarm_count() { return kAlarmTable.size(); }
const AlarmRow& alarm_row(AlarmIndex index) { return kAlarmTable.at(index); }
std::optional<AlarmIndex> find_alarm(std::string_view key) { return find(key); }

AlarmSetting default_setting(AlarmIndex index) {
  const AlarmRow& row = alarm_row(index);
  return {row.priority, row.limit, row.deadband, row.on_delay, row.off_delay};
}

AlarmSettings::AlarmSettings() {
  for (AlarmIndex i = 0; i < alarm_count(); ++i) settings_.push_back(default_setting(i));
}

Result<bool, Problem> AlarmSettings::edit(const AlarmEdit& edit) {
  const auto wrong = [&](const char* what) { return Unexpected{Problem{edit.key, what}}; };
  const auto index = find_alarm(edit.key);
  if (!index) return wrong("no such alarm");
  const AlarmSetting& wanted = edit.setting;
  if (edit.author.empty()) return wrong("who changes an alarm has a name");
  if (!std::isfinite(wanted.limit)) return wrong("the limit is a number");
  if (!(wanted.deadband >= 0.0 && std::isfinite(wanted.deadband))) {
    return wrong("the deadband is a number, not below zero");
  }
  if (!reasonable(wanted.on_delay) || !reasonable(wanted.off_delay)) {
    return wrong("delays are from 0 to 600 s");
  }
  if (alarm_row(*index).priority == Priority::kHigh && wanted.priority != Priority::kHigh) {
    return wrong("a high alarm stays high");
  }
  settings_[*index] = wanted;
  edits_.push_back(edit);
  return true;
}

std::uint64_t AlarmSettings::version() const {
  Fingerprint print;
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    const AlarmRow& row = alarm_row(i);
    const AlarmSetting& set = settings_[i];
    for (const std::string_view text : {row.key, row.text, row.response, row.overruled_by}) {
      print.add(text);
    }
    for (const double number :
         {static_cast<double>(set.priority), set.limit, set.deadband, set.on_delay.seconds(),
          set.off_delay.seconds(), static_cast<double>(row.field), static_cast<double>(row.side),
          row.latched ? 1.0 : 0.0, static_cast<double>(row.silent_in.bits)}) {
      print.add(number);
    }
  }
  return print.value();
}

std::string AlarmSettings::version_text() const {
  constexpr std::size_t kDigits = 16;
  std::array<char, kDigits> text{};
  const auto end = std::to_chars(text.begin(), text.end(), version(), 16).ptr;
  const std::string digits{text.data(), end};
  return std::string(kDigits - digits.size(), '0') + digits;
}

}  // namespace pitwall::alarms
