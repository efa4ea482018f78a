// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/header.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/support/allocation_guard.hpp"

namespace pitwall::telemetry {
namespace {

constexpr std::array<std::uint8_t, kHeaderSize> kSome{0x6C, 0x34, 0x12, 0x78, 0x56, 0x34, 0x12};

HeaderError header_error(std::span<const std::uint8_t> datagram) {
  return parse_header(datagram).error();
}

TEST(Header, IsTheBytesThatItsContractDraws) {
  std::array<std::uint8_t, kHeaderSize> out{};
  write_header(
      {.kind = Kind::kSealed, .key_phase = false, .receiver = 0x1234, .sequence_low = 0x12345678},
      out);
  EXPECT_EQ(out, kSome);
  write_header({.kind = Kind::kOpening, .key_phase = true, .receiver = 0, .sequence_low = 0}, out);
  EXPECT_EQ(out[0], 0x62);
}

TEST(Header, EveryFirstByteIsRefusedOrWrittenAgainAsItWas) {
  std::size_t accepted = 0;
  for (unsigned first = 0; first < 256; ++first) {
    auto bytes = kSome;
    bytes[0] = static_cast<std::uint8_t>(first);
    const auto header = parse_header(bytes);
    if (!header) continue;
    ++accepted;
    std::array<std::uint8_t, kHeaderSize> again{};
    write_header(*header, again);
    EXPECT_EQ(again, bytes);
  }
  EXPECT_EQ(accepted, 2 * kKinds);
}

TEST(Header, EveryErrorHasItsCauseAndItsText) {
  auto bytes = kSome;
  bytes[0] = 0x2C;
  EXPECT_EQ(header_error(bytes), HeaderError::kOtherVersion);
  bytes[0] = 0x78;
  EXPECT_EQ(header_error(bytes), HeaderError::kBadKind);
  bytes[0] = 0x6D;
  EXPECT_EQ(header_error(bytes), HeaderError::kBadReserved);
  for (std::size_t size = 0; size < kHeaderSize; ++size) {
    EXPECT_EQ(header_error(std::span(kSome).first(size)), HeaderError::kTooShort);
  }
  for (std::size_t e = 0; e < kHeaderErrors; ++e) {
    EXPECT_FALSE(std::string(text_of(static_cast<HeaderError>(e))).empty());
  }
}

// A datagram as long as a receive buffer takes, or longer, is refused for its length and nothing of
// it is used (in peers it is cut off without a word).
TEST(Header, ADatagramLongerThanAnyOfOursIsRefusedWhole) {
  for (const std::size_t size : {kMaxDatagram + 1, std::size_t{2'048}, std::size_t{65'507}}) {
    std::vector<std::uint8_t> bytes(size, 0);
    std::copy(kSome.begin(), kSome.end(), bytes.begin());
    EXPECT_EQ(header_error(bytes), HeaderError::kTooLong);
  }
  std::vector<std::uint8_t> bytes(kMaxDatagram, 0);
  std::copy(kSome.begin(), kSome.end(), bytes.begin());
  EXPECT_TRUE(parse_header(bytes));
}

TEST(Header, ADatagramOfNoBytesIsTooShort) { EXPECT_EQ(header_error({}), HeaderError::kTooShort); }

TEST(Header, AllocatesNothing) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "not counted under AddressSanitizer";
  std::array<std::uint8_t, kHeaderSize> out{};
  const auto count = testing::allocations_of([&] {
    const auto header = parse_header(kSome);
    write_header(*header, out);
  });
  EXPECT_EQ(count, 0U);
}

}  // namespace
}  // namespace pitwall::telemetry
