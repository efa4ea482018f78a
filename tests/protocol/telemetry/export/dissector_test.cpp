// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/dissector.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/registry/schema_text.hpp"
#include "protocol/telemetry/session/key_log.hpp"
#include "protocol/telemetry/session/traffic.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

using Packet = std::vector<std::uint8_t>;
constexpr Instant kNow{seconds(1'000).ns};
constexpr std::uint16_t kCarPort = 40'000;

bool have_tshark() {
  return std::system("command -v tshark >/dev/null 2>&1") == 0;  // NOLINT: a test
}
#define NEEDS_TSHARK() ASSERT_TRUE(have_tshark()) << "tshark is not installed (./pitwall setup)"

// ---- Packets, sealed by the session itself

Snapshot sample_state(std::uint64_t seed) {
  std::mt19937_64 random{seed};
  Snapshot snapshot;
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    if (random() % 6 == 0) continue;
    snapshot.values[i] = kFields[i].quantized().decode(random() % kFields[i].quantized().count());
  }
  for (const GroupRow& row : kGroupTable)
    snapshot.at(row.group) = kNow - milliseconds(static_cast<std::int64_t>(random() % 300));
  return snapshot;
}

Packet signed_packet(std::span<const std::uint8_t> body, Kind kind = Kind::kSigned) {
  Sealer sealer{Key{}, 77, kNow};
  Packet packet(kHeaderSize + body.size() + kTagSize);
  sealer.seal(kind, 0x1234, body, kNow, packet);
  return packet;
}

struct Written {
  std::array<std::uint8_t, kMaxBody> buffer{};
  std::span<const std::uint8_t> bytes;
};

void write(const Snapshot& snapshot, Direction direction, Written& out) {
  BodyWriter writer{out.buffer, out.buffer.size(), direction};
  writer.begin(kNow, 2);
  writer.add_ack({.newest_low = 513, .mask = 0x80000001, .hold = milliseconds(7)});
  std::vector<Group> groups;
  for (const GroupRow& row : kGroupTable)
    if (row.direction == direction) groups.push_back(row.group);
  CodecCounters counters;
  writer.add_groups(snapshot, groups, kNow, counters);
  writer.add_record(RecordType::kCommandResultAck, std::array<std::uint8_t, 3>{1, 2, 3});
  writer.add_record(RecordType::kBulk, std::vector<std::uint8_t>(300, 9));
  out.bytes = writer.bytes();
}

// ---- A capture file of IPv4 (libpcap 2.4, LINKTYPE_RAW) and what tshark says of it

void put(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}
void put_big(std::string& out, std::uint64_t value, int bytes) {
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i));
}

std::string frame_of(const Packet& packet, Direction direction) {
  const bool down = direction == Direction::kDown;
  std::string ip;
  put_big(ip, 0x4500, 2), put_big(ip, packet.size() + 28, 2), put_big(ip, 0x00000000, 4);
  put_big(ip, 0x4011, 2), put_big(ip, 0, 2);
  put_big(ip, 0x0A000001, 4), put_big(ip, 0x0A000002, 4);
  put_big(ip, down ? kCarPort : kDissectorPort, 2);
  put_big(ip, down ? kDissectorPort : kCarPort, 2);
  put_big(ip, packet.size() + 8, 2), put_big(ip, 0, 2);
  return ip + std::string(packet.begin(), packet.end());
}

struct Sent {
  Packet packet;
  Direction direction;
};

