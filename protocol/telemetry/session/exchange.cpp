// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/exchange.hpp"

#include <algorithm>
#include <string_view>

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::size_t kContinuesAt = 2, kBootAt = 4, kSafetyAt = 12, kWholeAt = 20, kFlagsAt = 28;
constexpr unsigned kSignedFlag = 1, kRealCarFlag = 2;
static_assert(kFlagsAt + 1 == kPayloadSize);
constexpr std::size_t kStampAt = kHeaderSize + kNoiseMessage, kTagAt = kStampAt + kStampSize;

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
  store<std::uint16_t>(bytes, kContinuesAt, payload.continues);
  store<std::uint64_t>(bytes, kBootAt, payload.greeting.boot);
  store<std::uint64_t>(bytes, kSafetyAt, payload.greeting.safety_schema);
  store<std::uint64_t>(bytes, kWholeAt, payload.greeting.whole_schema);
  bytes[kFlagsAt] = static_cast<std::uint8_t>((payload.greeting.signed_only ? kSignedFlag : 0) |
                                              (payload.greeting.real_car ? kRealCarFlag : 0));
  return bytes;
}

ExchangePayload payload_of(std::span<const std::uint8_t, kPayloadSize> bytes) {
  return {.number = load<std::uint16_t>(bytes, 0),
          .continues = load<std::uint16_t>(bytes, kContinuesAt),
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
  opening_key_ = purpose_key(shared, "pitwall knock");
  newer_stamp_ = purpose_key(shared, "pitwall newer stamp");
  unknown_ = purpose_key(shared, "pitwall unknown session");
}

Stamp stamp_of(Bytes message) { return load<Stamp>(message, kStampAt); }

void StandingKeys::tag_opening(std::span<std::uint8_t> opening, Stamp stamp) const {
  CHECK(opening.size() == kOpeningSize);
  store<Stamp>(opening, kStampAt, stamp);
  const Tag tag = keyed_tag(opening_key_, {opening.first(kTagAt)});
  std::copy(tag.begin(), tag.end(), opening.begin() + kTagAt);
}

void StandingKeys::tag_answer(std::span<std::uint8_t> answer, Stamp stamp, Bytes opening_e) const {
  CHECK(answer.size() == kAnswerSize);
  store<Stamp>(answer, kStampAt, stamp);
  const Tag tag = keyed_tag(opening_key_, {answer.first(kTagAt), opening_e});
  std::copy(tag.begin(), tag.end(), answer.begin() + kTagAt);
}

bool StandingKeys::opening_fits(Bytes opening) const {
  return opening.size() == kOpeningSize &&
         same(keyed_tag(opening_key_, {opening.first(kTagAt)}), opening.subspan(kTagAt));
}

bool StandingKeys::answer_fits(Bytes answer, Bytes opening_e) const {
  return answer.size() == kAnswerSize &&
         same(keyed_tag(opening_key_, {answer.first(kTagAt), opening_e}), answer.subspan(kTagAt));
}

std::size_t StandingKeys::write_newer_stamp(Stamp stamp, Bytes opening_e,
                                            std::span<std::uint8_t> out) const {
  CHECK(out.size() >= kNewerStampSize);
  constexpr std::size_t kEnd = kHeaderSize + kStampSize;
  write_header({.kind = Kind::kNewerStamp}, out);
  store<Stamp>(out, kHeaderSize, stamp);
  const Tag tag = keyed_tag(newer_stamp_, {out.first(kEnd), opening_e});
  std::copy(tag.begin(), tag.end(), out.begin() + kEnd);
  return kNewerStampSize;
}

std::optional<Stamp> StandingKeys::read_newer_stamp(Bytes datagram, Bytes opening_e) const {
  constexpr std::size_t kEnd = kHeaderSize + kStampSize;
  if (datagram.size() != kNewerStampSize) return std::nullopt;
  if (!same(keyed_tag(newer_stamp_, {datagram.first(kEnd), opening_e}), datagram.subspan(kEnd))) {
    return std::nullopt;
  }
  return load<Stamp>(datagram, kHeaderSize);
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
