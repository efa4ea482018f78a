// The messages of the key exchange as bytes, and the tags in front of it: who does not know the
// shared secret of the two long-term keys costs the other end one hash, not three agreements.
//   wire   opening  header, e 32, sealed payload 27 + 16, knock tag 16, cookie 16 (zeros: none)
//          answer   header, e 32, sealed payload 27 + 16, knock tag 16
//          cookie   header, nonce 24, sealed cookie 16 + 16
//          unknown  header (receiver and number of the packet that had no session), tag 16
//          payload  sender's number of the session u16, boot u64, safety schema u64, whole schema
//                   u64, flags u8 (1: signed only, 2: a real car)
//   law    no reply is longer than what it replies to
//          an answer's tag holds the opening's e, so that an answer of another exchange is refused
//          before any agreement; a cookie opens only with the e of the opening that asked for it
//   errors none: the size was not right, or a tag
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/session/cipher.hpp"
#include "protocol/telemetry/session/noise_kk.hpp"

namespace pitwall::telemetry {

// What both ends tell each other within the exchange, authenticated.
struct Greeting {
  std::uint64_t boot = 0;           // another number after every start of the process
  std::uint64_t safety_schema = 0;  // hash of the groups of class kSafety and of the commands
  std::uint64_t whole_schema = 0;
  bool signed_only = false;  // must agree
  bool real_car = false;     // car: not a simulation

  constexpr bool operator==(const Greeting&) const = default;
};

struct ExchangePayload {
  std::uint16_t number = 0;  // by which the sender will know packets of the session
  Greeting greeting;
};

inline constexpr std::size_t kPayloadSize = 27, kCookieSize = 16, kCookieNonceSize = 24;
inline constexpr std::size_t kNoiseMessage = kPayloadSize + kNoiseOverhead;
inline constexpr std::size_t kAnswerSize = kHeaderSize + kNoiseMessage + kTagSize;
inline constexpr std::size_t kOpeningSize = kAnswerSize + kCookieSize;
inline constexpr std::size_t kCookieReplySize =
    kHeaderSize + kCookieNonceSize + kCookieSize + kTagSize;
inline constexpr std::size_t kUnknownSize = kHeaderSize + kTagSize;
inline constexpr std::size_t kMaxExchangeSize = 192;  // more than any of them
static_assert(kOpeningSize <= kMaxExchangeSize);
static_assert(kAnswerSize <= kOpeningSize && kCookieReplySize <= kOpeningSize);
static_assert(kUnknownSize <= kHeaderSize + kTagSize);  // the shortest data packet

using Cookie = std::array<std::uint8_t, kCookieSize>;
using OpeningBytes = std::array<std::uint8_t, kOpeningSize>;
using AnswerBytes = std::array<std::uint8_t, kAnswerSize>;

std::array<std::uint8_t, kPayloadSize> bytes_of(const ExchangePayload& payload);
ExchangePayload payload_of(std::span<const std::uint8_t, kPayloadSize> bytes);

// Keys that both ends have before any exchange.
class StandingKeys {
 public:
  StandingKeys(const Identity& own, const PublicKey& peer);

  // A peer's key that gives no secret: nothing is ever exchanged with it.
  bool usable() const { return usable_; }

  // Completes a message whose header and noise part are written. An answer's tag holds `opening_e`.
  void tag_opening(std::span<std::uint8_t> opening, const Cookie& cookie) const;
  void tag_answer(std::span<std::uint8_t> answer, Bytes opening_e) const;
  bool opening_fits(Bytes opening) const;
  bool answer_fits(Bytes answer, Bytes opening_e) const;

  using CookieNonce = std::array<std::uint8_t, kCookieNonceSize>;
  std::size_t write_cookie(const Cookie& cookie, const CookieNonce& nonce, Bytes opening_e,
                           std::span<std::uint8_t> out) const;
  std::optional<Cookie> read_cookie(Bytes datagram, Bytes opening_e) const;

  std::size_t write_unknown(const Header& refused, std::span<std::uint8_t> out) const;
  bool unknown_fits(Bytes datagram) const;

 private:
  bool usable_ = false;
  Key knock_, cookie_, unknown_;
};

// Parts of an opening or answer.
inline Bytes noise_part(Bytes message) { return message.subspan(kHeaderSize, kNoiseMessage); }
inline Bytes ephemeral_part(Bytes message) { return message.subspan(kHeaderSize, kKeySize); }
inline Bytes cookie_part(Bytes opening) { return opening.last(kCookieSize); }

}  // namespace pitwall::telemetry
