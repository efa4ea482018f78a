// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_wire.hpp"

#include <gtest/gtest.h>

namespace pitwall::recording {
namespace {

TEST(McapWire, WhatIsAppendedIsReadBack) {
  std::vector<std::uint8_t> bytes;
  McapAppender out{bytes};
  const std::size_t record = out.begin_record(McapOpcode::kMetadata);
  out.u8(0x12);
  out.u16(0x3456);
  out.u32(0x789ABCDE);
  out.u64(0xFEDCBA9876543210);
  out.string("name");
  const std::size_t block = out.begin_block();
  out.u16(7);
  out.end_block(block);
  out.end_record_around(record, 3);

  McapCursor in{bytes};
  EXPECT_EQ(in.u8(), 0x0C);
  EXPECT_EQ(in.u64(), bytes.size() - kMcapRecordHeaderBytes + 3);
  EXPECT_EQ(in.u8(), 0x12);
  EXPECT_EQ(in.u16(), 0x3456);
  EXPECT_EQ(in.u32(), 0x789ABCDEU);
  EXPECT_EQ(in.u64(), 0xFEDCBA9876543210U);
  EXPECT_EQ(in.string(), "name");
  EXPECT_EQ(in.u32(), 2U);
  EXPECT_EQ(in.u16(), 7);
  EXPECT_TRUE(in.ok());
  EXPECT_TRUE(in.rest().empty());
}

TEST(McapWire, LittleEndian) {
  std::vector<std::uint8_t> bytes;
  McapAppender{bytes}.u32(0x01020304);
  EXPECT_EQ(bytes, (std::vector<std::uint8_t>{4, 3, 2, 1}));
}

TEST(McapWire, ACursorNeverReadsPastItsEnd) {
  const std::vector<std::uint8_t> bytes{0xFF, 0xFF, 0xFF, 0xFF, 1, 2, 3};
  for (std::size_t length = 0; length < 4; ++length) {
    McapCursor in{std::span{bytes}.first(length)};
    EXPECT_EQ(in.u32(), 0U);
    EXPECT_FALSE(in.ok());
    EXPECT_EQ(in.u8(), 0);  // for good
  }
  McapCursor in{bytes};
  EXPECT_TRUE(in.string().empty());  // claims four thousand million characters
  EXPECT_FALSE(in.ok());
}

}  // namespace
}  // namespace pitwall::recording
