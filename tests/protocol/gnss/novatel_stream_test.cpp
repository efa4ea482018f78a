// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_stream.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "protocol/gnss/novatel_ascii.hpp"
#include "protocol/vocabulary/random.hpp"
#include "tests/protocol/gnss/bytes.hpp"

namespace pitwall::gnss {
namespace {

Bytes frame_of(std::uint32_t ms) {
  std::array<std::uint8_t, kMaxEncodedBytes> out{};
  NovatelHeader header;
  header.week = 2209, header.milliseconds = ms;
  BestVel m{.solution_status = 0, .velocity_type = 8};
  m.horizontal_mps = m.track_over_ground_deg = m.vertical_mps = 1.0;
  RawImuSx raw{.week = 2209, .seconds = ms * 1e-3};
  const std::size_t n = ms % 2 == 0 ? encode(header, m, out) : encode(header, raw, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)};
}

Bytes ascii_of(std::uint32_t ms) {
  std::array<std::uint8_t, kMaxAsciiBytes> out{};
  NovatelHeader header;
  header.week = 2209, header.milliseconds = ms;
  RawImuSx raw{.week = 2209, .seconds = ms * 1e-3};
  Time time{.offset_s = 0.0, .offset_sigma_s = 0.0, .utc_offset_s = -18.0};
  const std::size_t n =
      ms % 2 == 0 ? encode_ascii(header, time, out) : encode_ascii(header, raw, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)};
}

std::vector<std::uint32_t> times_in(NovatelStream& stream, const Bytes& bytes, std::size_t piece) {
  std::vector<std::uint32_t> times;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    const std::size_t n = std::min(piece, bytes.size() - at);
    stream.feed(std::span{bytes}.subspan(at, n),
                [&](const NovatelFrame& f) { times.push_back(f.header.milliseconds); });
  }
  return times;
}

Bytes frames_among_garbage(Random& random, std::uint32_t frames) {
  Bytes bytes;
  for (std::uint32_t i = 0; i < frames; ++i) {
    const std::size_t garbage = random.below(40);
    // Sync bytes are likely in it, so that false starts happen.
    constexpr std::array<std::uint8_t, 6> kAlphabet{0xAA, 0x44, 0x12, 0x13, 0x1C, 0x00};
    for (std::size_t k = 0; k < garbage; ++k) {
      bytes.push_back(kAlphabet[random.below(kAlphabet.size())]);
    }
    append(bytes, frame_of(i));
  }
  bytes.resize(bytes.size() + NovatelStream::kMaxFrameBytes, 0);  // lets every false start end
  return bytes;
}

// Binary and ASCII by turns, NMEA and parts of logs between them.
Bytes mixed_stream(Random& random, std::uint32_t frames) {
  const std::string nmea = "$GPGGA,134658.00,5106.9792,N,11402.3003,W,2,09,1.0,1048.47,M,,,*5B\r\n";
  Bytes bytes;
  for (std::uint32_t i = 0; i < frames; ++i) {
    if (random.below(3) == 0) append(bytes, Bytes{nmea.begin(), nmea.end()});
    const Bytes frame = random.below(2) == 0 ? ascii_of(i) : frame_of(i);
    if (random.below(3) == 0) {
      append(bytes, {frame.begin(),
                     frame.begin() + static_cast<std::ptrdiff_t>(random.below(frame.size()))});
    }
    append(bytes, frame);
  }
  bytes.resize(bytes.size() + NovatelStream::kMaxFrameBytes, 0);
  return bytes;
}

