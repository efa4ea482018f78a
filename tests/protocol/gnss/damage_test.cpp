// SPDX-License-Identifier: Apache-2.0
// Logs of every kind with one to three bits flipped anywhere: none is accepted. Their number is
// raised by PITWALL_FLIPPED_LOGS; a million are the gate of a long run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <vector>

#include "protocol/gnss/novatel_ascii.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "protocol/gnss/vectornav_stream.hpp"
#include "tests/protocol/gnss/bytes.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

namespace pitwall::gnss {
namespace {

std::uint64_t logs_to_flip() {
  constexpr std::uint64_t kQuick = 100'000;
  const char* const wanted = std::getenv("PITWALL_FLIPPED_LOGS");
  const std::uint64_t count = wanted == nullptr ? 0 : std::strtoull(wanted, nullptr, 10);
  return count > kQuick ? count : kQuick;
}

// As many as chosen, of different places.
void flip(Bytes& bytes, std::mt19937_64& random) {
  const Bytes before = bytes;
  for (std::uint64_t n = 1 + random() % 3; n > 0 || bytes == before; n -= n > 0 ? 1 : 0) {
    const std::size_t bit = random() % (8 * bytes.size());
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1U << bit % 8);
  }
}

// The checksum of a text in another case is no damage: it may have one letter only.
bool is_same_text(const Bytes& a, const Bytes& b) {
  constexpr std::size_t kTail = 10;
  const auto whole = static_cast<std::ptrdiff_t>(b.size() - kTail);
  return std::equal(b.begin(), b.begin() + whole, a.begin()) &&
         std::equal(b.begin() + whole, b.end(), a.begin() + whole,
                    [](int x, int y) { return std::tolower(x) == std::tolower(y); });
}

template <class Encode>
Bytes written(std::size_t room, Encode encode_into) {
  Bytes bytes(room);
  bytes.resize(encode_into(std::span{bytes}));
  return bytes;
}

// What follows lets every false start in the damaged log come to its end.
template <class Stream>
std::uint64_t accepted(Stream& stream, const Bytes& damaged) {
  static const Bytes kQuiet(NovatelStream::kMaxFrameBytes, 0);
  std::uint64_t frames = 0;
  const auto count = [&frames](const auto&) { ++frames; };
  stream.feed(damaged, count);
  stream.feed(kQuiet, count);
  return frames;
}

TEST(Damage, NoNovatelLogWithFlippedBitsIsAccepted) {
  std::mt19937_64 random{2026};
  NovatelStream stream;
  std::uint64_t binary = 0, ascii = 0, seen = 0;
  for (std::uint64_t i = 0, n = logs_to_flip(); i < n; ++i) {
    const NovatelMessage message = random_message(i / 2 % kLogs, random);
    const NovatelHeader header = random_header(random);
    Bytes bytes =
        i % 2 == 0
            ? written(kMaxEncodedBytes, [&](auto out) { return encode(header, message, out); })
            : written(kMaxAsciiBytes, [&](auto out) { return encode_ascii(header, message, out); });
    if (i % 1'000 < 2) seen += accepted(stream, bytes);  // it is the damage that is refused
    const Bytes whole = bytes;
    flip(bytes, random);
    if (i % 2 == 1 && is_same_text(bytes, whole)) continue;
    (i % 2 == 0 ? binary : ascii) += accepted(stream, bytes);
  }
  EXPECT_EQ(binary, 0U);
  EXPECT_EQ(ascii, 0U);
  EXPECT_EQ(seen, logs_to_flip() / 1'000 * 2);
}

TEST(Damage, NoVectorNavMessageWithFlippedBitsIsAccepted) {
  std::mt19937_64 random{310};
  std::uint64_t damaged = 0, seen = 0;
  for (std::uint64_t i = 0, n = logs_to_flip(); i < n; ++i) {
    const VectorNavOutput output = random_output(random);
    const VectorNavMessage message = random_vectornav(output, random);
    VectorNavStream stream{std::span{&output, 1}};
    Bytes bytes = written(kMaxVectorNavBytes, [&](auto out) { return encode(message, out); });
    if (i % 1'000 == 0) seen += accepted(stream, bytes);
    flip(bytes, random);
    damaged += accepted(stream, bytes);
  }
  EXPECT_EQ(damaged, 0U);
  EXPECT_EQ(seen, logs_to_flip() / 1'000);
}

// Noise alone: a CRC-16 would let one in 65,536 false starts of a message through.
TEST(Damage, NoiseIsNoMessage) {
  std::mt19937_64 random{7};
  const VectorNavOutput output = VectorNavOutput{}
                                     .with(vectornav::kTimeGps)
                                     .with(vectornav::kAccel)
                                     .with(vectornav::kInsStatus);
  VectorNavStream vectornav{std::span{&output, 1}};
  NovatelStream novatel;
  std::uint64_t frames = 0;
  for (int round = 0; round < 200; ++round) {
    Bytes noise(5'000);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    frames += accepted(vectornav, noise) + accepted(novatel, noise);
  }
  EXPECT_EQ(frames, 0U);
}

}  // namespace
}  // namespace pitwall::gnss
