// Files of our own writer are read by tshark in writers/pcap_writer_test.cpp; here a file of
// Wireshark's own editcap is read by us.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/pcapng.hpp"

#include <gtest/gtest.h>

#include "hil/replay/writers/byte_text.hpp"
#include "hil/replay/writers/pcap_writer.hpp"
#include "tests/hil/replay/formats/made_log.hpp"
#include "tests/hil/replay/formats/tshark_oracle.hpp"

namespace pitwall::replay {
namespace {

using namespace std::string_literals;

CanLog parse_pcapng(const std::string& bytes) {
  auto log = read_pcapng(bytes, "f.pcapng");
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
}

std::string block(std::uint32_t type, const std::string& body) {
  std::string out;
  append_little(out, type);
  append_little(out, static_cast<std::uint32_t>(body.size() + 12));
  out += body;
  append_little(out, static_cast<std::uint32_t>(body.size() + 12));
  return out;
}

const std::string kSection =
    block(0x0A0D0D0A, "\x4D\x3C\x2B\x1A\1\0\0\0\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s);
const std::string kFrame = "\x00\x00\x01\x23\x02\0\0\0\xAA\xBB\0\0\0\0\0\0"s;

std::string described(std::uint16_t link_type, const std::string& options) {
  std::string body;
  append_little(body, link_type);
  append_little(body, std::uint16_t{0});
  append_little(body, std::uint32_t{0});
  return block(1, body + options);
}

std::string packet(std::uint32_t interface, std::uint64_t ticks, std::uint32_t type = 6) {
  std::string body;
  append_little(body, interface);
  append_little(body, static_cast<std::uint32_t>(ticks >> 32));
  append_little(body, static_cast<std::uint32_t>(ticks));
  append_little(body, std::uint32_t{16});
  append_little(body, std::uint32_t{16});
  return block(type, body + kFrame);
}

TEST(Pcapng, ResolutionsOffsetsAndNamesOfInterfacesAreFollowed) {
  const auto log = parse_pcapng(
      kSection + described(227, "") + described(227, "\2\0\5\0vcan7\0\0\0\x09\0\1\0\x09\0\0\0"s) +
      described(227, "\x09\0\1\0\x8A\0\0\0\x0E\0\x08\0\x64\0\0\0\0\0\0\0"s) + described(1, "") +
      block(5, "statistics..") + packet(0, 1'500'000) + packet(1, 1'500'000'000) +
      packet(2, 1'536) + packet(3, 0) + packet(0, 1, 2) + block(3, "\x10\0\0\0"s + kFrame) +
      packet(9, 0));
  ASSERT_EQ(log.frames.size(), 5U) << to_text(log, "f");
  EXPECT_EQ(log.channels, (std::vector<std::string>{"can0", "vcan7", "can2"}));
  EXPECT_EQ(log.frames[0].at.ns, 1'500'000'000);
  EXPECT_EQ(log.frames[1].at.ns, 1'500'000'000);
  EXPECT_EQ(log.frames[2].at.ns, 101'500'000'000);
  EXPECT_EQ(log.frames[3].at.ns, 1'000);
  EXPECT_EQ(log.frames[4].at.ns, 1'000) << "without a stamp: that of the one before";
  EXPECT_EQ(log.counters.other_records, 2U);
  EXPECT_EQ(log.counters.bad_records, 1U) << "an interface that is not described";
}

TEST(Pcapng, APacketWhoseOffsetLeavesTheRangeOfTimeIsLeftOut) {
  const auto log_of = [](std::int64_t offset_s) {
    std::string option = "\x0E\0\x08\0"s;
    append_little(option, static_cast<std::uint64_t>(offset_s));
    return parse_pcapng(kSection + described(227, "") + described(227, option) +
                        packet(0, 1'000'000) + packet(1, 2'500'000));
  };
  for (const std::int64_t offset_s :
       {std::int64_t{-2}, std::int64_t{0}, std::int64_t{8'000'000'000}}) {
    const auto log = log_of(offset_s);
    ASSERT_EQ(log.frames.size(), 2U) << offset_s;
    EXPECT_EQ(log.frames[1].at.ns, (2 + offset_s) * 1'000'000'000 + 500'000'000);
  }
  for (const std::int64_t offset_s : {INT64_MIN, std::int64_t{-3}, INT64_MAX - 1, INT64_MAX}) {
    const auto log = log_of(offset_s);
    EXPECT_EQ(log.frames.size(), 1U) << offset_s;
    EXPECT_EQ(log.counters.bad_records, 1U) << offset_s;
  }
}

TEST(Pcapng, AFileOfEditcapIsReadAsTsharkReadsIt) {
  const auto folder = transport::TemporaryFolder::create("pitwall-pcapng-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.channels = 1});
  const std::string in = folder->path() + "/a.pcap", out = folder->path() + "/a.pcapng";
  ASSERT_TRUE(transport::write_file(in, to_pcap(log)));
  const std::string command =
      "HOME='" + folder->path() + "' editcap -F pcapng '" + in + "' '" + out + "' 2> /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT: a test
  const CanLog read = parse_pcapng(*transport::read_file(out));
  EXPECT_EQ(read.frames.size(), log.frames.size());
  oracle::expect_as_tshark(read, out, folder->path());
}

TEST(Pcapng, ADamagedBlockIsLeftOutAndTheNextOnesAreRead) {
  const std::string bytes =
      kSection + described(227, "") + packet(0, 1) + packet(0, 2) + packet(0, 3);
  const std::size_t second = bytes.size() - 2 * packet(0, 1).size();
  for (std::size_t i = 4; i < 8; ++i) {  // its length
    std::string damaged = bytes;
    damaged[second + i] ^= 0x41;
    const auto log = parse_pcapng(damaged);
    EXPECT_EQ(log.frames.size(), 2U) << i;
    ASSERT_EQ(log.remarks.size(), 1U) << i;
    EXPECT_EQ(log.remarks[0].place, "f.pcapng: byte " + std::to_string(second));
  }
  const auto cut = parse_pcapng(bytes.substr(0, bytes.size() - 1));
  EXPECT_EQ(cut.frames.size(), 2U);
  EXPECT_EQ(cut.counters.cut_tails, 1U);
}

}  // namespace
}  // namespace pitwall::replay
