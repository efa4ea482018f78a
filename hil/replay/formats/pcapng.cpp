// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/pcapng.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "hil/replay/formats/byte_record.hpp"
#include "hil/replay/formats/pcap.hpp"
#include "hil/replay/formats/recognise.hpp"
#include "hil/replay/formats/socketcan_packet.hpp"

namespace pitwall::replay {
namespace {

constexpr std::uint32_t kInterfaceBlock = 1, kOldPacketBlock = 2, kSimplePacketBlock = 3,
                        kPacketBlock = 6;
constexpr std::uint32_t kByteOrderMagic = 0x1A2B3C4D;
constexpr std::size_t kBlockFrame = 12;  // type and both lengths
constexpr std::size_t kBlockHead = 8;
constexpr std::uint16_t kOptionName = 2, kOptionResolution = 9, kOptionOffset = 14;
constexpr std::uint16_t kOptionFlags = 2;  // of a packet
constexpr unsigned kMicroseconds = 6;      // the resolution that is meant without an option
constexpr unsigned kMostBinary = 32;

struct CaptureInterface {
  std::uint32_t link_type = 0;
  std::string name;
  unsigned resolution = kMicroseconds;
  bool is_binary = false;  // resolution is 2^-n, not 10^-n
  std::int64_t offset_s = 0;
};

struct CapturePacket {
  std::uint32_t interface_index = 0, length = 0, original = 0;
  std::uint64_t ticks = 0;
  std::size_t data_at = 0;  // in the block's body
};

std::size_t padded(std::size_t n) { return (n + 3) / 4 * 4; }

// Nothing where nanoseconds of 64 bits do not hold it.
std::optional<UtcTime> time_of(const CaptureInterface& source, std::uint64_t ticks) {
  std::uint64_t whole_s = 0, rest_ns = 0;
  if (source.is_binary) {
    whole_s = ticks >> source.resolution;
    const std::uint64_t rest = ticks & ((std::uint64_t{1} << source.resolution) - 1);
    rest_ns = rest * static_cast<std::uint64_t>(kNanosecondsPerSecond) >> source.resolution;
  } else {
    std::uint64_t per_second = 1;
    for (unsigned i = 0; i < source.resolution; ++i) per_second *= 10;
    whole_s = ticks / per_second;
    const std::uint64_t rest = ticks % per_second;
    const auto second_ns = static_cast<std::uint64_t>(kNanosecondsPerSecond);
    rest_ns =
        per_second <= second_ns ? rest * (second_ns / per_second) : rest / (per_second / second_ns);
  }
  constexpr std::int64_t kMost_s = 9'000'000'000;
  if (whole_s > static_cast<std::uint64_t>(kMost_s)) return std::nullopt;
  const auto s = static_cast<std::int64_t>(whole_s);
  if (source.offset_s < -s || source.offset_s > kMost_s - s) return std::nullopt;
  return UtcTime{(s + source.offset_s) * kNanosecondsPerSecond +
                 static_cast<std::int64_t>(rest_ns)};
}

class PcapngReader {
 public:
  PcapngReader(std::string_view bytes, std::string_view file_name, const LogWatch& watch)
      : file_{bytes}, builder_(name_of(FileFormat::kPcapng), file_name, watch, bytes.size()) {}

  Result<CanLog, Problem> read() {
    std::size_t at = 0;
    while (at < file_.size() && builder_.reach(at)) at = read_block(at);
    return std::move(builder_).finish();
  }

 private:
  // Sets the byte order where a section begins.
  bool is_section(std::size_t at) const {
    return file_.size() - at >= kBlockFrame + 4 && file_.bytes.substr(at, 4) == "\n\r\r\n";
  }
  bool order_of(std::size_t at) const {
    return ByteRecord{file_.bytes, true}.u32(at + 8) == kByteOrderMagic;
  }

  // The length of the whole block at a place; 0: there is none.
  std::size_t block_at(std::size_t at) const {
    if (file_.size() - at < kBlockFrame) return 0;
    ByteRecord record = file_;
    if (is_section(at)) {
      record.big_endian = order_of(at);
      if (record.u32(at + 8) != kByteOrderMagic) return 0;
    }
    const std::size_t length = record.u32(at + 4);
    if (length < kBlockFrame || length % 4 != 0 || length > file_.size() - at) return 0;
    return record.u32(at + length - 4) == length ? length : 0;
  }

  std::size_t read_block(std::size_t at) {
    const std::size_t length = block_at(at);
    if (length == 0) return skip_block(at);
    if (is_section(at)) {
      file_.big_endian = order_of(at);
      interfaces_.clear();
      return at + length;
    }
    const ByteRecord body{file_.bytes.substr(at + kBlockHead, length - kBlockFrame),
                          file_.big_endian};
    const std::uint32_t type = file_.u32(at);
    if (type == kInterfaceBlock)
      read_interface(at, body);
    else if (type == kPacketBlock || type == kOldPacketBlock || type == kSimplePacketBlock)
      read_packet_block(at, type, body);
    else
      ++builder_.counters().other_records;
    return at + length;
  }

  std::size_t skip_block(std::size_t at) {
    std::size_t next = at + 1;
    while (next < file_.size() && block_at(next) == 0) ++next;
    const std::string bytes = std::to_string(next - at);
    if (next == file_.size())
      builder_.cut_byte(
          at, "a block is cut off or damaged: " + bytes + " bytes at the end are left out");
    else
      builder_.leave_out_byte(at, "a block is damaged: " + bytes + " bytes are left out");
    return next;
  }