std::string capture_of(const std::vector<Sent>& packets) {
  std::string out;
  put(out, 0xA1B2C3D4, 4), put(out, 2, 2), put(out, 4, 2), put(out, 0, 8), put(out, 65'535, 4);
  put(out, 101, 4);
  for (const Sent& sent : packets) {
    const std::string frame = frame_of(sent.packet, sent.direction);
    put(out, 0, 8), put(out, frame.size(), 4), put(out, frame.size(), 4);
    out += frame;
  }
  return out;
}

std::string tshark(const std::vector<Sent>& packets, const std::string& arguments,
                   const std::string& key_log = {}) {
  std::string folder = (std::filesystem::path{testing::TempDir()} / "dissectorXXXXXX").string();
  EXPECT_NE(mkdtemp(folder.data()), nullptr);
  std::ofstream{folder + "/pitwall.lua"} << dissector_lua();
  std::ofstream{folder + "/radio.pcap", std::ios::binary} << capture_of(packets);
  std::ofstream{folder + "/keys.log"} << key_log;
  const std::string command = "HOME=" + folder + " tshark -o pitwall.key_log:" + folder +
                              "/keys.log -X lua_script:" + folder + "/pitwall.lua -r " + folder +
                              "/radio.pcap " + arguments + " 2>&1";
  FILE* const pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4'096> piece{};
  for (std::size_t got; (got = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;)
    text.append(piece.data(), got);
  EXPECT_EQ(pclose(pipe), 0) << command << "\n" << text.substr(0, 2'000);
  std::filesystem::remove_all(folder);
  EXPECT_EQ(text.find("Lua Error"), std::string::npos) << text.substr(0, 2'000);
  return text;
}

// One row of cells for each packet, without what tshark says about itself.
std::vector<std::vector<std::string>> fields_of_packets(const std::vector<Sent>& packets,
                                                        const std::vector<std::string>& names,
                                                        const std::string& key_log = {}) {
  std::string arguments = "-T fields -E separator='|'";
  for (const std::string& name : names) arguments += " -e " + name;
  std::istringstream in{tshark(packets, arguments, key_log)};
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.find('|') == std::string::npos) continue;
    rows.emplace_back();
    std::istringstream cells{line + "|"};
    for (std::string cell; std::getline(cells, cell, '|');) rows.back().push_back(cell);
  }
  return rows;
}

std::string path_of(FieldIndex i) {
  return "pitwall." + std::string{row_of(kFields[i].group).name} + "." +
         std::string{kFields[i].name};
}

// ---- Tests

class EachDirection : public testing::TestWithParam<Direction> {};

TEST_P(EachDirection, EveryFieldOfASignedPacketIsShownAsItWasRead) {
  NEEDS_TSHARK();
  std::vector<FieldIndex> fields;
  std::vector<std::string> names;
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    if (row_of(kFields[i].group).direction != GetParam()) continue;
    fields.push_back(i);
    names.push_back(path_of(i));
  }
  std::vector<Sent> packets;
  std::vector<Body> bodies;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Written written;
    write(sample_state(seed), GetParam(), written);
    packets.push_back({signed_packet(written.bytes), GetParam()});
    const auto body = parse_body(written.bytes, GetParam());
    ASSERT_TRUE(body.has_value());
    bodies.push_back(*body);
  }
  const auto rows = fields_of_packets(packets, names);
  ASSERT_EQ(rows.size(), packets.size());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    ASSERT_EQ(rows[p].size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      const double expected = bodies[p].values[fields[k]];
      ASSERT_EQ(rows[p][k].empty(), std::isnan(expected)) << names[k];
      if (rows[p][k].empty()) continue;
      EXPECT_NEAR(std::stod(rows[p][k]), expected, kFields[fields[k]].resolution / 100) << names[k];
    }
  }
}

TEST_P(EachDirection, HeadAcknowledgementAgesAndRecordsAreShown) {
  NEEDS_TSHARK();
  Written written;
  write(sample_state(9), GetParam(), written);
  const auto rows = fields_of_packets(
      {{signed_packet(written.bytes), GetParam()}},
      {"pitwall.version", "pitwall.kind", "pitwall.key_phase", "pitwall.receiver",
       "pitwall.sequence", "pitwall.tx_time", "pitwall.paths", "pitwall.ack.newest",
       "pitwall.ack.mask", "pitwall.ack.hold", "pitwall.record", "_ws.col.Protocol"});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"3", "4", "0", "0x1234", "77", "1000", "0x02", "513",
                                               "0x80000001", "7", "3,6", "PITWALL"}));
}

TEST_P(EachDirection, TheAgeOfEveryGroupIsShown) {
  NEEDS_TSHARK();
  Written written;
  write(sample_state(9), GetParam(), written);
  const auto body = parse_body(written.bytes, GetParam());
  ASSERT_TRUE(body.has_value());
  std::vector<std::string> names;
  std::vector<double> ages_ms;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != GetParam()) continue;
    names.push_back("pitwall.age." + std::string{row.name});
    ages_ms.push_back(age_of_code(body->age_codes[index_of(row.group)]).milliseconds());
  }
  const auto rows = fields_of_packets({{signed_packet(written.bytes), GetParam()}}, names);
  ASSERT_EQ(rows.size(), 1U);
  ASSERT_EQ(rows[0].size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(std::stod(rows[0][i]), ages_ms[i]) << names[i];
}

INSTANTIATE_TEST_SUITE_P(Both, EachDirection, testing::Values(Direction::kDown, Direction::kUp));