TEST(NovatelStream, FindsBinaryAndAsciiMixedHoweverTheBytesAreCut) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random{seed * 0x9E3779B97F4A7C15ULL};
    const Bytes bytes = mixed_stream(random, 40);
    std::vector<std::uint32_t> expected(40);
    for (std::uint32_t i = 0; i < 40; ++i) expected[i] = i;
    StreamCounters first;
    for (const std::size_t piece :
         {std::size_t{1}, 1 + random.below(50), std::size_t{1'000}, bytes.size()}) {
      NovatelStream stream;
      EXPECT_EQ(times_in(stream, bytes, piece), expected) << "seed " << seed << " piece " << piece;
      if (piece == 1) first = stream.counters();
      EXPECT_EQ(stream.counters().garbage_bytes, first.garbage_bytes);
      EXPECT_EQ(stream.counters().ascii_frames, first.ascii_frames);
      EXPECT_EQ(stream.counters().bad_crc, first.bad_crc);
    }
    EXPECT_GT(first.ascii_frames, 0U);
  }
}

TEST(NovatelStream, ATextThatBeginsLikeALogHoldsUpItsOwnLengthOnly) {
  Bytes bytes(1'500, 'A');
  bytes[0] = '#';
  append(bytes, frame_of(8));
  NovatelStream stream;
  EXPECT_EQ(times_in(stream, bytes, 10), std::vector<std::uint32_t>{8});
  EXPECT_EQ(stream.counters().garbage_bytes, 1'500U);
}

// NovAtel writes its checksum in lower case, others in upper; nobody in both.
TEST(NovatelStream, TheChecksumOfATextMayBeInEitherCase) {
  constexpr std::size_t kTail = 10, kDigits = 8;
  int with_letters = 0;
  for (std::uint32_t ms = 0; ms < 200; ++ms) {
    const Bytes lower = ascii_of(ms);
    Bytes upper = lower, mixed = lower;
    int letters = 0;
    for (std::size_t i = lower.size() - kTail; i < lower.size() - kTail + kDigits; ++i) {
      if (lower[i] < 'a') continue;
      upper[i] = static_cast<std::uint8_t>(lower[i] - 'a' + 'A');
      if (letters++ == 0) mixed[i] = upper[i];
    }
    NovatelStream a, b, c;
    EXPECT_EQ(times_in(a, lower, 5), std::vector<std::uint32_t>{ms});
    EXPECT_EQ(times_in(b, upper, 5), std::vector<std::uint32_t>{ms});
    if (letters < 2) continue;
    ++with_letters;
    EXPECT_TRUE(times_in(c, mixed, 5).empty()) << ms;
  }
  EXPECT_GT(with_letters, 100);
}

TEST(NovatelStream, CountsHowOftenItWasAstray) {
  NovatelStream stream;
  Bytes bytes = frame_of(0);
  append(bytes, frame_of(1));
  times_in(stream, bytes, 7);
  EXPECT_EQ(stream.counters().resyncs, 0U);
  bytes.assign(30, 0);  // one stretch, however long and however it is cut
  append(bytes, frame_of(2));
  times_in(stream, bytes, 7);
  EXPECT_EQ(stream.counters().resyncs, 1U);
  times_in(stream, bytes, 40);
  EXPECT_EQ(stream.counters().resyncs, 2U);
  EXPECT_EQ(stream.counters().garbage_bytes, 60U);
}

TEST(NovatelStream, AnAsciiLogEndsWithItsLineEnd) {
  Bytes bytes = ascii_of(6);
  const Bytes whole = bytes;
  for (std::size_t keep = 0; keep < whole.size(); ++keep) {
    NovatelStream stream;
    bytes.assign(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(keep));
    EXPECT_TRUE(times_in(stream, bytes, 5).empty()) << keep;
    append(bytes, whole);
    NovatelStream again;
    EXPECT_EQ(times_in(again, bytes, 5), std::vector<std::uint32_t>{6}) << keep;
  }
}

TEST(NovatelStream, FindsEveryFrameAmongGarbageHoweverTheBytesAreCut) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random{seed * 0x9E3779B97F4A7C15ULL};
    const Bytes bytes = frames_among_garbage(random, 30);
    std::vector<std::uint32_t> expected(30);
    for (std::uint32_t i = 0; i < 30; ++i) expected[i] = i;
    for (const std::size_t piece :
         {std::size_t{1}, std::size_t{7}, std::size_t{64}, bytes.size()}) {
      NovatelStream stream;
      EXPECT_EQ(times_in(stream, bytes, piece), expected) << "seed " << seed << " piece " << piece;
    }
  }
}

