// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/cdr_struct.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/protocol/recording/mcap_samples.hpp"

namespace pitwall::recording {
namespace {

using testing::Sample;

std::vector<std::uint8_t> bytes_of(const Sample& s) {
  std::array<std::uint8_t, cdr_bytes_max<Sample>()> buffer;
  const auto bytes = to_cdr(s, std::span{buffer});
  return {bytes.begin(), bytes.end()};
}

TEST(CdrStruct, SchemaNamesEveryFieldInOrder) {
  const Schema schema = cdr_schema<Sample>();
  EXPECT_EQ(schema.name, "pitwall_msgs/msg/Sample");
  EXPECT_EQ(schema.encoding, "ros2msg");
  EXPECT_EQ(schema.text,
            "uint8 mode\nfloat64 speed_mps\nbool armed\nuint16 gear\nuint32 frames\n"
            "float32 share\nuint8[] raw\nint64 at_ns\nint32 delta\nuint64 total\n");
}

TEST(CdrStruct, EveryNumberIsAlignedFromAfterTheHeader) {
  Sample s;
  s.mode = 0x11;
  s.speed_mps = 1.0;
  s.armed = true;
  s.gear = 0x2233;
  EXPECT_TRUE(s.raw.push(0x44));
  const auto bytes = bytes_of(s);
  ASSERT_GE(bytes.size(), 4U + 20U);
  EXPECT_EQ((std::vector<std::uint8_t>{bytes.begin(), bytes.begin() + 4}),
            (std::vector<std::uint8_t>{0, 1, 0, 0}));
  EXPECT_EQ(bytes[4], 0x11);
  EXPECT_EQ(bytes[4 + 8 + 7], 0x3F);  // the last byte of 1.0, at offset 8
  EXPECT_EQ(bytes[4 + 16], 1);        // armed
  EXPECT_EQ(bytes[4 + 18], 0x33);     // gear, little-endian, at an even offset
  EXPECT_EQ(bytes[4 + 28], 1);        // length of raw
  EXPECT_EQ(bytes[4 + 32], 0x44);
}

TEST(CdrStruct, BytesGiveTheStructBackAndTheSameBytesAgain) {
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto bytes = bytes_of(testing::sample(i));
    Sample back;
    ASSERT_TRUE(from_cdr(bytes, back)) << i;
    EXPECT_EQ(bytes_of(back), bytes) << i;
    EXPECT_EQ(back.total, testing::sample(i).total);
    EXPECT_EQ(back.raw.size(), i % 33);
  }
}

TEST(CdrStruct, CutOrLongerBytesAreRefused) {
  auto bytes = bytes_of(testing::sample(20));
  Sample back;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(from_cdr(std::span{bytes}.first(length), back)) << length;
  }
  bytes.push_back(0);
  EXPECT_FALSE(from_cdr(bytes, back));
}

TEST(CdrStruct, OtherEncapsulationsFlagsAndLengthsAreRefused) {
  const auto good = bytes_of(testing::sample(1));
  Sample back;
  auto bad = good;
  bad[1] = 0;  // big-endian
  EXPECT_FALSE(from_cdr(bad, back));
  bad = good;
  bad[4 + 16] = 2;  // a bool
  EXPECT_FALSE(from_cdr(bad, back));
  bad = good;
  bad[4 + 28] = 33;  // longer than the bound of raw
  EXPECT_FALSE(from_cdr(bad, back));
  bad[4 + 31] = 0xFF;
  EXPECT_FALSE(from_cdr(bad, back));
}

}  // namespace
}  // namespace pitwall::recording