TEST(Dissector, ALabelIsShownBesideItsNumber) {
  NEEDS_TSHARK();
  Snapshot snapshot;
  snapshot.values[field("mode.mode")] = 2;
  snapshot.at(Group::kMode) = kNow;
  Written written;
  write(snapshot, Direction::kDown, written);
  const std::string text =
      tshark({{signed_packet(written.bytes), Direction::kDown}}, "-V -O pitwall");
  EXPECT_NE(text.find("mode: 2 (driving)"), std::string::npos) << text;
  EXPECT_NE(text.find("ct_state: unset"), std::string::npos);
  EXPECT_NE(text.find("Record: command result ack (3)"), std::string::npos);
}

TEST(Dissector, OfASealedPacketOnlyTheClearPartIsShown) {
  NEEDS_TSHARK();
  Written written;
  write(sample_state(3), Direction::kDown, written);
  const auto rows =
      fields_of_packets({{signed_packet(written.bytes, Kind::kSealed), Direction::kDown}},
                        {"pitwall.kind", "pitwall.sequence", "pitwall.sealed", "pitwall.ego.x"});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0][0], "3");
  EXPECT_EQ(rows[0][1], "77");
  EXPECT_EQ(rows[0][2].size(), 2 * written.bytes.size());
  EXPECT_EQ(rows[0][3], "");
}

// Bodies of every length modulo a block of either cipher, in two phases of the key.
TEST(Dissector, AKeyLogOpensWhatItsKeysHaveSealedAndNothingElse) {
  NEEDS_TSHARK();
  constexpr std::uint16_t kReceiver = 0x1234;
  Key key;
  for (std::size_t i = 0; i < key.bytes.size(); ++i) {
    key.bytes[i] = static_cast<std::uint8_t>(0xFF - 37 * i);
  }
  Sealer sealer{key, 77, kNow, {.packets = 100}};
  std::vector<Sent> packets;
  std::vector<std::size_t> lengths;
  for (std::size_t extra = 0; extra < 150; ++extra) {
    std::array<std::uint8_t, kMaxBody> buffer{};
    BodyWriter writer{buffer, buffer.size(), Direction::kDown};
    writer.begin(kNow, 1);
    writer.add_record(RecordType::kBulk, std::vector<std::uint8_t>(extra, 0xA5));
    Packet packet(kHeaderSize + writer.bytes().size() + kTagSize);
    sealer.seal(Kind::kSealed, kReceiver, writer.bytes(), kNow, packet);
    packets.push_back({packet, Direction::kDown});
  }
  packets.push_back(packets.front());
  packets.back().packet.back() ^= 1;  // its tag
  packets.push_back(packets.front());
  packets.back().packet[kHeaderSize] ^= 1;
  const std::vector<std::string> names{"pitwall.kind", "pitwall.record", "pitwall.record.payload",
                                       "pitwall.sealed"};
  const auto rows = fields_of_packets(packets, names, "no key\n" + key_log_lines(kReceiver, key));
  ASSERT_EQ(rows.size(), packets.size());
  for (std::size_t extra = 0; extra < 150; ++extra) {
    std::string payload;
    for (std::size_t i = 0; i < extra; ++i) payload += "a5";
    EXPECT_EQ(rows[extra], (std::vector<std::string>{"3", "6", payload, ""})) << extra;
  }
  for (std::size_t forged = 150; forged < rows.size(); ++forged) {
    EXPECT_EQ(rows[forged][1], "");
    EXPECT_NE(rows[forged][3], "");
  }
  const auto stranger = fields_of_packets(packets, names, key_log_lines(kReceiver, Key{}));
  for (const auto& row : stranger) EXPECT_EQ(row[1], "");
}

// Cut, changed and foreign packets: a mark where something is wrong, and never an error of Lua.
TEST(Dissector, WhateverIsOnThePortDoesNotBreakIt) {
  NEEDS_TSHARK();
  std::mt19937 random{5};
  std::vector<Sent> packets;
  Written written;
  write(sample_state(4), Direction::kDown, written);
  const Packet good = signed_packet(written.bytes);
  for (int round = 0; round < 400; ++round) {
    Packet packet = good;
    for (int k = 0; k < round % 5; ++k) {
      std::uint8_t& byte = packet[random() % packet.size()];
      byte = static_cast<std::uint8_t>(byte ^ 1U << random() % 8);
    }
    if (round % 3 == 0) packet.resize(random() % packet.size());
    if (round % 7 == 0) std::generate(packet.begin(), packet.end(), random);
    packets.push_back({packet, round % 2 == 0 ? Direction::kDown : Direction::kUp});
  }
  packets.push_back({Packet{}, Direction::kDown});
  const std::string text = tshark(packets, "-V -O pitwall");
  EXPECT_NE(text.find("Ends before its time"), std::string::npos);
  EXPECT_NE(text.find("a pattern that no value makes"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::telemetry
