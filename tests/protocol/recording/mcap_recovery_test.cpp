// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_recovery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/protocol/recording/mcap_samples.hpp"
#include "tests/support/oracle_node.hpp"

namespace pitwall::recording {
namespace {

constexpr std::uint32_t kRunMessages = 240;
const Metadata kRun{{"car", "7"}, {"mode", "HIL"}};

std::vector<std::uint8_t> recorded_run() {
  testing::MemoryFile file;
  McapWriter writer{
      {{"/a", "raw", {}, {}}, {"/b", "json", {"B", "jsonschema", "{}"}, {{"k", "v"}}}},
      kRun,
      file.sink(),
      {.messages_per_chunk = 24}};
  for (std::uint32_t i = 0; i < kRunMessages; ++i) {
    const std::vector<std::uint8_t> data(1 + i % 13, static_cast<std::uint8_t>(i));
    EXPECT_TRUE(writer.write({static_cast<std::uint16_t>(i % 2)}, Instant{seconds(1).ns + i},
                             Instant{i}, data));
  }
  EXPECT_TRUE(writer.close());
  return file.bytes;
}

struct Kept {
  std::uint16_t channel;
  std::uint32_t sequence;
  std::uint64_t logged_ns, published_ns;
  std::vector<std::uint8_t> data;

  bool operator==(const Kept&) const = default;
};

// All of them; where the file must be whole, every CRC in it is right.
std::vector<Kept> messages_of(std::span<const std::uint8_t> file, bool whole) {
  std::vector<Kept> all;
  McapReader reader{file};
  while (const auto m = reader.next()) {
    all.push_back(
        {m->channel, m->sequence, m->logged_ns, m->published_ns, {m->data.begin(), m->data.end()}});
  }
  if (whole) {
    const McapReaderCounters& counters = reader.counters();
    EXPECT_EQ(reader.end(), McapEnd::kComplete);
    EXPECT_EQ(counters.bad_chunk_crc + counters.bad_data_crc + counters.bad_summary_crc, 0U);
    EXPECT_EQ(counters.unverified, 0U);
  }
  return all;
}

// Where the last chunks and all that follows them begin.
std::size_t begin_of_last_chunks(std::span<const std::uint8_t> file, std::uint32_t chunks) {
  McapReader reader{file};
  for (std::uint32_t i = 0; i + 24 * chunks < kRunMessages; ++i) EXPECT_TRUE(reader.next());
  const auto next = reader.next();
  return static_cast<std::size_t>(next->data.data() - file.data());
}

TEST(McapRecovery, AWholeFileKeepsEveryMessageAsItStood) {
  const auto file = recorded_run();
  const auto recovery = recover_mcap(file, "a.mcap");
  ASSERT_TRUE(recovery);
  EXPECT_TRUE(recovery->was_whole());
  EXPECT_EQ(recovery->kept, kRunMessages);
  EXPECT_EQ(messages_of(recovery->file, true), messages_of(file, true));
  McapReader reader{recovery->file};
  while (reader.next()) continue;
  EXPECT_EQ(reader.run(), kRun);
  EXPECT_EQ(reader.channels().at(1).metadata, (Metadata{{"k", "v"}}));
}

TEST(McapRecovery, CutAtAnyByteOfTheLastTwoChunksKeepsEveryWholeMessage) {
  const auto file = recorded_run();
  const auto all = messages_of(file, true);
  for (std::size_t length = begin_of_last_chunks(file, 2); length < file.size(); ++length) {
    const auto cut = std::span{file}.first(length);
    const auto there = messages_of(cut, false);
    const auto recovery = recover_mcap(cut, "cut.mcap");
    ASSERT_TRUE(recovery) << length;
    const auto kept = messages_of(recovery->file, true);
    EXPECT_EQ(kept, there) << length;
    EXPECT_GE(kept.size(), kRunMessages - 2 * 24U) << length;
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), all.begin())) << length;
    EXPECT_EQ(recovery->kept, kept.size());
    EXPECT_FALSE(recovery->was_whole());
    EXPECT_LE(recovery->bytes_lost, length);
  }
}

