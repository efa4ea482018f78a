// Table of all alarms of the base station: watched field, priority, response.
//   invariants
//          ISA-18.2: an alarm demands an action; one without a response text does not compile. Each
//          alarm is a limit on one field (of the car's registry or of the base's own fields), with
//          deadband, delays and the situations of the car in which it is suppressed
//          an alarm that another one overrules is suppressed while the other one is active
//   units  limit and deadband in the unit of the field
//   source Saba et al. (incidents), ISA-18.2, EEMUA 191; limits are defaults, settings change them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/state/station_field.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::alarms {

enum class Priority : std::uint8_t { kLow, kMedium, kHigh };
std::string_view text_of(Priority priority);

enum class Side : std::uint8_t { kAbove, kBelow };

// Situations of the car in which an alarm has no meaning.
enum class Situation : std::uint8_t {
  kLinkLost,          // no value is known; the alarm of the link replaces all others
  kDisarmed,          // no driver, human or software, is in control
  kEngineOff,         // pressures and temperatures of a stopped engine have no meaning
  kStanding,          // the car stands still
  kReceiverExcluded,  // an operator has excluded the receiver
  kInPit              // the car is off every racing line, and tyres may be changed
};
inline constexpr std::size_t kSituations = 6;
struct Situations {
  std::uint8_t bits = 0;

  constexpr bool has(Situation s) const { return (bits >> static_cast<unsigned>(s) & 1U) != 0; }
  constexpr void set(Situation s, bool on) {
    const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(s));
    bits = static_cast<std::uint8_t>(on ? bits | bit : bits & ~bit);
  }
  constexpr bool overlaps(Situations other) const { return (bits & other.bits) != 0; }
};

using AlarmIndex = std::size_t;  // place in kAlarmTable

struct AlarmRow {
  std::string_view key;   // identifies the alarm in recordings and settings; never reused
  std::string_view text;  // what is wrong
  std::string_view response;
  Priority priority;
  state::FieldId field;
  Side side;
  double limit, deadband;
  Duration on_delay, off_delay;
  bool latched;  // stays until it is acknowledged and reset
  Situations silent_in;
  std::string_view overruled_by = {};
  bool always_shown = false;  // cannot be shelved
};

// Values of an alarm that settings can change from the defaults of the table.
struct AlarmSetting {
  Priority priority = Priority::kLow;
  double limit = 0.0, deadband = 0.0;
  Duration on_delay{}, off_delay{};

  bool operator==(const AlarmSetting&) const = default;
};
struct AlarmEdit {
  std::string key;
  AlarmSetting setting;
  std::string author, reason;
};

std::size_t alarm_count();
const AlarmRow& alarm_row(AlarmIndex index);
std::optional<AlarmIndex> find_alarm(std::string_view key);
AlarmSetting default_setting(AlarmIndex index);

// Settings in force, and the edits with their authors.
class AlarmSettings {
 public:
  AlarmSettings();  // the defaults of the table

  const AlarmSetting& of(AlarmIndex index) const { return settings_[index]; }
  // Problem with the key as place: no such alarm, a value that is not a number, a negative deadband
  // or delay, a delay beyond 10 min, no author, a lower priority for a high alarm.
  Result<bool, Problem> edit(const AlarmEdit& edit);
  const std::vector<AlarmEdit>& edits() const { return edits_; }
  // Fingerprint of table and settings: with the same version, the same inputs give the same list.
  std::uint64_t version() const;
  std::string version_text() const;  // 16 hexadecimal digits

 private:
  std::vector<AlarmSetting> settings_;
  std::vector<AlarmEdit> edits_;
};

}  // namespace pitwall::alarms
