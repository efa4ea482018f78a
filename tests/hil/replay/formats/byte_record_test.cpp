// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/byte_record.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

TEST(ByteRecord, NumbersAreReadInBothOrders) {
  const std::string_view bytes{"\x01\x02\x03\x04\x05\x06\x07\x88", 8};
  const ByteRecord little{bytes}, big{bytes, true};
  EXPECT_EQ(little.u8(7), 0x88);
  EXPECT_EQ(little.u16(0), 0x0201);
  EXPECT_EQ(big.u16(0), 0x0102);
  EXPECT_EQ(little.u32(2), 0x06050403U);
  EXPECT_EQ(big.u32(2), 0x03040506U);
  EXPECT_EQ(little.u64(0), 0x8807060504030201U);
  EXPECT_EQ(big.u64(0), 0x0102030405060788U);
}

TEST(ByteRecordDeathTest, OutsideIsOurOwnMistake) {
  const ByteRecord record{std::string_view{"abc"}};
  EXPECT_DEATH(record.u32(0), "");
  EXPECT_DEATH(record.u8(3), "");
}

}  // namespace
}  // namespace pitwall::replay
