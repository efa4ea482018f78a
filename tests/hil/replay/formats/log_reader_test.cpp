// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/log_reader.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "hil/replay/writers/log_writer.hpp"
#include "tests/hil/replay/formats/log_oracle.hpp"
#include "tests/hil/replay/formats/made_log.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::replay {
namespace {

CanLog read_file(const std::filesystem::path& path) {
  const auto bytes = transport::read_file(path.string());
  EXPECT_TRUE(bytes) << path;
  auto log = read_can_log(bytes.value_or(""), path.filename().string());
  EXPECT_TRUE(log) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
}

// Frames of candump's console by a reading that shares nothing with ours: words between spaces.
void expect_console_frames(const CanLog& ours, const std::filesystem::path& path) {
  std::ifstream in(path);
  std::size_t next = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string channel, id, length, byte;
    if (line.starts_with("#") || !(words >> channel >> id >> length)) continue;
    ASSERT_LT(next, ours.frames.size()) << line;
    const LoggedFrame& f = ours.frames[next++];
    EXPECT_EQ(ours.channels[f.channel], channel);
    EXPECT_EQ(f.frame.id, std::stoul(id, nullptr, 16)) << line;
    EXPECT_EQ(f.frame.extended, id.size() == 8) << line;
    std::size_t n = 0;
    for (; words >> byte; ++n) ASSERT_EQ(f.frame.data[n], std::stoul(byte, nullptr, 16)) << line;
    EXPECT_EQ(f.frame.length, n) << line;
  }
  EXPECT_EQ(next, ours.frames.size());
  EXPECT_GT(next, 300U);
}

TEST(PublicCanLogs, EveryLogReadsAsPythonCanReadsIt) {
  using namespace recordings;
  if (!is_here(kCanLogs)) GTEST_SKIP() << how_to_get(kCanLogs);
  const auto folder = transport::TemporaryFolder::create("pitwall-logs-");
  ASSERT_TRUE(folder);
  std::size_t compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path_of(kCanLogs))) {
    const auto path = entry.path();
    SCOPED_TRACE(path.filename().string());
    const std::string end = path.extension().string();
    if (end == ".txt") {
      expect_console_frames(read_file(path), path);
      continue;
    }
    const std::string format = end == ".log" ? "candump" : end.substr(1);
    const auto theirs = oracle::read(format, path.string(), folder->path());
    const bool has_frames = std::any_of(theirs.begin(), theirs.end(),
                                        [](const oracle::Message& m) { return m.kind != 'X'; });
    if (!has_frames) {  // of arbitrary numbers, made to test a reader of structs
      EXPECT_FALSE(read_can_log(*transport::read_file(path.string()), "x").has_value());
      continue;
    }
    const CanLog ours = read_file(path);
    oracle::expect_same(ours, theirs,
                        {.relative = format == "trc",
                         .direction = format != "candump",
                         .first_channel = format == "trc" ? 1 : 0});
    compared += ours.frames.size();
  }
  EXPECT_GT(compared, 6'000U);
}

TEST(LogReader, TheFormatIsFoundByContentAndToldInTheErrorOfWhatIsNotRead) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"MDF     4.10    ", "ASAM MDF 4"},
      {std::string("PK\3\4"), "ZIP"},
      {"<!DOCTYPE html><html>", "web page"},
      {"\x89MCAP0\r\n", "MCAP"},
      {"\xFF\xFEx\0", "UTF-16"},
      {"", "empty"},
      {"to be or not to be\n", "a text of no known format"},
  };
  for (const auto& [bytes, name] : cases) {
    const auto log = read_can_log(bytes, "x.log");
    ASSERT_FALSE(log.has_value()) << name;
    EXPECT_EQ(log.error().place, "x.log");
    EXPECT_NE(log.error().what.find(name), std::string::npos) << log.error().what;
    EXPECT_NE(log.error().what.find("PEAK TRC"), std::string::npos) << log.error().what;
  }
}

// A log in blocks, and how far it was each time; the frames together again.
struct Blocks {
  CanLog log;
  std::size_t blocks = 0;
  std::vector<std::size_t> reached;
};

Blocks read_in_blocks(const std::string& bytes) {
  Blocks out;
  std::vector<LoggedFrame> frames;
  const LogWatch watch{.reached =
                           [&](std::size_t done, std::size_t all) {
                             EXPECT_LE(done, all);
                             out.reached.push_back(done);
                           },
                       .take =
                           [&](std::span<const LoggedFrame> block) {
                             ++out.blocks;
                             frames.insert(frames.end(), block.begin(), block.end());
                           }};
  auto log = read_can_log(bytes, "f", watch);
  EXPECT_TRUE(log);
  if (!log) return out;
  out.log = *std::move(log);
  frames.insert(frames.end(), out.log.frames.begin(), out.log.frames.end());
  out.log.frames = std::move(frames);
  return out;
}

TEST(LogReader, InBlocksEveryFormatHasTheSameFramesAndSaysHowFarItIs) {
  const CanLog made = make_log({.frames = 3 * kFramesOfBlock + 100, .channels = 1});
  for (const std::string name :
       {"a.log", "a.asc", "a.blf", "a.trc", "a.pcap", "a.pcapng", "a.log.gz"}) {
    const std::string bytes = write_can_log(made, name)->bytes;
    const auto whole = read_can_log(bytes, "f");
    const Blocks read = read_in_blocks(bytes);
    EXPECT_EQ(read.blocks, 3U) << name;
    EXPECT_TRUE(read.log.frames == whole->frames) << name;
    EXPECT_EQ(read.log.counters, whole->counters) << name;
    EXPECT_EQ(read.log.notes, whole->notes) << name;
    ASSERT_FALSE(read.reached.empty()) << name;
    EXPECT_TRUE(std::is_sorted(read.reached.begin(), read.reached.end())) << name;
    const bool is_long = bytes.size() > 2 * kBytesBetweenReports;
    EXPECT_GE(read.reached.size(), is_long ? 2U : 1U) << name;
  }
}

// Only the end says that the stamps of candump -td are gaps: nothing is given away before.
TEST(LogReader, GapsInPlaceOfStampsAreNotTakenInBlocks) {
  std::string text;
  for (std::size_t i = 0; i < kFramesOfBlock + 10; ++i)
    text += i % 2 == 0 ? " (000.000200)  can0  123   [1]  11\n"
                       : " (000.000100)  can0  123   [1]  11\n";
  const Blocks read = read_in_blocks(text);
  EXPECT_EQ(read.blocks, 0U);
  EXPECT_TRUE(read.log.frames == read_can_log(text, "f")->frames);
  EXPECT_EQ(read.log.frames.back().at.ns,
            static_cast<std::int64_t>(kFramesOfBlock + 10) / 2 * 300'000);
}

}  // namespace
}  // namespace pitwall::replay