TEST(McapRecovery, CutInFrontOfTheFirstMessageGivesAnEmptyFile) {
  const auto file = recorded_run();
  for (std::size_t length = 0; length < 200; ++length) {
    const auto recovery = recover_mcap(std::span{file}.first(length), "head.mcap");
    ASSERT_EQ(recovery.has_value(), length >= kMcapMagic.size()) << length;
    if (!recovery) {
      EXPECT_EQ(to_string(recovery.error()), "head.mcap: error: not an MCAP file");
    } else {
      messages_of(recovery->file, true);
    }
  }
}

TEST(McapRecovery, AWrongByteAnywhereLosesNoMoreThanItsPlace) {
  const auto file = recorded_run();
  const auto all = messages_of(file, true);
  std::size_t fewest = kRunMessages;
  const std::size_t first = begin_of_last_chunks(file, 2);
  for (std::size_t at = first; at < file.size(); at += 2) {
    auto damaged = file;
    damaged[at] ^= 0x41U;
    const auto recovery = recover_mcap(damaged, "x.mcap");
    ASSERT_TRUE(recovery) << at;
    const auto kept = messages_of(recovery->file, true);
    for (const Kept& message : kept) {
      EXPECT_NE(std::ranges::find(all, message), all.end()) << at;
    }
    fewest = std::min(fewest, kept.size());
    if (kept.size() < kRunMessages) {
      EXPECT_FALSE(recovery->lossless()) << at;
    }
  }
  EXPECT_GE(fewest, kRunMessages - 2 * 24U);
}

TEST(McapRecovery, OfAChunkWithoutChecksumOnlyMessagesOfItsTimeAreKept) {
  auto file = recorded_run();
  McapReader reader{file};
  std::size_t last = 0;
  while (const auto m = reader.next())
    last = static_cast<std::size_t>(m->data.data() - file.data());
  file.resize(last);          // the last message is cut
  file[last - 100] ^= 0xFFU;  // something in the chunk before it
  const auto recovery = recover_mcap(file, "x.mcap");
  ASSERT_TRUE(recovery);
  EXPECT_GT(recovery->kept, kRunMessages - 24U);
  for (const Kept& m : messages_of(recovery->file, true)) {
    EXPECT_GE(m.logged_ns, static_cast<std::uint64_t>(seconds(1).ns));
    EXPECT_LT(m.logged_ns, static_cast<std::uint64_t>(seconds(1).ns) + kRunMessages);
  }
}

TEST(McapRecovery, TellsAPersonWhatBecameOfTheFile) {
  const auto file = recorded_run();
  EXPECT_EQ(to_string(*recover_mcap(file, "")),
            "240 messages kept (0.000000 s); the file was whole");
  const auto cut = recover_mcap(std::span{file}.first(begin_of_last_chunks(file, 1)), "");
  const std::string text = to_string(*cut);
  EXPECT_NE(text.find("216 messages kept"), std::string::npos) << text;
  EXPECT_NE(text.find("truncated"), std::string::npos) << text;
}

TEST(McapRecovery, TheOracleReadsWhatIsRecovered) {
  NEEDS_ORACLES();
  const auto file = recorded_run();
  const std::filesystem::path folder = std::filesystem::path{::testing::TempDir()} / "pitwall_cut";
  std::filesystem::create_directories(folder);
  std::string arguments, expected;
  const std::size_t first = begin_of_last_chunks(file, 2);
  for (std::size_t i = 0; i <= 24; ++i) {
    const std::size_t length = first + (file.size() - first) * i / 24;
    const auto recovery = recover_mcap(std::span{file}.first(length), "cut");
    ASSERT_TRUE(recovery);
    const auto path = folder / (std::to_string(length) + ".mcap");
    std::ofstream{path, std::ios::binary}.write(
        reinterpret_cast<const char*>(recovery->file.data()),
        static_cast<std::streamsize>(recovery->file.size()));
    arguments += " '" + path.string() + "'";
    expected += std::to_string(recovery->kept) + " 1000000000 " +
                std::to_string(1'000'000'000 + recovery->kept - 1) + " /a,/b\n";
  }
  EXPECT_EQ(pitwall::testing::node("check_mcap.mjs", arguments), expected);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pitwall::recording
