// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/socketcan_packet.hpp"

#include <gtest/gtest.h>

#include "hil/replay/formats/pcap.hpp"
#include "hil/replay/writers/byte_text.hpp"
#include "tests/hil/replay/formats/tshark_oracle.hpp"

namespace pitwall::replay {
namespace {

using namespace std::string_literals;

const std::string kClassic = "\x00\x00\x01\x23\x02\0\0\0\xAA\xBB\0\0\0\0\0\0"s;

TEST(SocketCanPacket, FramesOfBothProtocolsAreRead) {
  auto packet = read_socketcan_packet(kLinkTypeCan, kClassic, false);
  ASSERT_EQ(packet.kind, PacketKind::kFrame);
  EXPECT_EQ(packet.logged.frame.id, 0x123U);
  EXPECT_EQ(packet.logged.frame.length, 2);
  EXPECT_EQ(packet.logged.frame.data[1], 0xBB);
  packet = read_socketcan_packet(kLinkTypeCan, kClassic.substr(0, 10), false);
  EXPECT_EQ(packet.kind, PacketKind::kFrame) << "only the bytes in use";
  packet = read_socketcan_packet(kLinkTypeCan, kClassic + std::string(56, '\0'), false);
  EXPECT_TRUE(packet.logged.frame.fd) << "the kernel's struct of CAN FD";
  std::string fd = "\x80\x00\x01\x23\x0C\x05\0\0"s + std::string(12, 'x');
  packet = read_socketcan_packet(kLinkTypeCan, fd, false);
  EXPECT_TRUE(packet.logged.frame.fd && packet.logged.frame.extended);
  EXPECT_EQ(packet.logged.fd_flags, kFdBitRateSwitch);
}

TEST(SocketCanPacket, WhatIsNoFrameHasAReason) {
  const auto why = [](std::string packet) {
    const auto read = read_socketcan_packet(kLinkTypeCan, packet, false);
    return read.kind == PacketKind::kBad ? std::string(read.why) : "";
  };
  EXPECT_NE(why(kClassic.substr(0, 7)), "");
  EXPECT_NE(why(kClassic + "x"), "");
  EXPECT_NE(why("\x00\x00\x01\x23\x82\0\0\0"s), "");
  EXPECT_NE(why("\x00\x00\x01\x23\x03\0\0\0xx"s), "");
  EXPECT_EQ(read_socketcan_packet(kLinkTypeCan, "\x20\0\0\4\x08\0\0\0xxxxxxxx"s, false).kind,
            PacketKind::kErrorFrame);
}

// As tshark has it, too: identifiers in the byte order of the host that recorded.
TEST(SocketCanPacket, CookedPacketsCarryDirectionAndInterface) {
  const auto folder = transport::TemporaryFolder::create("pitwall-cooked-");
  ASSERT_TRUE(folder);
  const std::string frame = "\x23\x01\0\x80\x02\0\0\0\xAA\xBB\0\0\0\0\0\0"s;
  const std::string fd = "\x24\x01\0\0\x02\x01\0\0\xAA\xBB"s + std::string(62, '\0');
  const std::string sll = "\0\4\1\x18\0\0\0\0\0\0\0\0\0\0\0"s;
  const std::string sll2_end = "\0\0\0\0\0\7\1\x18\0\0\0\0\0\0\0\0\0\0"s;
  for (const std::uint32_t link_type : {kLinkTypeSll, kLinkTypeSll2}) {
    std::string file;
    for (const std::uint32_t word : {0xA1B2C3D4U, 0x00040002U, 0U, 0U, 262'144U, link_type})
      append_little(file, word);
    for (const std::string& packet : {frame, fd}) {
      const char protocol = packet.size() == 16 ? '\x0C' : '\x0D';
      const std::string whole = link_type == kLinkTypeSll ? sll + protocol + packet
                                                          : "\0"s + protocol + sll2_end + packet;
      for (const std::size_t word :
           {std::size_t{1'700'000'000}, std::size_t{5}, whole.size(), whole.size()})
        append_little(file, static_cast<std::uint32_t>(word));
      file += whole;
    }
    const std::string path = folder->path() + "/a.pcap";
    ASSERT_TRUE(transport::write_file(path, file));
    const auto log = read_pcap(file, "a.pcap");
    ASSERT_TRUE(log && log->frames.size() == 2) << link_type;
    EXPECT_TRUE(log->frames[0].frame.extended);
    EXPECT_EQ(log->frames[0].frame.id, 0x123U);
    EXPECT_TRUE(log->frames[1].frame.fd);
    EXPECT_EQ(log->frames[0].direction, link_type == kLinkTypeSll ? LoggedDirection::kTransmitted
                                                                  : LoggedDirection::kReceived);
    EXPECT_EQ(log->channels.at(0), link_type == kLinkTypeSll ? "can0" : "if7");
    const auto rows = oracle::tshark_rows(path, folder->path());
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0][1], "291");
    EXPECT_EQ(rows[0][2], "1");
    EXPECT_EQ(rows[1][1], "292");
  }
}

}  // namespace
}  // namespace pitwall::replay
