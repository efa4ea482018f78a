// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/exchange.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

struct Ends {
  KeyPair pair = make_pair(3);
  StandingKeys car{pair.car.own, pair.car.peer}, base{pair.base.own, pair.base.peer};
  OpeningBytes opening{};
  std::array<std::uint8_t, kMaxExchangeSize> out{};

  Ends() { opening.fill(9); }
};

TEST(Exchange, APayloadReadsAsItWasWritten) {
  for (const bool signed_only : {false, true}) {
    const ExchangePayload payload{.number = 0xBEEF,
                                  .continues = 0xF00D,
                                  .greeting = {.boot = 0x0123456789ABCDEF,
                                               .safety_schema = 42,
                                               .whole_schema = ~0ULL,
                                               .signed_only = signed_only,
                                               .real_car = !signed_only}};
    const ExchangePayload read = payload_of(bytes_of(payload));
    EXPECT_EQ(read.number, payload.number);
    EXPECT_EQ(read.continues, payload.continues);
    EXPECT_EQ(read.greeting, payload.greeting);
  }
}

TEST(Exchange, ATaggedOpeningFitsAsItIsAndWithNoChangeOfItsStampEither) {
  Ends e;
  e.car.tag_opening(e.opening, 0x0123456789ABCDEF);
  EXPECT_TRUE(e.base.opening_fits(e.opening));
  EXPECT_EQ(stamp_of(e.opening), 0x0123456789ABCDEFU);
  for (std::size_t bit = 0; bit < 8 * e.opening.size(); ++bit) {
    OpeningBytes changed = e.opening;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ 1U << bit % 8);
    EXPECT_FALSE(e.base.opening_fits(changed)) << bit;
  }
  EXPECT_FALSE(e.base.opening_fits(Bytes{e.opening}.first(kOpeningSize - 1)));
}

TEST(Exchange, AnAnswerFitsItsOwnOpeningOnlyAndSaysWhichOfThemArrived) {
  Ends e;
  AnswerBytes answer{};
  e.base.tag_answer(answer, 77, ephemeral_part(e.opening));
  EXPECT_TRUE(e.car.answer_fits(answer, ephemeral_part(e.opening)));
  EXPECT_EQ(stamp_of(answer), 77U);
  AnswerBytes other = answer;
  other[kAnswerSize - kTagSize - 1] ^= 1;  // of its stamp
  EXPECT_FALSE(e.car.answer_fits(other, ephemeral_part(e.opening)));
  e.opening[kHeaderSize] ^= 1;
  EXPECT_FALSE(e.car.answer_fits(answer, ephemeral_part(e.opening)));
}

TEST(Exchange, AStampToExceedIsReadByTheOpeningThatItRefuses) {
  Ends e;
  const std::size_t size = e.base.write_newer_stamp(123, ephemeral_part(e.opening), e.out);
  EXPECT_EQ(size, kNewerStampSize);
  const Bytes reply{e.out.data(), size};
  EXPECT_EQ(parse_header(reply)->kind, Kind::kNewerStamp);
  EXPECT_EQ(e.car.read_newer_stamp(reply, ephemeral_part(e.opening)), Stamp{123});
  EXPECT_FALSE(e.car.read_newer_stamp(reply.first(size - 1), ephemeral_part(e.opening)));
  const KeyPair others = make_pair(4);
  const StandingKeys stranger{others.car.own, others.car.peer};
  EXPECT_FALSE(stranger.read_newer_stamp(reply, ephemeral_part(e.opening)));
  e.out[kHeaderSize] ^= 1;
  EXPECT_FALSE(e.car.read_newer_stamp(reply, ephemeral_part(e.opening)));
  e.out[kHeaderSize] ^= 1;
  e.opening[kHeaderSize] ^= 1;
  EXPECT_FALSE(e.car.read_newer_stamp(reply, ephemeral_part(e.opening)));
}

TEST(Exchange, AHintNamesThePacketThatWasRefused) {
  Ends e;
  const std::size_t size = e.base.write_unknown({.receiver = 0x1234, .sequence_low = 77}, e.out);
  const Bytes hint{e.out.data(), size};
  EXPECT_TRUE(e.car.unknown_fits(hint));
  const auto header = parse_header(hint);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->kind, Kind::kUnknown);
  EXPECT_EQ(header->receiver, 0x1234);
  EXPECT_EQ(header->sequence_low, 77U);
  e.out[3] ^= 1;
  EXPECT_FALSE(e.car.unknown_fits(hint));
}

TEST(Exchange, NothingIsExchangedWithAKeyThatGivesNoSecret) {
  const KeyPair pair = make_pair(3);
  EXPECT_TRUE(StandingKeys(pair.car.own, pair.car.peer).usable());
  EXPECT_FALSE(StandingKeys(pair.car.own, PublicKey{}).usable());
}

}  // namespace
}  // namespace pitwall::telemetry::testing
