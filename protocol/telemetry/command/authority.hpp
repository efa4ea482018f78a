// Whose console may command: one holder at a time, renewed each second by that console, expired
// after three without. Its loss only bars commands; stops need none, and the car drives on.
//   in     base: consoles take, renew and hand over. Car: the fields of Group::kAuthority
//   out    holder and epoch; whether a command of it may be applied
//   invariants
//          at most one holder. The epoch rises with every change; a packet of an older epoch
//          changes nothing. Expiry is by the own clock, from the moment of a renewal whose number
//          was new: a repeated packet renews nothing, and one that was long on its way renews from
//          when it was said. While the clocks have not been compared nobody holds it
//          a renewal is an act of the console: nothing here renews by itself
//          an epoch that is heard no more for kAuthorityExpiry bars no other: a wrong one from the
//          future, or from a run before, locks nobody out for longer
//   units  Instant
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kAuthorityRenewal = seconds(1), kAuthorityExpiry = seconds(3);

class AuthorityRegister {
 public:
  bool take(HolderId who, Instant now);   // false: somebody else holds it
  bool renew(HolderId who, Instant now);  // false: not the holder
  bool hand_over(HolderId from, HolderId to, Instant now);
  void drop(HolderId who, Instant now);
  HolderId holder(Instant now) const;  // 0 after expiry
  void put(Values& values, Instant now) const;

 private:
  friend struct Fingerprint;  // of the exhaustive explorer, which compares states

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
  // Without another renewal nobody holds it after; in the past where nobody does now.
  Instant until() const;
  bool allows(const Command& command, Instant now) const;
  void base_restarted() { *this = {}; }

 private:
  friend struct Fingerprint;  // of the exhaustive explorer, which compares states

  HolderId holder_ = 0;  // 0 also after the base said that the epoch is over
  std::uint16_t epoch_ = 0, renewal_ = 0;
  std::optional<Instant> received_at_;  // a packet of this epoch
  std::optional<Instant> renewed_;
};

}  // namespace pitwall::telemetry
