// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/segment_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "protocol/recorder/file_disk.hpp"
#include "protocol/recorder/segment_chain.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/transport/file.hpp"
#include "tests/protocol/recorder/recorded_time.hpp"

namespace pitwall::recorder {
namespace {

// A segment of two seconds; `cut`: bytes that its end lacks.
std::string record(const std::string& folder, const std::string& name, std::size_t cut) {
  {
    FileDisk disk{folder};
    ChainParams params;
    params.clock.utc_minus_base = seconds(1'000);
    params.name = name;
    SegmentChain chain{disk, params};
    for (Instant at = kStart; at < kStart + seconds(2); at += kTick) {
      const std::array<std::uint8_t, 2> text{'{', '}'};
      chain.take({.channel = channel_of(Topic::kMark), .logged = at, .published = at, .data = text},
                 at);
      chain.turn(at);
    }
  }
  const std::string path = folder + "/" + name + "_19700101T001820.000Z_00000.mcap";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - cut);
  return path;
}

std::uint64_t messages_of(const std::string& path, recording::McapEnd& end) {
  const auto file = transport::read_file(path);
  recording::McapReader reader{{reinterpret_cast<const std::uint8_t*>(file->data()), file->size()}};
  while (reader.next()) continue;
  end = reader.end();
  return reader.counters().messages;
}

TEST(SegmentFolder, OnlyWhatHasNoEndIsMadeWhole) {
  const auto folder = transport::TemporaryFolder::create("pitwall_segments");
  const std::string whole = record(folder->path(), "b", 0),
                    cut = record(folder->path(), "a", 1'500);
  ASSERT_TRUE(transport::write_file(folder->path() + "/notes.txt", "x"));
  EXPECT_EQ(*segments_of(folder->path()), (std::vector<std::string>{cut, whole}));
  const auto before = *transport::read_file(whole);
  const auto lines = recover_folder(folder->path());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines.front().starts_with(cut + ": 10")) << lines.front();
  recording::McapEnd end{};
  EXPECT_GT(messages_of(cut, end), 50U);
  EXPECT_EQ(end, recording::McapEnd::kComplete);
  EXPECT_EQ(*transport::read_file(whole), before);
  EXPECT_TRUE(recover_folder(folder->path()).empty());
}

TEST(SegmentFolder, AFileWithDamageInItsMiddleIsKeptBesideTheNewOne) {
  const auto folder = transport::TemporaryFolder::create("pitwall_segments");
  const std::string path = record(folder->path(), "a", 0);
  std::string bytes = *transport::read_file(path);
  bytes[bytes.find("{}", bytes.size() / 2)] = 'x';
  ASSERT_TRUE(transport::write_file(path, bytes));
  const auto line = recover_file(path);
  ASSERT_TRUE(line);
  EXPECT_NE(line->find("damaged chunk"), std::string::npos) << *line;
  EXPECT_EQ(*transport::read_file(path + ".damaged"), bytes);
}

TEST(SegmentFolder, AFileThatIsBeingWrittenIsLeftAlone) {
  const auto folder = transport::TemporaryFolder::create("pitwall_segments");
  FileDisk disk{folder->path()};
  ASSERT_FALSE(disk.begin("x.mcap"));
  const auto line = recover_file(folder->path() + "/x.mcap");
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().what, "another process is writing it");
  EXPECT_TRUE(recover_folder(folder->path()).empty());
}

TEST(SegmentFolder, WhatIsNoRecordingIsRefusedWithItsPlace) {
  const auto folder = transport::TemporaryFolder::create("pitwall_segments");
  const std::string path = folder->path() + "/x.mcap";
  ASSERT_TRUE(transport::write_file(path, "hello"));
  EXPECT_EQ(to_string(recover_file(path).error()), path + ": error: not an MCAP file");
  EXPECT_FALSE(recover_file(folder->path() + "/none.mcap"));
  EXPECT_FALSE(segments_of(folder->path() + "/none"));
  EXPECT_EQ(recover_folder(folder->path()).size(), 1U);
}

}  // namespace
}  // namespace pitwall::recorder
