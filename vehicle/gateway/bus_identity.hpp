// Check that the CAN bus is the one that the database describes. Before the car may arm,
// identifiers, lengths and periods on the bus are compared with the database: one identifier has
// different meanings in different revisions (a steering angle of 10 bits read as 11 is +511
// degrees).
//   in     frames of this tick, whether the car is armed, the time
//   out    kListening until every required message has shown its period; then kRight, or kWrong
//          with the first message that differs and how
//   units  seconds, bytes
//   invariants
//          a frame that the database does not describe is proof: kWrong at once. Absence and period
//          are judged over time, so that a right bus that stalls or loses frames never becomes
//          wrong:
//            period_confirmed  the intervals over at least 0.75 of the longer of 1 s and the period
//                       have a mean of 0.4 to 2.5 periods. This tolerates that race control also
//                       sends on every change of a flag, and that every second frame is lost
//            convicted  two intervals or more over `listen` without such a mean. A stall of up to
//                       2 s at any period, or two lost frames of 1 s in a row, are tolerated
//            absent     a required message is not received for `listen`
//          kListening becomes kRight when the period of every required message is confirmed: within
//          2 s for messages of 1 s. kWrong becomes kRight when in addition a whole `listen` passed
//          without a difference; it never becomes kListening. A car in kRight that is not armed
//          continues to check.
//          While armed the verdict is kept: a wrong frame at speed is a matter of integrity, not of
//          identity. Disarming starts a new `listen` with the old verdict
//   order  of several differences the one with the smallest identifier is named; proof (kUnknownId,
//          kWrongFormat, kWrongLength) comes before absence (kNotReceived) and period
//          (kWrongPeriod)
//   not    identifiers that only this computer may send (gateway/inbound latches those),
//          identifiers that the manifest ignores, and payloads: their bits prove nothing, because a
//          sender may use bits that its database leaves free
//   errors none
//   cost   no allocation; O(frames + messages) while not armed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include "protocol/can/av21.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/health.hpp"

namespace pitwall::gateway {

// A message of the slowest period that loses one frame must not count as absent.
inline constexpr Duration kListenLeast = [] {
  Duration slowest{};
  for (const can::MessageRow& row : can::av21::kMessages)
    if (row.required) slowest = std::max(slowest, row.period);
  return slowest * 5 / 2;
}();

struct IdentityParams {
  Duration listen = milliseconds(3500);     // [kListenLeast, 10 s]
  std::span<const can::MessageRow> also{};  // set by the bench only: further messages to accept
};

// State of one message of the database.
struct ReceivedMessage {
  Instant last{};                 // newest frame
  Instant first{};                // first frame of the interval measurement
  std::uint32_t intervals{};      // since `first`
  bool received = false;          // since listening began
  bool period_confirmed = false;  // its period was right at the last judgement
  world::IdentityDifference difference = world::IdentityDifference::kNone;  // the newest
  Instant differed{};
  double measured = 0.0;  // bytes or seconds, by the kind of difference
};

// The smallest received identifier that is not in the database.
struct Stranger {
  bool received = false;
  std::uint32_t id = 0;
  Instant at{};
  double bytes = 0.0;
};

struct IdentityState {
  world::BusIdentity verdict;  // last verdict
  bool listening = false;
  Instant since{};       // begin of listening
  Instant difference{};  // the newest
  std::array<ReceivedMessage, can::av21::kMessages.size()> messages{};
  Stranger stranger;
};
static_assert(std::is_trivially_copyable_v<IdentityState>);

world::BusIdentity identify(const IdentityParams& params, IdentityState& state,
                            std::span<const can::ReceivedFrame> frames, bool armed, Instant now);

// Text for the operator, e.g. "CAN id 1303 steering_report: 8 bytes on the bus, 3 in database
// CAN1-INDY-V14". Allocates: not for use in the step.
std::string sentence(const world::BusIdentity& identity);

// "av21.dbc, CAN1-INDY-V14, fingerprint 0123456789abcdef"
std::string database_text();

}  // namespace pitwall::gateway
