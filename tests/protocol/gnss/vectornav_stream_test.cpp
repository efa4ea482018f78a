// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/vectornav_stream.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/protocol/gnss/bytes.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

namespace pitwall::gnss {
namespace {

const std::array<VectorNavOutput, 2> kOutputs{VectorNavOutput{}
                                                  .with(vectornav::kTimeGps)
                                                  .with(vectornav::kAccel)
                                                  .with(vectornav::kAngularRate),
                                              VectorNavOutput{}
                                                  .with(vectornav::kTimeGps)
                                                  .with(vectornav::kInsPosition)
                                                  .with(vectornav::kGnssFix)
                                                  .with(vectornav::kGnssStatus)};

Bytes message_at(std::uint64_t time, std::mt19937_64& random) {
  VectorNavMessage message = random_vectornav(kOutputs[time % 2], random);
  message.time_gps_ns = time;
  Bytes bytes(kMaxVectorNavBytes);
  bytes.resize(encode(message, bytes));
  return bytes;
}

std::vector<std::uint64_t> times_in(VectorNavStream& stream, const Bytes& bytes,
                                    std::size_t piece) {
  std::vector<std::uint64_t> times;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    const std::size_t n = std::min(piece, bytes.size() - at);
    stream.feed(std::span{bytes}.subspan(at, n), [&](const VectorNavFrame& frame) {
      const auto message = decode(frame);
      ASSERT_TRUE(message.has_value());
      times.push_back(message->time_gps_ns);
    });
  }
  return times;
}

// Sync bytes and beginnings of headers are likely in it.
Bytes among_garbage(std::uint64_t messages, std::mt19937_64& random) {
  constexpr std::array<std::uint8_t, 6> kAlphabet{0xFA, 0x06, 0x2A, 0x02, 0x00, 0x24};
  Bytes bytes;
  for (std::uint64_t i = 0; i < messages; ++i) {
    for (std::uint64_t k = random() % 40; k > 0; --k) bytes.push_back(kAlphabet[random() % 6]);
    const Bytes message = message_at(i, random);
    const auto part = static_cast<std::ptrdiff_t>(random() % message.size());
    if (random() % 3 == 0) append(bytes, {message.begin(), message.begin() + part});
    append(bytes, message);
  }
  bytes.resize(bytes.size() + kMaxVectorNavBytes, 0);  // lets every false start end
  return bytes;
}

TEST(VectorNavStream, FindsEveryMessageAmongGarbageHoweverTheBytesAreCut) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random{seed};
    const Bytes bytes = among_garbage(30, random);
    std::vector<std::uint64_t> expected(30);
    for (std::uint64_t i = 0; i < 30; ++i) expected[i] = i;
    std::uint64_t garbage = 0;
    for (const std::size_t piece :
         {std::size_t{1}, std::size_t{7}, 1 + random() % 100, bytes.size()}) {
      VectorNavStream stream{kOutputs};
      EXPECT_EQ(times_in(stream, bytes, piece), expected) << "seed " << seed << " piece " << piece;
      EXPECT_EQ(stream.counters().bytes, bytes.size());
      EXPECT_EQ(stream.counters().frames, 30U);
      if (piece == 1) garbage = stream.counters().garbage_bytes;
      EXPECT_EQ(stream.counters().garbage_bytes, garbage);
    }
  }
}

TEST(VectorNavStream, AFlippedBitCostsItsOwnMessageOnly) {
  std::mt19937_64 random{3};
  const Bytes first = message_at(1, random), second = message_at(2, random);
  for (std::size_t bit = 0; bit < first.size() * 8; ++bit) {
    Bytes bytes = first;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
    append(bytes, second);
    bytes.resize(bytes.size() + kMaxVectorNavBytes, 0);
    VectorNavStream stream{kOutputs};
    EXPECT_EQ(times_in(stream, bytes, bytes.size()), std::vector<std::uint64_t>{2}) << bit;
  }
}

TEST(VectorNavStream, CountsHowOftenItWasAstray) {
  std::mt19937_64 random{5};
  const Bytes bytes = among_garbage(30, random);
  std::uint64_t resyncs = 0;
  for (const std::size_t piece : {std::size_t{1}, std::size_t{9}, bytes.size()}) {
    VectorNavStream stream{kOutputs};
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      stream.feed(std::span{bytes}.subspan(at, std::min(piece, bytes.size() - at)),
                  [](const VectorNavFrame&) {});
    if (piece == 1) resyncs = stream.counters().resyncs;
    EXPECT_GT(stream.counters().resyncs, 0U);
    EXPECT_LE(stream.counters().resyncs, 31U);  // before each message and at the end
    EXPECT_EQ(stream.counters().resyncs, resyncs) << piece;
  }
}

TEST(VectorNavStream, CountsWhatNobodyAskedFor) {
  std::mt19937_64 random{4};
  Bytes bytes = message_at(0, random);
  append(bytes, message_at(1, random));
  VectorNavStream stream{std::span{kOutputs}.first(1)};
  EXPECT_EQ(times_in(stream, bytes, 9), std::vector<std::uint64_t>{0});
  EXPECT_GE(stream.counters().unexpected, 1U);
  EXPECT_EQ(stream.counters().frames, 1U);
  VectorNavStream open;
  EXPECT_EQ(times_in(open, bytes, 9), (std::vector<std::uint64_t>{0, 1}));
}

TEST(VectorNavStream, CountsDamage) {
  std::mt19937_64 random{5};
  Bytes bytes = message_at(1, random);
  bytes[20] ^= 1U;
  VectorNavStream stream{kOutputs};
  EXPECT_TRUE(times_in(stream, bytes, bytes.size()).empty());
  EXPECT_EQ(stream.counters().bad_crc, 1U);
}

}  // namespace
}  // namespace pitwall::gnss
