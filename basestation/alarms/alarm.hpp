// Life cycle of one alarm, after ISA-18.2.
//
//             comes              ack              goes
//   NORMAL ----------> UNACK ----------> ACKED ----------> NORMAL
//                        | goes                 (latched: LATCHED ---- reset ----> NORMAL)
//                        v        ack
//                    RTN_UNACK ----------> NORMAL (latched: LATCHED)
//
//   any state --- shelve ---> SHELVED: time over -> UNACK, by hand -> ACKED (gone meanwhile: as if
//                             it had gone in that state)
//   any state --- situation, overruled ---> SUPPRESSED; comes back as it was, unseen stays unseen
//
//   in     whether its bound is broken, time, acts of operators
//   out    state, since when, how often
//   invariants
//          only ack() and unshelve() of an operator make an unseen alarm seen. A value that is
//          stale changes nothing: no alarm comes or goes by it
//          delays count from the moment at which the bound was crossed; deadband on the way back
//          chatter: from the third coming within 10 s on it is folded: counted, not announced anew,
//          and it goes only after 10 s of quiet
//   errors acts that the state does not allow: false, nothing changes
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
std::string_view text_of(State state);  // "unack", "rtn_unack", ... as the console has them

inline constexpr Duration kShelveMax = seconds(600);
inline constexpr Duration kChatterWindow = seconds(10);
inline constexpr std::size_t kChatterCount = 3;

// What its field says now.
struct Reading {
  double value = kUnset;
  bool usable = false;  // fresh or late; a stale value changes nothing
};

class Alarm {
 public:
  // True: it came (or came again), to be announced.
  bool update(const AlarmRow& row, const AlarmSetting& setting, const Reading& reading,
              bool suppressed, Instant now);

  bool acknowledge();
  bool shelve(Instant until);
  bool unshelve();  // by hand
  bool reset();

  State state() const;
  bool active() const { return active_; }
  bool unseen() const { return unseen_; }
  bool folded() const { return folded_; }
  std::optional<Instant> shelved_until() const { return shelved_until_; }
  Instant since() const { return since_; }
  std::uint32_t count() const { return count_; }  // comings since it was last normal
  double value() const { return value_; }         // at its newest usable reading

 private:
  bool broken(const AlarmRow& row, const AlarmSetting& setting, double value) const;
  bool come(const AlarmRow& row, Instant now);
  void go();
  void settle();

  bool active_ = false, unseen_ = false, held_ = false, folded_ = false, suppressed_ = false;
  bool raw_ = false;      // the bound is broken, before delays
  bool counted_ = false;  // this breaking of it has been counted
  Instant raw_since_{}, since_{};
  std::optional<Instant> shelved_until_;
  std::uint32_t count_ = 0;
  double value_ = kUnset;
  std::array<Instant, kChatterCount> comings_{};  // newest last
  std::uint64_t comings_ever_ = 0;
};

}  // namespace pitwall::alarms
