// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_writer.hpp"

#include <gtest/gtest.h>

#include "protocol/recording/mcap_reader.hpp"
#include "tests/protocol/recording/mcap_samples.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::recording {
namespace {

const std::vector<Channel> kChannels{cdr_channel<testing::Sample>("/a"), {"/b", "json", {}, {}}};
constexpr std::array<std::uint8_t, 5> kData{1, 2, 3, 4, 5};

std::vector<std::uint8_t> file_of(McapLimits limits, std::uint32_t messages) {
  testing::MemoryFile file;
  McapWriter writer{kChannels, {{"seed", "1"}}, file.sink(), limits};
  for (std::uint32_t i = 0; i < messages; ++i) {
    EXPECT_TRUE(writer.write({static_cast<std::uint16_t>(i % 2)}, Instant{i * 1000}, kData));
  }
  EXPECT_TRUE(writer.close());
  EXPECT_EQ(writer.counters().bytes, file.bytes.size());
  return file.bytes;
}

TEST(McapWriter, TheSameInputGivesTheSameBytes) {
  EXPECT_EQ(file_of({}, 500), file_of({}, 500));
  EXPECT_NE(file_of({}, 500), file_of({}, 499));
}

TEST(McapWriter, EveryLimitOfAChunkHoldsAndNoMessageIsLost) {
  for (const McapLimits limits :
       {McapLimits{}, McapLimits{.chunk_bytes = 36}, McapLimits{.chunk_bytes = 100},
        McapLimits{.messages_per_chunk = 1}, McapLimits{.messages_per_chunk = 7},
        McapLimits{.chunk_span = nanoseconds(2500)}, McapLimits{.chunk_span = Duration{}}}) {
    const auto bytes = file_of(limits, 50);
    McapReader reader{bytes};
    std::uint64_t count = 0;
    while (const auto m = reader.next()) {
      EXPECT_EQ(m->logged_ns, count * 1000);
      EXPECT_EQ(m->sequence, count / 2);
      ++count;
    }
    EXPECT_EQ(count, 50U);
    EXPECT_EQ(reader.end(), McapEnd::kComplete);
    EXPECT_EQ(reader.counters().unverified, 0U);
    const std::uint64_t by_count = (50 + limits.messages_per_chunk - 1) / limits.messages_per_chunk;
    EXPECT_GE(reader.counters().chunks, by_count);
    if (limits.chunk_span.ns == 2500) {
      EXPECT_EQ(reader.counters().chunks, 17U);
    }
    if (limits.chunk_bytes == 36) {
      EXPECT_EQ(reader.counters().chunks, 50U);
    }
  }
}

TEST(McapWriter, EveryRefusalIsCountedByItsReason) {
  testing::MemoryFile file;
  McapWriter writer{kChannels, {}, file.sink(), {.chunk_bytes = 36}};
  const std::vector<std::uint8_t> large(6);
  EXPECT_TRUE(writer.write({0}, Instant{}, kData));  // 9 + 22 + 5: just fits
  EXPECT_FALSE(writer.write({0}, Instant{}, large));
  EXPECT_FALSE(writer.write({2}, Instant{}, kData));
  EXPECT_FALSE(writer.write({0}, Instant{-1}, kData));
  EXPECT_FALSE(writer.write({0}, Instant{}, Instant{-1}, kData));
  EXPECT_TRUE(writer.close());
  EXPECT_TRUE(writer.close());
  EXPECT_FALSE(writer.write({0}, Instant{}, kData));
  const McapCounters& counters = writer.counters();
  EXPECT_EQ(counters.messages, 1U);
  EXPECT_EQ(counters.refused_size, 1U);
  EXPECT_EQ(counters.refused_channel, 1U);
  EXPECT_EQ(counters.refused_time, 2U);
  EXPECT_EQ(counters.refused_closed, 1U);
  EXPECT_EQ(counters.refused(), 5U);
}

TEST(McapWriter, AfterTheSinkHasFailedNothingMoreIsWritten) {
  const std::size_t whole = file_of({.messages_per_chunk = 4}, 40).size();
  for (std::size_t room = 0; room < whole; room += 97) {
    std::vector<std::uint8_t> disk;
    bool full = false;
    const Sink sink = [&](std::span<const std::uint8_t> bytes) {
      EXPECT_FALSE(full) << "written after a failure";
      full = disk.size() + bytes.size() > room;
      if (!full) disk.insert(disk.end(), bytes.begin(), bytes.end());
      return !full;
    };
    McapWriter writer{kChannels, {{"seed", "1"}}, sink, {.messages_per_chunk = 4}};
    std::uint64_t refused = 0;
    for (std::uint32_t i = 0; i < 40; ++i) {
      const ChannelId channel{static_cast<std::uint16_t>(i % 2)};
      if (!writer.write(channel, Instant{i * 1000}, kData)) ++refused;
    }
    EXPECT_FALSE(writer.close());
    EXPECT_EQ(writer.counters().refused_sink, refused);
    EXPECT_EQ(writer.counters().bytes, disk.size());
  }
}

TEST(McapWriter, AMessageAllocatesNothing) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer owns the heap";
  std::vector<int> any;
  ASSERT_GT(pitwall::testing::allocations_of([&] { any.resize(100); }), 0U) << "the guard sees";
  std::uint64_t bytes = 0;
  const Sink sink = [&](std::span<const std::uint8_t> more) {
    bytes += more.size();
    return true;
  };
  McapWriter writer{kChannels, {}, sink, {.chunk_bytes = 4096, .chunks = 512}};
  bool written = true;
  const std::size_t allocations = pitwall::testing::allocations_of([&] {
    for (std::int64_t i = 0; i < 40'000; ++i) {
      written = writer.write({static_cast<std::uint16_t>(i % 2)}, Instant{i}, kData) && written;
    }
  });
  EXPECT_TRUE(written);
  EXPECT_GT(writer.counters().chunks, 300U);
  EXPECT_EQ(allocations, 0U);
}

}  // namespace
}  // namespace pitwall::recording
