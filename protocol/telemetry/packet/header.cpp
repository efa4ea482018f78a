// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/header.hpp"

#include <array>

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr unsigned kVersionShift = 5, kKindShift = 2, kPhaseShift = 1;
constexpr std::uint8_t kKindMask = 7, kReservedMask = 1;
constexpr std::size_t kReceiverAt = 1, kSequenceAt = 3;
static_assert(kSequenceAt + sizeof(Header::sequence_low) == kHeaderSize);
static_assert(kProtocolVersion < 8 && kKinds <= kKindMask + 1);

}  // namespace

const char* text_of(HeaderError error) {
  constexpr std::array<const char*, kHeaderErrors> kTexts{
      "shorter than a header", "longer than any datagram of this protocol",
      "another version of the protocol", "no such kind of datagram", "a reserved bit is set"};
  return kTexts[static_cast<std::size_t>(error)];
}

Result<Header, HeaderError> parse_header(std::span<const std::uint8_t> datagram) {
  if (datagram.size() < kHeaderSize) return Unexpected{HeaderError::kTooShort};
  if (datagram.size() > kMaxDatagram) return Unexpected{HeaderError::kTooLong};
  const std::uint8_t first = datagram[0];
  if (first >> kVersionShift != kProtocolVersion) return Unexpected{HeaderError::kOtherVersion};
  const auto kind = static_cast<std::uint8_t>(first >> kKindShift & kKindMask);
  if (kind >= kKinds) return Unexpected{HeaderError::kBadKind};
  if ((first & kReservedMask) != 0) return Unexpected{HeaderError::kBadReserved};
  return Header{.kind = static_cast<Kind>(kind),
                .key_phase = (first >> kPhaseShift & 1U) != 0,
                .receiver = load<std::uint16_t>(datagram, kReceiverAt),
                .sequence_low = load<std::uint32_t>(datagram, kSequenceAt)};
}

void write_header(const Header& header, std::span<std::uint8_t> out) {
  CHECK(out.size() >= kHeaderSize);
  const unsigned kind = static_cast<std::uint8_t>(header.kind);
  const unsigned phase = header.key_phase ? 1 : 0;
  out[0] = static_cast<std::uint8_t>(unsigned{kProtocolVersion} << kVersionShift |
                                     kind << kKindShift | phase << kPhaseShift);
  store<std::uint16_t>(out, kReceiverAt, header.receiver);
  store<std::uint32_t>(out, kSequenceAt, header.sequence_low);
}

}  // namespace pitwall::telemetry