TEST(NovatelStream, EveryByteIsInAFrameOrInTheGarbageCount) {
  Random random{7};
  const Bytes bytes = frames_among_garbage(random, 10);
  NovatelStream stream;
  times_in(stream, bytes, 100);
  std::size_t framed = 0;
  for (std::uint32_t i = 0; i < 10; ++i) framed += frame_of(i).size();
  EXPECT_EQ(stream.counters().bytes, bytes.size());
  EXPECT_EQ(stream.counters().garbage_bytes, bytes.size() - framed);
  EXPECT_EQ(stream.counters().frames, 10U);
}

TEST(NovatelStream, AFlippedBitCostsItsOwnFrameOnly) {
  const Bytes first = frame_of(0), second = frame_of(1);
  for (std::size_t bit = 0; bit < first.size() * 8; ++bit) {
    Bytes bytes = first;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
    append(bytes, second);
    bytes.resize(bytes.size() + NovatelStream::kMaxFrameBytes, 0);
    NovatelStream stream;
    EXPECT_EQ(times_in(stream, bytes, bytes.size()), std::vector<std::uint32_t>{1}) << bit;
  }
}

TEST(NovatelStream, ATruncatedFrameCostsItselfOnly) {
  const Bytes first = frame_of(0), second = frame_of(1);
  for (std::size_t keep = 0; keep < first.size(); ++keep) {
    Bytes bytes{first.begin(), first.begin() + static_cast<std::ptrdiff_t>(keep)};
    append(bytes, second);
    bytes.resize(bytes.size() + NovatelStream::kMaxFrameBytes, 0);
    NovatelStream stream;
    EXPECT_EQ(times_in(stream, bytes, bytes.size()), std::vector<std::uint32_t>{1}) << keep;
  }
}

TEST(NovatelStream, RandomBytesNeverCrashAndAreAllCounted) {
  Random random{42};
  NovatelStream stream;
  Bytes bytes(200'000);
  for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.next() >> 32U);
  times_in(stream, bytes, 1'000);
  EXPECT_EQ(stream.counters().bytes, bytes.size());
  EXPECT_EQ(stream.counters().frames, 0U);
}

TEST(NovatelStream, CountsFramesThatSayTheyAreTooLong) {
  std::array<std::uint8_t, kLongHeaderBytes> header{};
  encode_header({.id = 43}, 9'000, header);
  Bytes bytes{header.begin(), header.end()};
  append(bytes, frame_of(3));
  NovatelStream stream;
  EXPECT_EQ(times_in(stream, bytes, bytes.size()), std::vector<std::uint32_t>{3});
  EXPECT_EQ(stream.counters().oversize, 1U);
}

TEST(NovatelStream, CountsHeadersOfALengthThatTheFormatDoesNotKnow) {
  Bytes bytes = frame_of(2);
  bytes[3] = 20;
  append(bytes, frame_of(3));
  NovatelStream stream;
  EXPECT_EQ(times_in(stream, bytes, bytes.size()), std::vector<std::uint32_t>{3});
  EXPECT_EQ(stream.counters().bad_header, 1U);
}

TEST(NovatelStream, CountsDamagedFrames) {
  Bytes bytes = frame_of(2);
  bytes[40] ^= 1U;
  NovatelStream stream;
  EXPECT_TRUE(times_in(stream, bytes, bytes.size()).empty());
  EXPECT_EQ(stream.counters().bad_crc, 1U);
}

}  // namespace
}  // namespace pitwall::gnss
