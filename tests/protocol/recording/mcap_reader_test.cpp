// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/protocol/recording/mcap_samples.hpp"

namespace pitwall::recording {
namespace {

constexpr std::uint32_t kMessages = 60;

std::vector<std::uint8_t> recorded() {
  testing::MemoryFile file;
  McapWriter writer{{{"/a", "raw", {}, {}}, {"/b", "raw", {"B", "text", "b"}, {{"k", "v"}}}},
                    {{"seed", "1"}},
                    file.sink(),
                    {.messages_per_chunk = 8}};
  for (std::uint32_t i = 0; i < kMessages; ++i) {
    const std::vector<std::uint8_t> data(i % 13, static_cast<std::uint8_t>(i));
    EXPECT_TRUE(writer.write({static_cast<std::uint16_t>(i % 2)}, Instant{i}, data));
  }
  EXPECT_TRUE(writer.close());
  return file.bytes;
}

std::uint64_t count_messages(McapReader& reader) {
  std::uint64_t count = 0;
  while (const auto message = reader.next()) {
    EXPECT_EQ(message->logged_ns, count);
    EXPECT_EQ(message->data.size(), count % 13);
    ++count;
  }
  EXPECT_EQ(reader.counters().messages, count);
  return count;
}

// Ends of the messages' records: offsets at which one more message is whole.
std::vector<std::size_t> message_ends(std::span<const std::uint8_t> file) {
  std::vector<std::size_t> ends;
  McapReader reader{file};
  while (const auto m = reader.next()) {
    ends.push_back(static_cast<std::size_t>(m->data.data() + m->data.size() - file.data()));
  }
  return ends;
}

TEST(McapReader, ReadsAWholeFile) {
  const auto file = recorded();
  McapReader reader{file};
  EXPECT_EQ(count_messages(reader), kMessages);
  EXPECT_EQ(reader.end(), McapEnd::kComplete);
  EXPECT_EQ(reader.place(), file.size());
  EXPECT_EQ(reader.counters().unverified, 0U);
  EXPECT_EQ(reader.counters().chunks, 8U);
  EXPECT_EQ(reader.channels().at(1).topic, "/b");
  EXPECT_EQ(reader.channels().at(1).schema, (Schema{"B", "text", "b"}));
  EXPECT_EQ(reader.channels().at(1).metadata, (Metadata{{"k", "v"}}));
  EXPECT_EQ(reader.run(), (Metadata{{"seed", "1"}}));
}

TEST(McapReader, DeliversEverythingBeforeTheCutAndTellsWhereItIs) {
  const auto file = recorded();
  const auto ends = message_ends(file);
  ASSERT_EQ(ends.size(), kMessages);
  for (std::size_t length = 0; length < file.size(); ++length) {
    McapReader reader{std::span{file}.first(length)};
    const auto whole = std::ranges::count_if(ends, [&](std::size_t end) { return end <= length; });
    EXPECT_EQ(count_messages(reader), static_cast<std::uint64_t>(whole)) << length;
    EXPECT_EQ(reader.end(), length < 8 ? McapEnd::kNoMagic : McapEnd::kTruncated) << length;
    EXPECT_LE(reader.place(), length);
    if (whole > 0) {
      EXPECT_GE(reader.place(), ends[static_cast<std::size_t>(whole - 1)]);
    }
  }
}

TEST(McapReader, EveryBitFlipOfAMessageIsNoticed) {
  const auto file = recorded();
  const auto ends = message_ends(file);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (i % 13 == 0) continue;  // no data
    auto bad = file;
    bad[ends[i] - 1] ^= 0x10;
    McapReader reader{bad};
    std::uint64_t count = 0;
    while (reader.next()) ++count;
    EXPECT_EQ(reader.counters().bad_chunk_crc, 1U);
    EXPECT_EQ(reader.counters().bad_data_crc, 1U);
    EXPECT_GE(count, kMessages - 8) << "only the chunk that is broken is left out";
    EXPECT_LT(count, kMessages);
    EXPECT_EQ(reader.end(), McapEnd::kComplete);
  }
}

TEST(McapReader, ATailOfZerosIsAnEndWithAPlace) {
  auto file = recorded();
  const auto ends = message_ends(file);
  const std::size_t cut = ends[7];  // the end of the first chunk's messages
  file.resize(cut);
  file.resize(cut + 4096, 0);
  McapReader reader{file};
  EXPECT_EQ(count_messages(reader), 8U);
  EXPECT_EQ(reader.end(), McapEnd::kMalformed);
  EXPECT_EQ(reader.place(), cut);
}

TEST(McapReader, BrokenSummaryIsCountedAndBytesAfterTheEndAreMalformed) {
  auto file = recorded();
  auto bad = file;
  bad[bad.size() - 8 - 4 - 30] ^= 1;
  McapReader summary{bad};
  EXPECT_EQ(count_messages(summary), kMessages);
  EXPECT_EQ(summary.counters().bad_summary_crc, 1U);
  file.push_back(0);
  McapReader longer{file};
  EXPECT_EQ(count_messages(longer), kMessages);
  EXPECT_EQ(longer.end(), McapEnd::kMalformed);
}

TEST(McapReader, OtherFilesHaveNoMagic) {
  for (const std::string& text : {std::string{}, std::string{"MCAP"}, std::string(100, 'x')}) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    McapReader reader{bytes};
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.end(), McapEnd::kNoMagic);
  }
}

TEST(McapReader, NoBytesMakeItReadOutsideOrRunForever) {
  const auto file = recorded();
  std::uint32_t seed = 1;
  const auto random = [&seed](std::size_t below) {
    seed = seed * 1664525U + 1013904223U;  // Numerical Recipes, ranqd1
    return static_cast<std::size_t>(seed >> 8) % below;
  };
  for (int run = 0; run < 4000; ++run) {
    auto bad = file;
    for (std::size_t n = 1 + random(8); n > 0; --n) {
      // Half of the damage goes where the lengths are.
      const std::size_t at = random(2) == 0 ? random(200) : random(bad.size());
      bad[at] = static_cast<std::uint8_t>(random(4) == 0 ? 0xFF : random(256));
    }
    bad.resize(bad.size() - random(2) * random(bad.size()));
    McapReader reader{bad};
    std::uint64_t count = 0, sum = 0;
    while (const auto m = reader.next()) {
      ++count;
      for (const std::uint8_t byte : m->data) sum += byte;
    }
    EXPECT_NE(reader.end(), McapEnd::kReading);
    EXPECT_LE(reader.place(), bad.size());
    EXPECT_LE(count, bad.size() / kMcapRecordHeaderBytes);
    EXPECT_LE(sum, bad.size() * 255);
  }
}

TEST(McapReader, EveryEndHasAName) {
  for (const McapEnd end : {McapEnd::kReading, McapEnd::kComplete, McapEnd::kNoMagic,
                            McapEnd::kTruncated, McapEnd::kMalformed}) {
    EXPECT_STRNE(to_string(end), "?");
  }
}

}  // namespace
}  // namespace pitwall::recording
