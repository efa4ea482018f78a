// Files of our own writer are read by others in writers/blf_writer_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/blf.hpp"

#include <gtest/gtest.h>

#include "hil/replay/writers/blf_writer.hpp"
#include "hil/replay/writers/byte_text.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "tests/hil/replay/formats/log_oracle.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

CanLog parse_blf(const std::string& bytes) {
  auto log = read_blf(bytes, "f.blf");
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
}

std::string object(std::uint32_t type, const std::string& body, std::int64_t stamp,
                   std::uint32_t unit = 2, std::uint16_t version = 1) {
  const std::uint16_t header = version == 1 ? 32 : 40;
  std::string out = "LOBJ";
  append_little(out, header);
  append_little(out, version);
  append_little(out, static_cast<std::uint32_t>(header + body.size()));
  append_little(out, type);
  append_little(out, unit);
  append_little(out, std::uint32_t{0});
  append_little(out, static_cast<std::uint64_t>(stamp));
  if (version == 2) out.append(8, '\0');
  return out + body + std::string(body.size() % 4, '\0');
}

std::string classic(std::uint32_t id, std::uint8_t length) {
  std::string out;
  append_little(out, std::uint16_t{1});
  out += '\0';
  out += static_cast<char>(length);
  append_little(out, id);
  return out + std::string("\1\2\3\4\5\6\7\10", 8);
}

std::string fd_64(std::uint32_t id, std::uint8_t code, const std::string& data) {
  std::string out{"\2", 1};
  out += static_cast<char>(code);
  out += static_cast<char>(data.size());
  out += '\0';
  append_little(out, id);
  append_little(out, std::uint32_t{0});
  append_little(out, std::uint32_t{0x3000});  // EDL, BRS
  out.append(18, '\0');
  out += '\1';  // sent
  out.append(5, '\0');
  return out + data;
}

// Header and objects at the top level; 2023-11-14 22:13:20.
std::string file_of(const std::string& objects) {
  std::string out = "LOGG";
  append_little(out, std::uint32_t{144});
  out.append(32, '\0');
  for (const unsigned field : {2023U, 11U, 2U, 14U, 22U, 13U, 20U, 0U})
    append_little(out, static_cast<std::uint16_t>(field));
  out.resize(144, '\0');
  return out + objects;
}
constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

TEST(Blf, FilesOfPythonCanAreReadBack) {
  const auto folder = transport::TemporaryFolder::create("pitwall-blf-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.frames = 5'000});
  const std::string path = folder->path() + "/a.blf";
  oracle::write("blf", path, log, folder->path(), 7);
  const CanLog read = parse_blf(*transport::read_file(path));
  EXPECT_TRUE(read.remarks.empty()) << to_text(read, "a.blf");
  EXPECT_EQ(read.counters.error_frames, 7U);
  ASSERT_EQ(read.frames.size(), log.frames.size());
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    LoggedFrame wanted = log.frames[i];
    wanted.at = read.frames[i].at;
    ASSERT_EQ(read.frames[i], wanted) << i;
    // python-can rounds the start to a millisecond and not the stamps from it.
    const std::int64_t ours_ns = read.frames[i].at.ns - read.frames[0].at.ns;
    ASSERT_LE(std::abs(ours_ns - (log.frames[i].at.ns - log.frames[0].at.ns)), 1'000) << i;
  }
}

TEST(Blf, EveryKindOfObjectAndHeaderIsRead) {
  const auto log = parse_blf(
      file_of(object(1, classic(0x123, 3), 1'000) + object(86, classic(0x80000124, 15), 5, 1) +
              object(101, fd_64(0x125, 9, "abcdefghijkl"), 7'000, 2, 2) + object(73, "xxxx", 0) +
              object(2, "xxxx", 0) + object(104, "xxxx", 0) + object(115, "xxx", 0) +
              object(1, classic(0x126, 0), -2'000'000'000)));
  ASSERT_EQ(log.frames.size(), 4U) << to_text(log, "f");
  EXPECT_TRUE(log.remarks.empty()) << to_text(log, "f");
  const auto& f = log.frames;
  EXPECT_EQ(f[0].at.ns, kStart_ns + 1'000);
  EXPECT_EQ(f[0].frame.length, 3);
  EXPECT_EQ(f[0].direction, LoggedDirection::kReceived);
  EXPECT_EQ(f[1].at.ns, kStart_ns + 50'000);
  EXPECT_TRUE(f[1].frame.extended);
  EXPECT_EQ(f[1].frame.length, 8);  // a raw length code
  EXPECT_TRUE(f[2].frame.fd);
  EXPECT_EQ(f[2].frame.length, 12);
  EXPECT_EQ(f[2].frame.data[11], 'l');
  EXPECT_EQ(f[2].fd_flags, kFdBitRateSwitch);
  EXPECT_EQ(f[2].direction, LoggedDirection::kTransmitted);
  EXPECT_EQ(log.channels[f[2].channel], "can1");
  EXPECT_EQ(f[3].at.ns, kStart_ns - 2'000'000'000);  // before the trigger
  EXPECT_EQ(log.counters.error_frames, 3U);
  EXPECT_EQ(log.counters.other_records, 1U);
}

TEST(Blf, WhatDoesNotReadIsLeftOutWithItsByte) {
  const std::string good = object(1, classic(1, 0), 0);
  const std::string bad = object(1, classic(0x800, 0), 0);
  const auto log = parse_blf(file_of(good + bad + "garbage!" + good));
  EXPECT_EQ(log.frames.size(), 2U);
  ASSERT_EQ(log.remarks.size(), 2U);
  EXPECT_EQ(log.remarks[0].place, "f.blf: byte " + std::to_string(144 + good.size()));
  EXPECT_EQ(log.remarks[1].place, "f.blf: byte " + std::to_string(144 + good.size() + bad.size()));
  EXPECT_FALSE(read_blf("LOGG", "f").has_value());
  EXPECT_FALSE(read_blf(file_of(bad), "f").has_value());
}

TEST(Blf, ACutContainerGivesWhatWasWholeAndADamagedOneIsLost) {
  const CanLog log = make_log({.frames = 6'000});
  const std::string bytes = *to_blf(log, channel_numbers_of(log));
  const auto cut = parse_blf(bytes.substr(0, bytes.size() - 1'000));
  EXPECT_GT(cut.frames.size(), 5'000U);
  EXPECT_LT(cut.frames.size(), 6'000U);
  EXPECT_GE(cut.counters.cut_tails, 1U);
  for (std::size_t i = 0; i < cut.frames.size(); ++i) ASSERT_EQ(cut.frames[i], log.frames[i]);
  std::string flipped = bytes;
  flipped[144 + 5'000] ^= 0x10;
  const auto damaged = parse_blf(flipped);
  EXPECT_LT(damaged.frames.size(), 6'000U);
  EXPECT_GT(damaged.frames.size(), 1'000U);  // of the containers behind it
  EXPECT_EQ(damaged.counters.bad_records, 1U) << to_text(damaged, "f").substr(0, 500);
  EXPECT_EQ(damaged.frames.back().at, log.frames.back().at);
  EXPECT_EQ(damaged.frames.back().frame, log.frames.back().frame);
}

}  // namespace
}  // namespace pitwall::replay
