// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/line_framing.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace pitwall::transport {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes framed(const Bytes& datagram) {
  std::array<std::uint8_t, kMaxLineFrameBytes> out{};
  const std::size_t n = encode_line_frame(datagram, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)};
}

Bytes any_datagram(std::mt19937_64& random, std::size_t most) {
  Bytes out(random() % (most + 1));
  for (auto& b : out) b = static_cast<std::uint8_t>(random());
  // Often enough, what looks like the beginning of a frame.
  for (std::size_t i = 0; i + 1 < out.size(); ++i)
    if (random() % 7 == 0) out[i] = kLineMagic[0], out[i + 1] = kLineMagic[1];
  return out;
}

// Feeds in pieces of any size and returns all that comes out.
std::vector<Bytes> decode(LineDecoder& decoder, const Bytes& wire, std::mt19937_64& random) {
  std::vector<Bytes> out;
  std::size_t at = 0;
  while (at < wire.size()) {
    const std::size_t piece = std::min<std::size_t>(1 + random() % 700, wire.size() - at);
    at += decoder.feed(std::span(wire).subspan(at, piece));
    while (const auto d = decoder.next()) out.emplace_back(d->begin(), d->end());
  }
  return out;
}

TEST(LineFraming, TheHeaderCheckIsTheCatalogued) {
  const std::string check = "123456789";
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(check.data()), check.size());
  EXPECT_EQ(line_crc8(bytes), 0xF4);
}

TEST(LineFraming, WhatGoesInComesOutHoweverItIsCut) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 200; ++round) {
    LineDecoder decoder;
    std::vector<Bytes> sent;
    Bytes wire;
    for (int i = 0; i < 20; ++i) {
      sent.push_back(any_datagram(random, i == 0 ? kMaxLineDatagramBytes : 300));
      const Bytes f = framed(sent.back());
      wire.insert(wire.end(), f.begin(), f.end());
    }
    ASSERT_EQ(decode(decoder, wire, random), sent);
    ASSERT_EQ(decoder.counters().datagrams, sent.size());
    ASSERT_EQ(decoder.counters().foreign_bytes, 0U);
  }
}

TEST(LineFraming, ForeignBytesBetweenCostNothing) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 200; ++round) {
    LineDecoder decoder;
    std::vector<Bytes> sent;
    Bytes wire;
    std::size_t foreign = 0;
    for (int i = 0; i < 20; ++i) {
      // Console text, or bytes that look like magic but are none.
      Bytes noise = any_datagram(random, 60);
      if (random() % 2 == 0) noise.push_back(kLineMagic[0]);
      wire.insert(wire.end(), noise.begin(), noise.end());
      foreign += noise.size();
      sent.push_back(any_datagram(random, 200));
      const Bytes f = framed(sent.back());
      wire.insert(wire.end(), f.begin(), f.end());
    }
    ASSERT_EQ(decode(decoder, wire, random), sent) << "round " << round;
    ASSERT_EQ(decoder.counters().foreign_bytes, foreign);
  }
}

TEST(LineFraming, ADamagedByteCostsOneDatagramAtMost) {
  std::mt19937_64 random(9);
  for (int round = 0; round < 300; ++round) {
    LineDecoder decoder;
    std::vector<Bytes> sent;
    Bytes wire;
    for (int i = 0; i < 10; ++i) {
      sent.push_back(any_datagram(random, 100));
      sent.back().push_back(static_cast<std::uint8_t>(i));  // all different
      const Bytes f = framed(sent.back());
      wire.insert(wire.end(), f.begin(), f.end());
    }
    // A full-length frame's worth of silence ends any wait for a length that was damaged.
    const std::size_t at = random() % wire.size();
    wire[at] = static_cast<std::uint8_t>(wire[at] ^ (1U << (random() % 8)));
    wire.insert(wire.end(), kMaxLineFrameBytes, 0);
    const auto got = decode(decoder, wire, random);
    ASSERT_EQ(got.size(), sent.size() - 1) << "byte " << at;
    std::size_t next = 0;
    for (const Bytes& d : got) {
      while (next < sent.size() && sent[next] != d) ++next;
      ASSERT_LT(next, sent.size()) << "an invented datagram";
    }
  }
}

TEST(LineFraming, TooLongIsRefused) {
  std::array<std::uint8_t, kMaxLineFrameBytes> out{};
  EXPECT_EQ(encode_line_frame(Bytes(kMaxLineDatagramBytes + 1), out), 0U);
  EXPECT_EQ(encode_line_frame(Bytes(kMaxLineDatagramBytes), out), kMaxLineFrameBytes);
}

}  // namespace
}  // namespace pitwall::transport
