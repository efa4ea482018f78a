// Is this the bus that the database describes? Before the car may arm, ids, lengths and periods on
// the bus are compared with the database: the same id means different things in different revisions
// (a steering angle of 10 bits read as 11 is +511 degrees).
//   in     frames of this tick, whether the car is armed, now
//   out    kListening until every required message has shown its period, kRight, or kWrong with the
//          first message that differs and how
//   units  seconds, bytes
//   invariants
//          a frame that the database does not describe is proof: kWrong at once. Absence and pace
//          are judged by time, so that a right bus that stalls or loses frames is never wrong:
//            acquitted  intervals over at least 0.75 of the longer of 1 s and the period have a
//                       mean of 0.4 to 2.5 periods. Race control also sends on every change of a
//                       flag, and every second frame may be lost
//            convicted  two intervals or more over `listen`, and still no such mean. A stall of
//                       up to 2 s at any period, or two lost frames of 1 s in a row, stay within
//            not heard  required, and silent for `listen`
//          kListening becomes kRight when every required message is acquitted: at 1 s messages
//          within 2 s. kWrong becomes kRight when moreover a whole `listen` has passed without a
//          difference, and never becomes kListening. A kRight car that is not armed goes on
//          listening.
//          While armed the verdict stands: a frame that goes astray at speed is a matter of
//          integrity, not of identity. Disarming begins a new `listen` with the verdict as it was
//   order  of several differences the one with the smallest id is named, but proof (kUnknownId,
//          kWrongFormat, kWrongLength) before absence (kNotHeard, kWrongPeriod)
//   not    ids that only this computer may send (gateway/inbound latches those), ids that the
//          manifest ignores, payloads: no bit of another revision is proof, since nobody knows what
//          a sender puts into bits that its database leaves free
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
#include "vehicle/world/bus_health.hpp"

namespace pitwall::gateway {

// A message of this period that loses one frame must not count as silent.
inline constexpr Duration kListenLeast = [] {
  Duration slowest{};
  for (const can::MessageRow& row : can::av21::kMessages)
    if (row.required) slowest = std::max(slowest, row.period);
  return slowest * 5 / 2;
}();

struct IdentityParams {
  Duration listen = milliseconds(3500);     // [kListenLeast, 10 s]
  std::span<const can::MessageRow> also{};  // of the bench alone: no strangers either
};

// What is known of one message of the database.
struct ReceivedMessage {
  Instant last{};             // newest frame
  Instant first{};            // of the frames whose pace is being judged
  std::uint32_t intervals{};  // since `first`
  bool received = false;      // since the car listens
  bool acquitted = false;     // its pace was right when it was judged last
  world::IdentityDifference difference = world::IdentityDifference::kNone;  // the newest
  Instant differed{};
  double measured = 0.0;  // bytes or seconds, by the kind of difference
};

// The smallest id that is not in the database.
struct Stranger {
  bool received = false;
  std::uint32_t id = 0;
  Instant at{};
  double bytes = 0.0;
};

struct IdentityState {
  world::BusIdentity verdict;  // as given last
  bool listening = false;
  Instant since{};       // begin of listening
  Instant difference{};  // the newest
  std::array<ReceivedMessage, can::av21::kMessages.size()> messages{};
  Stranger stranger;
};
static_assert(std::is_trivially_copyable_v<IdentityState>);

world::BusIdentity identify(const IdentityParams& params, IdentityState& state,
                            std::span<const can::ReceivedFrame> frames, bool armed, Instant now);

// For a person, e.g. "CAN id 1303 steering_report: 8 bytes on the bus, 3 in database
// CAN1-INDY-V14". Allocates: for the rim, the bench and logs, not for the step.
std::string sentence(const world::BusIdentity& identity);

// "av21.dbc, CAN1-INDY-V14, fingerprint 0123456789abcdef"
std::string database_text();

}  // namespace pitwall::gateway
