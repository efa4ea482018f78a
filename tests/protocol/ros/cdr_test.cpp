// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/cdr.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/ros/messages/sensor.hpp"
#include "tests/protocol/ros/sample_messages.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::ros {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class M>
Bytes encoded(const M& message) {
  Bytes out;
  encode(message, out);
  return out;
}

template <class M>
std::string output(const M& message) {
  std::string out;
  testing::append_json(out, message);
  return out;
}

struct Mixed {
  std::uint8_t small = 0;
  double large = 0.0;
  std::string text;
  std::vector<std::uint16_t> list;
  bool flag = false;
  std::vector<std::string> names;

  static constexpr std::string_view kType = "test_msgs/msg/Mixed";
  static constexpr auto members() {
    return std::tuple{field("small", &Mixed::small), field("large", &Mixed::large),
                      field("text", &Mixed::text),   field("list", &Mixed::list),
                      field("flag", &Mixed::flag),   field("names", &Mixed::names)};
  }
};

struct Nothing {
  static constexpr std::string_view kType = "std_msgs/msg/Empty";
  static constexpr auto members() { return std::tuple{}; }
};

const Mixed kMixed{7, 1.0, "ab", {1, 2}, true, {"", "c"}};
// Written down by hand from the rules of CDR.
const Bytes kMixedBytes{0, 1, 0, 0,                        // plain CDR, little endian
                        7, 0, 0, 0, 0,   0,   0,    0,     // small, up to 8
                        0, 0, 0, 0, 0,   0,   0xF0, 0x3F,  // 1.0
                        3, 0, 0, 0, 'a', 'b', 0,    0,     // "ab", up to 4
                        2, 0, 0, 0, 1,   0,   2,    0,     // list
                        1, 0, 0, 0,                        // flag, up to 4
                        2, 0, 0, 0,                        // names
                        1, 0, 0, 0, 0,   0,   0,    0,    2, 0, 0, 0, 'c', 0};

TEST(Cdr, TheBytesAreThoseOfTheRules) {
  EXPECT_EQ(encoded(kMixed), kMixedBytes);
  EXPECT_EQ(encoded(Nothing{}), (Bytes{0, 1, 0, 0, 0}));
  EXPECT_TRUE(decode<Nothing>(encoded(Nothing{})));
}

TEST(Cdr, AlignmentCountsFromTheHeaderAlsoBehindOtherBytes) {
  for (std::size_t before = 0; before < 9; ++before) {
    Bytes out(before, 0xAA);
    encode(kMixed, out);
    EXPECT_EQ(Bytes(out.begin() + static_cast<std::ptrdiff_t>(before), out.end()), kMixedBytes);
  }
}

TEST(Cdr, BigEndianIsReadToo) {
  const Bytes bytes{0, 0, 0, 0, 0x40, 0x09, 0x21, 0xFB, 0x54, 0x44, 0x2D, 0x18, 0xC0, 0,
                    0, 0, 0, 0, 0,    0,    0,    0,    0,    0,    0,    0,    0,    0};
  const auto point = decode<Point>(bytes);
  ASSERT_TRUE(point) << to_string(point.error());
  EXPECT_EQ(point->x, 3.141592653589793);
  EXPECT_EQ(point->y, -2.0);
}

TEST(Cdr, EveryMessageComesBackAsItWas) {
  testing::Random random{1};
  testing::for_each_message([&]<class M>() {
    for (int i = 0; i < 20; ++i) {
      M message;
      testing::fill(random, message);
      const Bytes bytes = encoded(message);
      const auto back = decode<M>(bytes);
      ASSERT_TRUE(back) << M::kType << ": " << to_string(back.error());
      EXPECT_EQ(output(*back), output(message)) << M::kType;
      EXPECT_EQ(encoded(*back), bytes);
    }
  });
}

TEST(Cdr, IntoAMessageWithRoomItIsReadWithoutAllocation) {
  PointCloud2 cloud;
  cloud.header.frame_id = "a frame with a name that is longer than a small string";
  cloud.fields = {{"x", 0, 7, 1}, {"intensity_of_a_long_name", 4, 7, 1}};
  cloud.data.resize(10'000, 7);
  std::vector<std::uint8_t> cdr;
  encode(cloud, cdr);
  PointCloud2 message;
  ASSERT_FALSE(decode_into(cdr, message));
  EXPECT_EQ(message.data, cloud.data);
  EXPECT_EQ(message.header.frame_id, cloud.header.frame_id);
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  EXPECT_EQ(pitwall::testing::allocations_of([&] { (void)decode_into(cdr, message); }), 0U);
  message = PointCloud2{};
  EXPECT_GT(pitwall::testing::allocations_of([&] { (void)decode_into(cdr, message); }), 0U);
}

// Up to three bytes are the padding of RTPS, and whatever they hold says nothing.
TEST(Cdr, PaddingBehindIsReadOverAndMoreIsRefused) {
  Bytes bytes = kMixedBytes;
  for (int extra = 1; extra <= 4; ++extra) {
    bytes.push_back(0xEE);
    EXPECT_EQ(decode<Mixed>(bytes).has_value(), extra <= 3) << extra;
  }
}

TEST(Cdr, ACutMessageIsRefusedWithTheFieldWhereItEnds) {
  for (std::size_t length = 0; length < kMixedBytes.size(); ++length) {
    const auto got = decode<Mixed>(std::span{kMixedBytes}.first(length));
    ASSERT_FALSE(got) << length;
    const std::string place = got.error().place;
    EXPECT_EQ(place == "message", length < kCdrHeader);
    EXPECT_EQ(place == "field small", length == kCdrHeader);
    EXPECT_EQ(place == "field large", length > kCdrHeader && length < 20);
  }
}

TEST(Cdr, WhatNoWriterMakesIsRefusedWithItsReason) {
  const auto spoiled = [](std::size_t at, std::uint8_t value) {
    Bytes bytes = kMixedBytes;
    bytes[at] = value;
    const auto got = decode<Mixed>(bytes);
    return got ? std::string{} : to_string(got.error());
  };
  EXPECT_EQ(spoiled(1, 7), "message: error: expected plain CDR, found representation 0, 7");
  EXPECT_EQ(spoiled(0, 1), "message: error: expected plain CDR, found representation 1, 1");
  EXPECT_EQ(spoiled(26, 'c'), "field text: error: expected NUL at the end of the string");
  EXPECT_EQ(spoiled(36, 2), "field flag: error: expected a bool of 0 or 1, found 2");
  EXPECT_EQ(spoiled(31, 0xFF), "field list: error: 4278190082 elements do not fit into 26 bytes");
}

// Nobody promises what a spoiled message says; it must end, and inside of its bytes.
TEST(Cdr, SpoiledMessagesEndInAMessageOrARefusal) {
  testing::Random random{2};
  int refused = 0;
  for (int i = 0; i < 3'000; ++i) {
    MarkerArray message;
    testing::fill(random, message);
    Bytes bytes = encoded(message);
    for (int flips = 0; flips < 3; ++flips)
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    bytes.resize(bytes.size() - random() % 4);
    const auto got = decode<MarkerArray>(bytes);
    refused += got ? 0 : 1;
    EXPECT_TRUE(!got || got->markers.size() <= bytes.size());
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace pitwall::ros
