// Whose console may command: one holder at a time, renewed each second by that console, expired
// after three without. Its loss only bars commands; stops need none, and the car drives on.
//   in     base: consoles take, renew and hand over. Car: the fields of Group::kAuthority
//   out    holder and epoch; whether a command of it may be applied
//   law    at most one holder. The epoch rises with every change; a packet of an older epoch
//          changes nothing. Expiry is by the own clock, from a renewal whose number was new: a
//          repeated packet renews nothing
//   units  Instant
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/packet/received.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kAuthorityRenewal = seconds(1), kAuthorityExpiry = seconds(3);
using HolderId = std::uint8_t;  // 1 .. 254; 0: nobody

class AuthorityDesk {
 public:
  bool take(HolderId who, Instant now);   // false: somebody else holds it
  bool renew(HolderId who, Instant now);  // false: not the holder
  bool hand_over(HolderId from, HolderId to, Instant now);
  void drop(HolderId who, Instant now);
  HolderId holder(Instant now) const;  // 0 after expiry
  void put(Values& values, Instant now) const;

 private:
  HolderId holder_ = 0;
  std::uint16_t epoch_ = 0, renewal_ = 0;
  Instant renewed_{};
};

class AuthorityView {
 public:
  void heard(const Values& values, const Received& received);
  HolderId holder(Instant now) const;
  bool held(Instant now) const { return holder(now) != 0; }
  void base_restarted();

 private:
  HolderId holder_ = 0;
  std::uint16_t epoch_ = 0, renewal_ = 0;
  std::optional<Instant> renewed_;
};

}  // namespace pitwall::telemetry
