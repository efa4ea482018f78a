// Messages of the key exchange as bytes, with tags by the shared secret of the two long-term keys:
// a sender without that secret costs the other end one hash, not three key agreements.
//   wire   opening      header, e 32, sealed payload 29 + 16, stamp u64, tag 16
//          answer       as the opening, with the stamp of the opening that it answers
//          newer stamp  header, stamp u64 that an opening must exceed, tag 16
//          unknown      header (receiver and number of the packet that had no session), tag 16
//          payload      sender's number of the session u16, receiver's number of the session that
//                       gets new keys u16 (0: a new session), boot u64, safety schema u64, whole
//                       schema u64, flags u8 (1: signed only, 2: a real car)
//   invariants
//          no reply is longer than the message that it answers
//          an answer's tag covers the opening's e and stamp: an answer of another exchange is
//          refused before any key agreement, and the stamp identifies the opening that arrived
//          the tag of "newer stamp" covers the e of the opening that it refuses
//   errors false or an empty optional: the size or the tag is wrong
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/session/crypto/cipher.hpp"
#include "protocol/telemetry/session/crypto/noise_kk.hpp"
#include "protocol/telemetry/session/stamp.hpp"

namespace pitwall::telemetry {

// Authenticated data that both ends send in the exchange.
struct Greeting {
  std::uint64_t boot = 0;           // changes with every start of the process
  std::uint64_t safety_schema = 0;  // hash of the groups of class kSafety and of the commands
  std::uint64_t whole_schema = 0;
  bool signed_only = false;  // must agree
  bool real_car = false;     // car: not a simulation

  constexpr bool operator==(const Greeting&) const = default;
};

struct ExchangePayload {
  std::uint16_t number = 0;     // the sender's number of the new session
  std::uint16_t continues = 0;  // the receiver's number of the session that gets new keys
  Greeting greeting;
};

// Binds an exchange to this protocol and its version.
inline constexpr auto kPrologue = [] {
  constexpr std::string_view kText = "pitwall radio ";
  std::array<std::uint8_t, kText.size() + 1> bytes{};
  std::copy(kText.begin(), kText.end(), bytes.begin());
  bytes.back() = kProtocolVersion;
  return bytes;
}();

inline constexpr std::size_t kPayloadSize = 29, kStampSize = sizeof(Stamp);
inline constexpr std::size_t kNoiseMessage = kPayloadSize + kNoiseOverhead;
inline constexpr std::size_t kOpeningSize = kHeaderSize + kNoiseMessage + kStampSize + kTagSize;
inline constexpr std::size_t kAnswerSize = kOpeningSize;
inline constexpr std::size_t kNewerStampSize = kHeaderSize + kStampSize + kTagSize;
inline constexpr std::size_t kUnknownSize = kHeaderSize + kTagSize;
inline constexpr std::size_t kMaxExchangeSize = 192;  // at least the size of each of them
static_assert(kOpeningSize <= kMaxExchangeSize);
static_assert(kAnswerSize <= kOpeningSize && kNewerStampSize <= kOpeningSize);
static_assert(kUnknownSize <= kHeaderSize + kTagSize);  // the shortest data packet

using OpeningBytes = std::array<std::uint8_t, kOpeningSize>;
using AnswerBytes = std::array<std::uint8_t, kAnswerSize>;

std::array<std::uint8_t, kPayloadSize> bytes_of(const ExchangePayload& payload);
ExchangePayload payload_of(std::span<const std::uint8_t, kPayloadSize> bytes);

// Keys for the tags of the exchange, derived from the long-term keys of both ends.
class StandingKeys {
 public:
  StandingKeys(const Identity& own, const PublicKey& peer);

  // False if the peer's key gives no shared secret; then no exchange takes place.
  bool usable() const { return usable_; }

  // Completes a message whose header and noise part are written. An answer's tag covers `opening_e`
  // and the stamp of the opening.
  void tag_opening(std::span<std::uint8_t> opening, Stamp stamp) const;
  void tag_answer(std::span<std::uint8_t> answer, Stamp stamp, Bytes opening_e) const;
  bool opening_fits(Bytes opening) const;
  bool answer_fits(Bytes answer, Bytes opening_e) const;

  std::size_t write_newer_stamp(Stamp stamp, Bytes opening_e, std::span<std::uint8_t> out) const;
  std::optional<Stamp> read_newer_stamp(Bytes datagram, Bytes opening_e) const;

  std::size_t write_unknown(const Header& refused, std::span<std::uint8_t> out) const;
  bool unknown_fits(Bytes datagram) const;

 private:
  bool usable_ = false;
  Key opening_key_, newer_stamp_, unknown_;
};

// Parts of an opening or answer.
inline Bytes noise_part(Bytes message) { return message.subspan(kHeaderSize, kNoiseMessage); }
inline Bytes ephemeral_part(Bytes message) { return message.subspan(kHeaderSize, kKeySize); }
Stamp stamp_of(Bytes message);

}  // namespace pitwall::telemetry
