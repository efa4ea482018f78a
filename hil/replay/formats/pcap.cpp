// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/pcap.hpp"

#include <algorithm>
#include <string>

#include "hil/replay/formats/byte_record.hpp"
#include "hil/replay/formats/recognise.hpp"
#include "hil/replay/formats/socketcan_packet.hpp"

namespace pitwall::replay {
namespace {

constexpr std::size_t kPcapHeader = 24, kRecordHeader = 16;
constexpr std::uint32_t kMicrosecondMagic = 0xA1B2C3D4, kNanosecondMagic = 0xA1B23C4D;
constexpr std::uint16_t kPcapMajor = 2;
constexpr std::uint32_t kLinkTypeMask = 0x0FFFFFFF;  // above it: length of a checksum
constexpr std::int64_t kMostJump_s = 86'400;         // between records, to take up reading again
// A record of CAN is never longer than this; only used to take up reading again.
constexpr std::uint32_t kMostCanPacket = 92;

class PcapReader {
 public:
  PcapReader(std::string_view bytes, std::string_view file_name, const LogWatch& watch)
      : file_{bytes},
        file_name_(file_name),
        builder_(name_of(FileFormat::kPcap), file_name, watch, bytes.size()) {}

  Result<CanLog, Problem> read() {
    if (file_.size() < kPcapHeader)
      return refuse(std::string(file_name_) + ": byte 0",
                    "looks like a pcap capture, but its file header is cut off");
    const std::uint32_t magic = file_.u32(0);
    file_.big_endian = magic != kMicrosecondMagic && magic != kNanosecondMagic;
    unit_ns_ = file_.u32(0) == kNanosecondMagic ? 1 : 1'000;
    if (file_.u16(4) != kPcapMajor)
      return refuse(std::string(file_name_) + ": byte 4", "looks like a pcap capture of version " +
                                                              std::to_string(file_.u16(4)) +
                                                              "; expected version 2");
    if (file_.u32(8) != 0) builder_.note("the capture names a time zone; its stamps are UTC");
    link_type_ = file_.u32(20) & kLinkTypeMask;
    if (!is_can_link_type(link_type_))
      return refuse(std::string(file_name_) + ": byte 20",
                    "looks like a pcap capture of link type " + std::to_string(link_type_) +
                        "; expected CAN: 227, 113 or 276");
    read_records();
    return std::move(builder_).finish();
  }

 private:
  std::size_t left(std::size_t at) const { return file_.size() - at; }

  void read_records() {
    std::size_t at = kPcapHeader;
    while (at < file_.size() && builder_.reach(at)) {
      if (left(at) < kRecordHeader) return builder_.cut_byte(at, "a record is cut off");
      const std::uint32_t length = file_.u32(at + 8);
      const bool fits = is_stamp(at) && length <= kMaxPacketBytes && length <= file_.u32(at + 12);
      if (!fits || length > left(at) - kRecordHeader) {
        const std::size_t next = next_pair(at + 1);
        if (fits && next == file_.size()) return builder_.cut_byte(at, "a record is cut off");
        builder_.leave_out_byte(at, "the header of a record is damaged: " +
                                        std::to_string(next - at) + " bytes are left out");
        at = next;
        continue;
      }
      read_packet(at, length);
      at += kRecordHeader + length;
    }
  }

  bool is_stamp(std::size_t at) const {
    return file_.u32(at + 4) < static_cast<std::uint32_t>(kNanosecondsPerSecond / unit_ns_);
  }

  // A header such as a CAN capture has it, not far from the time of the last one.
  bool is_likely(std::size_t at) const {
    if (left(at) < kRecordHeader || !is_stamp(at)) return false;
    const std::uint32_t length = file_.u32(at + 8);
    const std::int64_t jump_s = static_cast<std::int64_t>(file_.u32(at)) - last_s_;
    return length == file_.u32(at + 12) && length <= kMostCanPacket &&
           length <= left(at) - kRecordHeader &&
           (last_s_ < 0 || (jump_s <= kMostJump_s && jump_s >= -kMostJump_s));
  }

  // The next place where a record and another one behind it, or the end, are likely.
  std::size_t next_pair(std::size_t at) const {
    for (; at < file_.size(); ++at) {
      if (!is_likely(at)) continue;
      const std::size_t behind = at + kRecordHeader + file_.u32(at + 8);
      if (behind == file_.size() || is_likely(behind)) return at;
    }
    return file_.size();
  }

  void read_packet(std::size_t at, std::uint32_t length) {
    if (length != file_.u32(at + 12))
      return builder_.leave_out_byte(at, "the recorder has cut this packet short");
    SocketCanPacket packet = read_socketcan_packet(
        link_type_, file_.bytes.substr(at + kRecordHeader, length), file_.big_endian);
    LogCounters& counters = builder_.counters();
    if (packet.kind == PacketKind::kErrorFrame) return void(++counters.error_frames);
    if (packet.kind == PacketKind::kOther) return void(++counters.other_records);
    if (packet.kind == PacketKind::kBad) return builder_.leave_out_byte(at, packet.why);
    const std::uint32_t whole_s = file_.u32(at);
    packet.logged.at = {whole_s * kNanosecondsPerSecond + file_.u32(at + 4) * unit_ns_};
    const auto channel = builder_.channel(
        packet.interface_index ? "if" + std::to_string(*packet.interface_index) : "can0");
    if (!channel) return builder_.leave_out_byte(at, "more than 32 interfaces in one log");
    packet.logged.channel = *channel;
    if (const auto reason = builder_.add(packet.logged))
      return builder_.leave_out_byte(at, *reason);
    last_s_ = whole_s;
  }

  ByteRecord file_;
  std::string_view file_name_;
  LogBuilder builder_;
  std::uint32_t link_type_ = 0;
  std::int64_t unit_ns_ = 1'000;
  std::int64_t last_s_ = -1;  // of the last frame that was read
};

}  // namespace

Result<CanLog, Problem> read_pcap(std::string_view bytes, std::string_view file_name,
                                  const LogWatch& watch) {
  return PcapReader(bytes, file_name, watch).read();
}

}  // namespace pitwall::replay
