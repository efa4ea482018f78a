// Command authority: which console may send commands. There is one holder at a time; its console
// renews the authority each second, and it expires after three seconds without a renewal. Its loss
// only blocks commands: stops need no authority, and the car drives on.
//   in     base: consoles take, renew and hand over. Car: the fields of Group::kAuthority
//   out    holder and epoch; whether a command of that holder may be applied
//   invariants
//          there is at most one holder. The epoch rises with every change; a packet of an older
//          epoch changes nothing. Expiry is by the own clock, counted from the time of the newest
//          renewal number: a repeated packet renews nothing, and a delayed packet renews from the
//          time of its renewal. While the clocks are not compared there is no holder
//          every renewal is an action of the console: nothing here renews by itself
//          an epoch that was not received for kAuthorityExpiry no longer blocks others: a wrong
//          one, from the future or from a previous run, locks out consoles no longer than that
//   units  Instant
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kAuthorityRenewal = seconds(1), kAuthorityExpiry = seconds(3);

class AuthorityRegister {
 public:
  bool take(HolderId who, Instant now);   // false: another console is the holder
  bool renew(HolderId who, Instant now);  // false: not the holder
  bool hand_over(HolderId from, HolderId to, Instant now);
  void drop(HolderId who, Instant now);
  HolderId holder(Instant now) const;  // 0 after expiry
  void put(Values& values, Instant now) const;

 private:
  friend struct Fingerprint;  // state hash for the exhaustive state explorer

  void begin(HolderId who, Instant now);

  HolderId holder_ = 0;
  std::uint16_t epoch_ = 0, renewal_ = 0;
  Instant renewed_{};
};

class AuthorityView {
 public:
  void receive(const Values& values, const Received& received);
  HolderId holder(Instant now) const;
  bool held(Instant now) const { return holder(now) != 0; }
  // Last instant with a holder unless there is another renewal; in the past if there is none now.
  Instant until() const;
  bool allows(const Command& command, Instant now) const;
  void base_restarted() { *this = {}; }

 private:
  friend struct Fingerprint;  // state hash for the exhaustive state explorer

  HolderId holder_ = 0;  // 0 also after the base has ended this epoch
  std::uint16_t epoch_ = 0, renewal_ = 0;
  std::optional<Instant> received_at_;  // newest packet of this epoch
  std::optional<Instant> renewed_;
};

}  // namespace pitwall::telemetry
