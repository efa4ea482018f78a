// Life cycle of one alarm, as a state machine after ISA-18.2.
//
//          becomes active        ack         becomes inactive
//   NORMAL ----------> UNACK ----------> ACKED ----------> NORMAL
//                        | inactive           (latched: LATCHED ---- reset ----> NORMAL)
//                        v        ack
//                    RTN_UNACK ----------> NORMAL (latched: LATCHED)
//
//   any state --- shelve ---> SHELVED. After the time -> UNACK; by an operator -> ACKED. If the
//                             alarm is inactive by then: the state that follows from that
//   any state --- situation, overruled ---> SUPPRESSED. Afterwards the state from before; an
//                             unacknowledged alarm stays unacknowledged
//
//   in     whether the limit is violated, time, actions of operators
//   out    state, since when, how often
//   invariants
//          only ack() and unshelve() by an operator acknowledge an alarm. A stale value changes
//          nothing: no alarm becomes active or inactive because of it
//          delays count from the moment at which the limit was crossed; the deadband applies on the
//          way back
//          chatter: from the third activation within 10 s on the alarm is folded: further ones are
//          counted but not announced, and it becomes inactive only after 10 s of quiet
//   errors an action that the state does not allow returns false and changes nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "basestation/alarms/alarm_table.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::alarms {

enum class State : std::uint8_t {
  kNormal,
  kUnack,
  kAcked,
  kReturnedUnack,
  kLatched,
  kShelved,
  kSuppressed
};
std::string_view text_of(State state);  // "unack", "rtn_unack", ... as consoles show them

inline constexpr Duration kShelveMax = seconds(600);
inline constexpr Duration kChatterWindow = seconds(10);
inline constexpr std::size_t kChatterCount = 3;

// Present value of the field that the alarm watches.
struct Reading {
  double value = kUnset;
  bool usable = false;  // fresh or late; a stale value changes nothing
};

class Alarm {
 public:
  // Returns true if the alarm became active (or active again) and must be announced.
  bool update(const AlarmRow& row, const AlarmSetting& setting, const Reading& reading,
              bool suppressed, Instant now);

  bool acknowledge();
  bool shelve(Instant until);
  bool unshelve();  // by an operator
  bool reset();

  State state() const;
  bool active() const { return active_; }
  bool unacknowledged() const { return unacknowledged_; }
  bool folded() const { return folded_; }
  std::optional<Instant> shelved_until() const { return shelved_until_; }
  Instant since() const { return since_; }
  std::uint32_t count() const { return count_; }  // activations since it was last normal
  double value() const { return value_; }         // at the newest usable reading

 private:
  bool broken(const AlarmRow& row, const AlarmSetting& setting, double value) const;
  bool activate(const AlarmRow& row, Instant now);
  void deactivate();
  void settle();

  bool active_ = false, unacknowledged_ = false, latched_ = false, folded_ = false,
       suppressed_ = false;
  bool raw_ = false;      // the limit is violated, before the delays
  bool counted_ = false;  // the present violation has been counted
  Instant raw_since_{}, since_{};
  std::optional<Instant> shelved_until_;
  std::uint32_t count_ = 0;
  double value_ = kUnset;
  std::array<Instant, kChatterCount> activations_{};  // newest last
  std::uint64_t activation_count_ = 0;
};

}  // namespace pitwall::alarms
