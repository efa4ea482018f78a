// Files of our own writer are read by tshark in writers/pcap_writer_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/pcap.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hil/replay/writers/pcap_writer.hpp"
#include "tests/hil/replay/formats/made_log.hpp"
#include "tests/hil/replay/formats/tshark_oracle.hpp"

namespace pitwall::replay {
namespace {

CanLog parse_pcap(const std::string& bytes) {
  auto log = read_pcap(bytes, "f.pcap");
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
}

constexpr std::size_t kHeader = 24, kRecord = 16;

// The same capture as a machine of the other byte order would have written it.
std::string swapped(std::string bytes) {
  const auto turn = [&](std::size_t at, std::size_t width) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + width));
  };
  for (const std::size_t at : {0U, 8U, 12U, 16U, 20U}) turn(at, 4);
  turn(4, 2);
  turn(6, 2);
  for (std::size_t at = kHeader; at < bytes.size();) {
    const std::size_t length = static_cast<unsigned char>(bytes[at + 8]);
    for (std::size_t i = 0; i < 4; ++i) turn(at + 4 * i, 4);
    at += kRecord + length;
  }
  return bytes;
}

TEST(Pcap, BothByteOrdersAndBothResolutionsAreRead) {
  for (const std::int64_t step_ns : {1'000, 1}) {
    CanLog log = make_log({.channels = 1, .step_ns = step_ns});
    for (LoggedFrame& logged : log.frames) logged.direction = LoggedDirection::kUnknown;
    EXPECT_EQ(parse_pcap(to_pcap(log)).frames, log.frames);
    EXPECT_EQ(parse_pcap(swapped(to_pcap(log))).frames, log.frames);
  }
}

TEST(Pcap, ErrorFramesAreCounted) {
  std::string bytes = to_pcap(make_log({.frames = 3, .channels = 1, .fd = false}));
  bytes[kHeader + kRecord] = 0x20;
  const auto log = parse_pcap(bytes);
  EXPECT_EQ(log.counters.error_frames, 1U);
  EXPECT_EQ(log.frames.size(), 2U);
}

TEST(Pcap, ADamagedRecordIsLeftOutAndTheNextOnesAreRead) {
  const CanLog made = make_log({.frames = 50, .channels = 1, .fd = false});
  const std::string bytes = to_pcap(made);
  constexpr std::size_t kWhole = 32;
  std::string damaged = bytes;
  damaged[kHeader + 10 * kWhole + 8] = 0x55;  // the length of the eleventh record
  auto log = parse_pcap(damaged);
  EXPECT_EQ(log.frames.size(), 49U);
  EXPECT_EQ(log.counters.bad_records, 1U);
  damaged = bytes;
  damaged.erase(kHeader + 10 * kWhole + 3, 1);
  log = parse_pcap(damaged);
  EXPECT_EQ(log.frames.size(), 49U);
  ASSERT_EQ(log.remarks.size(), 1U);
  EXPECT_EQ(log.remarks[0].place, "f.pcap: byte " + std::to_string(kHeader + 10 * kWhole));
}

TEST(Pcap, ACutRecordIsToldAndNotSent) {
  const std::string bytes = to_pcap(make_log({.frames = 5, .channels = 1, .fd = false}));
  for (std::size_t cut = 1; cut < 32; ++cut) {
    const auto log = parse_pcap(bytes.substr(0, bytes.size() - cut));
    EXPECT_EQ(log.frames.size(), 4U) << cut;
    EXPECT_EQ(log.counters.cut_tails, 1U) << cut;
  }
}

TEST(Pcap, OtherLinkTypesAndVersionsAreRefused) {
  std::string bytes = to_pcap(make_log({.frames = 1}));
  bytes[20] = 1;
  const auto other = read_pcap(bytes, "f");
  ASSERT_FALSE(other.has_value());
  EXPECT_NE(other.error().what.find("link type 1"), std::string::npos);
  bytes[4] = 3;
  EXPECT_FALSE(read_pcap(bytes, "f").has_value());
  EXPECT_FALSE(read_pcap(bytes.substr(0, 20), "f").has_value());
}

}  // namespace
}  // namespace pitwall::replay
