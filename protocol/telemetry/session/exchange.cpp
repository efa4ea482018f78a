// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/exchange.hpp"

#include <sodium.h>

#include <algorithm>
#include <string_view>

#include "protocol/telemetry/little_endian.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::size_t kBootAt = 2, kSafetyAt = 10, kWholeAt = 18, kFlagsAt = 26;
constexpr unsigned kSignedFlag = 1, kRealCarFlag = 2;
static_assert(kFlagsAt + 1 == kPayloadSize);
static_assert(kCookieNonceSize == crypto_aead_xchacha20poly1305_ietf_NPUBBYTES);
constexpr std::size_t kTagAt = kHeaderSize + kNoiseMessage;

Key purpose_key(const Key& shared, std::string_view purpose) {
  std::array<std::uint8_t, 32> bytes{};
  CHECK(purpose.size() <= bytes.size());
  std::copy(purpose.begin(), purpose.end(), bytes.begin());
  return derive(shared, bytes);
}

}  // namespace

std::array<std::uint8_t, kPayloadSize> bytes_of(const ExchangePayload& payload) {
  std::array<std::uint8_t, kPayloadSize> bytes{};
  store<std::uint16_t>(bytes, 0, payload.number);
  store<std::uint64_t>(bytes, kBootAt, payload.greeting.boot);
  store<std::uint64_t>(bytes, kSafetyAt, payload.greeting.safety_schema);
  store<std::uint64_t>(bytes, kWholeAt, payload.greeting.whole_schema);
  bytes[kFlagsAt] = static_cast<std::uint8_t>((payload.greeting.signed_only ? kSignedFlag : 0) |
                                              (payload.greeting.real_car ? kRealCarFlag : 0));
  return bytes;
}

ExchangePayload payload_of(std::span<const std::uint8_t, kPayloadSize> bytes) {
  return {.number = load<std::uint16_t>(bytes, 0),
          .greeting = {.boot = load<std::uint64_t>(bytes, kBootAt),
                       .safety_schema = load<std::uint64_t>(bytes, kSafetyAt),
                       .whole_schema = load<std::uint64_t>(bytes, kWholeAt),
                       .signed_only = (bytes[kFlagsAt] & kSignedFlag) != 0,
                       .real_car = (bytes[kFlagsAt] & kRealCarFlag) != 0}};
}

StandingKeys::StandingKeys(const Identity& own, const PublicKey& peer) {
  prepare_sodium();
  Key shared;
  usable_ = agree(own.secret_key, peer, shared);
  knock_ = purpose_key(shared, "pitwall knock");
  cookie_ = purpose_key(shared, "pitwall cookie");
  unknown_ = purpose_key(shared, "pitwall unknown session");
}

void StandingKeys::tag_opening(std::span<std::uint8_t> opening, const Cookie& cookie) const {
  CHECK(opening.size() == kOpeningSize);
  const Tag tag = keyed_tag(knock_, {opening.first(kTagAt)});
  std::copy(tag.begin(), tag.end(), opening.begin() + kTagAt);
  std::copy(cookie.begin(), cookie.end(), opening.end() - kCookieSize);
}

void StandingKeys::tag_answer(std::span<std::uint8_t> answer, Bytes opening_e) const {
  CHECK(answer.size() == kAnswerSize);
  const Tag tag = keyed_tag(knock_, {answer.first(kTagAt), opening_e});
  std::copy(tag.begin(), tag.end(), answer.begin() + kTagAt);
}

bool StandingKeys::opening_fits(Bytes opening) const {
  return opening.size() == kOpeningSize &&
         same(keyed_tag(knock_, {opening.first(kTagAt)}), opening.subspan(kTagAt, kTagSize));
}

bool StandingKeys::answer_fits(Bytes answer, Bytes opening_e) const {
  return answer.size() == kAnswerSize &&
         same(keyed_tag(knock_, {answer.first(kTagAt), opening_e}), answer.subspan(kTagAt));
}

std::size_t StandingKeys::write_cookie(const Cookie& cookie, const CookieNonce& nonce,
                                       Bytes opening_e, std::span<std::uint8_t> out) const {
  CHECK(out.size() >= kCookieReplySize);
  write_header({.kind = Kind::kCookie}, out);
  std::copy(nonce.begin(), nonce.end(), out.begin() + kHeaderSize);
  crypto_aead_xchacha20poly1305_ietf_encrypt(
      out.data() + kHeaderSize + kCookieNonceSize, nullptr, cookie.data(), cookie.size(),
      opening_e.data(), opening_e.size(), nullptr, nonce.data(), cookie_.data());
  return kCookieReplySize;
}

std::optional<Cookie> StandingKeys::read_cookie(Bytes datagram, Bytes opening_e) const {
  if (datagram.size() != kCookieReplySize) return std::nullopt;
  Cookie cookie{};
  const Bytes sealed = datagram.subspan(kHeaderSize + kCookieNonceSize);
  if (crypto_aead_xchacha20poly1305_ietf_decrypt(
          cookie.data(), nullptr, nullptr, sealed.data(), sealed.size(), opening_e.data(),
          opening_e.size(), datagram.data() + kHeaderSize, cookie_.data()) != 0) {
    return std::nullopt;
  }
  return cookie;
}

std::size_t StandingKeys::write_unknown(const Header& refused, std::span<std::uint8_t> out) const {
  CHECK(out.size() >= kUnknownSize);
  write_header(
      {.kind = Kind::kUnknown, .receiver = refused.receiver, .sequence_low = refused.sequence_low},
      out);
  const Tag tag = keyed_tag(unknown_, {out.first(kHeaderSize)});
  std::copy(tag.begin(), tag.end(), out.begin() + kHeaderSize);
  return kUnknownSize;
}

bool StandingKeys::unknown_fits(Bytes datagram) const {
  return datagram.size() == kUnknownSize &&
         same(keyed_tag(unknown_, {datagram.first(kHeaderSize)}), datagram.subspan(kHeaderSize));
}

}  // namespace pitwall::telemetry
