// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/pcap_writer.hpp"

#include <algorithm>

#include "hil/replay/formats/pcap.hpp"
#include "hil/replay/formats/socketcan_packet.hpp"
#include "hil/replay/writers/byte_text.hpp"

namespace pitwall::replay {
namespace {

constexpr std::uint32_t kMicroseconds = 0xA1B2C3D4, kNanoseconds = 0xA1B23C4D;
constexpr std::size_t kClassicStruct = 16, kFdStruct = 72;
constexpr std::uint8_t kFdMark = 0x04;  // CANFD_FDF

std::string packet_of(const LoggedFrame& logged) {
  const can::Frame& f = logged.frame;
  std::string out;
  append_big(out, f.id | (f.extended ? 0x80000000U : 0U) | (f.remote ? 0x40000000U : 0U));
  out += static_cast<char>(f.length);
  out += static_cast<char>(f.fd ? logged.fd_flags | kFdMark : 0);
  out.append(2, '\0');
  if (!f.remote) out.append(f.data.begin(), f.data.begin() + f.length);
  pad_to(out, f.fd ? kFdStruct : kClassicStruct);
  return out;
}

void append_option(std::string& out, std::uint16_t code, std::string_view value) {
  append_little(out, code);
  append_little(out, static_cast<std::uint16_t>(value.size()));
  out += value;
  out.append((4 - value.size() % 4) % 4, '\0');
}

void append_block(std::string& out, std::uint32_t type, std::string_view body) {
  constexpr std::size_t kFrame = 12;
  const auto length = static_cast<std::uint32_t>(body.size() + kFrame);
  append_little(out, type);
  append_little(out, length);
  out += body;
  append_little(out, length);
}

std::string section_body() {
  std::string out;
  append_little(out, std::uint32_t{0x1A2B3C4D});
  append_little(out, std::uint16_t{1});
  append_little(out, std::uint16_t{0});
  append_little(out, UINT64_MAX);  // the length of the section is not said
  return out;
}

std::string interface_body(const std::string& name) {
  constexpr std::uint16_t kName = 2, kResolution = 9;
  std::string out;
  append_little(out, static_cast<std::uint16_t>(kLinkTypeCan));
  append_little(out, std::uint16_t{0});
  append_little(out, std::uint32_t{kMaxPacketBytes});
  append_option(out, kName, name);
  append_option(out, kResolution, "\x09");
  append_option(out, 0, "");
  return out;
}

std::string packet_body(const LoggedFrame& logged) {
  constexpr std::uint16_t kFlags = 2;
  const std::string packet = packet_of(logged);
  const auto stamp = static_cast<std::uint64_t>(logged.at.ns);
  std::string out;
  append_little(out, std::uint32_t{logged.channel});
  append_little(out, static_cast<std::uint32_t>(stamp >> 32U));
  append_little(out, static_cast<std::uint32_t>(stamp));
  append_little(out, static_cast<std::uint32_t>(packet.size()));
  append_little(out, static_cast<std::uint32_t>(packet.size()));
  out += packet;
  if (logged.direction == LoggedDirection::kUnknown) return out;
  std::string flags;
  append_little(flags, logged.direction == LoggedDirection::kReceived ? 1U : 2U);
  append_option(out, kFlags, flags);
  append_option(out, 0, "");
  return out;
}

}  // namespace

std::string to_pcap(const CanLog& log) {
  const bool is_fine = std::any_of(log.frames.begin(), log.frames.end(),
                                   [](const LoggedFrame& f) { return f.at.ns % 1'000 != 0; });
  std::string out;
  append_little(out, is_fine ? kNanoseconds : kMicroseconds);
  append_little(out, std::uint16_t{2});
  append_little(out, std::uint16_t{4});
  append_little(out, std::uint64_t{0});  // zone and digits
  append_little(out, std::uint32_t{kMaxPacketBytes});
  append_little(out, kLinkTypeCan);
  for (const LoggedFrame& logged : log.frames) {
    const std::string packet = packet_of(logged);
    const std::int64_t rest_ns = logged.at.ns % kNanosecondsPerSecond;
    append_little(out, static_cast<std::uint32_t>(logged.at.ns / kNanosecondsPerSecond));
    append_little(out, static_cast<std::uint32_t>(is_fine ? rest_ns : rest_ns / 1'000));
    append_little(out, static_cast<std::uint32_t>(packet.size()));
    append_little(out, static_cast<std::uint32_t>(packet.size()));
    out += packet;
  }
  return out;
}

std::string to_pcapng(const CanLog& log) {
  constexpr std::uint32_t kSection = 0x0A0D0D0A, kInterface = 1, kPacket = 6;
  std::string out;
  append_block(out, kSection, section_body());
  for (const std::string& channel : log.channels)
    append_block(out, kInterface, interface_body(channel));
  for (const LoggedFrame& logged : log.frames) append_block(out, kPacket, packet_body(logged));
  return out;
}

}  // namespace pitwall::replay