  void read_interface(std::size_t at, ByteRecord body) {
    CaptureInterface source;
    source.name = "can" + std::to_string(interfaces_.size());
    const bool fits = body.size() >= 8;
    if (fits) {
      source.link_type = body.u16(0);
      for_each_option(body, 8, [&](std::uint16_t code, ByteRecord value) {
        read_interface_option(source, code, value);
      });
    } else {
      builder_.leave_out_byte(at, "the description of an interface is too short");
    }
    if (!is_can_link_type(source.link_type))
      builder_.note("interface " + source.name + " has link type " +
                    std::to_string(source.link_type) + ", which is not CAN");
    interfaces_.push_back(std::move(source));
  }

  void read_interface_option(CaptureInterface& source, std::uint16_t code, ByteRecord value) {
    const bool is_name = value.size() > 0 && value.size() <= kMaxChannelName &&
                         value.bytes.find_first_of(" \t\r\n") == std::string_view::npos;
    if (code == kOptionName && is_name)
      source.name = value.bytes;
    else if (code == kOptionName)
      builder_.note("an interface is called \"" + source.name +
                    "\" here: its name in the capture is no word of 1 to 15 characters");
    if (code == kOptionOffset && value.size() == 8)
      source.offset_s = static_cast<std::int64_t>(value.u64(0));
    if (code != kOptionResolution || value.size() != 1) return;
    source.is_binary = (value.u8(0) & 0x80U) != 0;
    source.resolution = value.u8(0) & 0x7FU;
  }

  template <class Take>
  static void for_each_option(ByteRecord body, std::size_t at, Take take) {
    while (at + 4 <= body.size()) {
      const std::uint16_t code = body.u16(at), length = body.u16(at + 2);
      if (code == 0 || length > body.size() - at - 4) return;
      take(code, ByteRecord{body.bytes.substr(at + 4, length), body.big_endian});
      at += 4 + padded(length);
    }
  }

  void read_packet_block(std::size_t at, std::uint32_t type, ByteRecord body) {
    constexpr std::size_t kSimpleHead = 4, kHead = 20;
    const bool is_simple = type == kSimplePacketBlock;
    CapturePacket packet{.data_at = is_simple ? kSimpleHead : kHead};
    if (body.size() < packet.data_at)
      return builder_.leave_out_byte(at, "a packet that is shorter than its header");
    if (is_simple) {
      packet.original = body.u32(0);
      packet.length = static_cast<std::uint32_t>(
          std::min<std::size_t>(packet.original, body.size() - kSimpleHead));
      builder_.note("packets without a stamp: they have the time of the one before");
    } else {
      packet.interface_index = type == kPacketBlock ? body.u32(0) : body.u16(0);
      packet.ticks = std::uint64_t{body.u32(4)} << 32U | body.u32(8);
      packet.length = body.u32(12);
      packet.original = body.u32(16);
    }
    if (packet.length > body.size() - packet.data_at || packet.length != packet.original)
      return builder_.leave_out_byte(at, "a packet that was cut short, or its length is damaged");
    if (packet.interface_index >= interfaces_.size())
      return builder_.leave_out_byte(at, "a packet of an interface that is not described");
    enter(at, packet, body, is_simple);
  }

  void enter(std::size_t at, const CapturePacket& packet, ByteRecord body, bool is_simple) {
    const CaptureInterface& source = interfaces_[packet.interface_index];
    LogCounters& counters = builder_.counters();
    if (!is_can_link_type(source.link_type)) return void(++counters.other_records);
    SocketCanPacket read = read_socketcan_packet(
        source.link_type, body.bytes.substr(packet.data_at, packet.length), file_.big_endian);
    if (read.kind == PacketKind::kErrorFrame) return void(++counters.error_frames);
    if (read.kind == PacketKind::kOther) return void(++counters.other_records);
    if (read.kind == PacketKind::kBad) return builder_.leave_out_byte(at, read.why);
    const auto time = is_simple ? last_ : stamp_of(source, packet.ticks);
    if (!time) return builder_.leave_out_byte(at, "stamp out of range");
    read.logged.at = *time;
    for_each_option(body, packet.data_at + padded(packet.length),
                    [&](std::uint16_t code, ByteRecord value) {
                      if (code == kOptionFlags && value.size() == 4)
                        take_direction(read.logged, value.u32(0));
                    });
    const auto channel = builder_.channel(source.name);
    if (!channel) return builder_.leave_out_byte(at, "more than 32 interfaces in one log");
    read.logged.channel = *channel;
    if (const auto reason = builder_.add(read.logged)) return builder_.leave_out_byte(at, *reason);
    last_ = read.logged.at;
  }

  static std::optional<UtcTime> stamp_of(const CaptureInterface& source, std::uint64_t ticks) {
    constexpr unsigned kMostDecimal = 18;
    if (source.resolution > (source.is_binary ? kMostBinary : kMostDecimal)) return std::nullopt;
    return time_of(source, ticks);
  }

  static void take_direction(LoggedFrame& logged, std::uint32_t flags) {
    constexpr std::uint32_t kMask = 3, kInbound = 1, kOutbound = 2;
    if ((flags & kMask) == kInbound) logged.direction = LoggedDirection::kReceived;
    if ((flags & kMask) == kOutbound) logged.direction = LoggedDirection::kTransmitted;
  }

  ByteRecord file_;
  LogBuilder builder_;
  std::vector<CaptureInterface> interfaces_;
  std::optional<UtcTime> last_{UtcTime{}};
};

}  // namespace

Result<CanLog, Problem> read_pcapng(std::string_view bytes, std::string_view file_name,
                                    const LogWatch& watch) {
  return PcapngReader(bytes, file_name, watch).read();
}

}  // namespace pitwall::replay
