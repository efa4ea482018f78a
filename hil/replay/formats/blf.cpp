// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/blf.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "hil/replay/formats/byte_record.hpp"
#include "hil/replay/formats/calendar.hpp"
#include "hil/replay/formats/gzip.hpp"
#include "hil/replay/formats/recognise.hpp"

namespace pitwall::replay {
namespace {

constexpr std::string_view kObjectMark = "LOBJ";
constexpr std::size_t kLeastFileHeader = 72;
constexpr std::size_t kStartAt = 40, kFileBytesAt = 16, kObjectsAt = 32;  // in the file header
constexpr std::size_t kBaseHeader = 16, kHeaderV1 = 32, kHeaderV2 = 40;
constexpr std::size_t kContainerHeader = 32;
constexpr std::size_t kMostPadding = 3;
constexpr std::size_t kMaxContainerBytes = std::size_t{1} << 28U;  // unpacked; usual are 128 KiB
constexpr std::size_t kMaxObjectBytes = std::size_t{1} << 24U;     // a picture of a camera, at most
constexpr std::uint32_t kTenMicroseconds = 1, kOneNanosecond = 2;
constexpr std::uint32_t kBlfExtended = 0x80000000;
constexpr std::uint16_t kNotPacked = 0, kPackedByZlib = 2;

enum BlfType : std::uint32_t {
  kCanMessage = 1,
  kCanError = 2,
  kLogContainer = 10,
  kCanErrorExt = 73,
  kCanMessage2 = 86,
  kCanFdMessage = 100,
  kCanFdMessage64 = 101,
  kCanFdError64 = 104,
};

struct BlfFrame {
  LoggedFrame logged;
  std::uint32_t channel = 0;
};

void set_id(can::Frame& f, std::uint32_t id) {
  f.extended = (id & kBlfExtended) != 0;
  f.id = id & ~kBlfExtended;
}

// Nothing, or what is wrong.
const char* set_data(can::Frame& f, std::uint8_t code, std::size_t valid, std::string_view data) {
  if (code > 0xF) return "the length code is beyond 15";
  const std::size_t length = length_of_code(code, f.fd);
  f.length = static_cast<std::uint8_t>(length);
  if (f.remote) return nullptr;
  if (valid != length) return "the length code is not that of the data bytes";
  if (data.size() < length) return "the object is too short for its data";
  std::copy_n(data.begin(), length, f.data.begin());
  return nullptr;
}

constexpr std::size_t kCanBody = 16, kFdBody = 84, kFd64Body = 40;

const char* read_can_message(ByteRecord body, BlfFrame& out) {
  constexpr std::uint8_t kSent = 0x01, kRemote = 0x80;
  if (body.size() < kCanBody) return "a CAN message of fewer than 16 bytes";
  can::Frame& f = out.logged.frame;
  out.channel = body.u16(0);
  f.remote = (body.u8(2) & kRemote) != 0;
  out.logged.direction =
      (body.u8(2) & kSent) != 0 ? LoggedDirection::kTransmitted : LoggedDirection::kReceived;
  set_id(f, body.u32(4));
  const std::size_t valid = length_of_code(body.u8(3), false);
  return set_data(f, body.u8(3), valid, body.bytes.substr(8, 8));
}

const char* read_fd_message(ByteRecord body, BlfFrame& out) {
  constexpr std::uint8_t kSent = 0x01, kRemote = 0x80;
  if (body.size() < kFdBody) return "a CAN FD message of fewer than 84 bytes";
  can::Frame& f = out.logged.frame;
  out.channel = body.u16(0);
  const std::uint8_t flags = body.u8(2), fd_flags = body.u8(13);
  f.fd = (fd_flags & 0x1U) != 0;
  f.remote = (flags & kRemote) != 0;
  if (f.fd) out.logged.fd_flags = static_cast<std::uint8_t>(fd_flags >> 1U & 0x3U);
  out.logged.direction =
      (flags & kSent) != 0 ? LoggedDirection::kTransmitted : LoggedDirection::kReceived;
  set_id(f, body.u32(4));
  return set_data(f, body.u8(3), body.u8(14), body.bytes.substr(20, can::kMaxDataBytes));
}

const char* read_fd_message_64(ByteRecord body, BlfFrame& out) {
  constexpr std::uint32_t kRemote = 0x0010, kFd = 0x1000, kRateSwitch = 0x2000, kState = 0x4000;
  if (body.size() < kFd64Body) return "a CAN FD message of fewer than 40 bytes";
  can::Frame& f = out.logged.frame;
  out.channel = body.u8(0);
  const std::uint32_t flags = body.u32(12);
  f.fd = (flags & kFd) != 0;
  f.remote = (flags & kRemote) != 0;
  if (f.fd)
    out.logged.fd_flags =
        static_cast<std::uint8_t>(((flags & kRateSwitch) != 0 ? kFdBitRateSwitch : 0) |
                                  ((flags & kState) != 0 ? kFdErrorState : 0));
  out.logged.direction =
      body.u8(34) != 0 ? LoggedDirection::kTransmitted : LoggedDirection::kReceived;
  set_id(f, body.u32(4));
  return set_data(f, body.u8(1), body.u8(2), body.bytes.substr(kFd64Body));
}

class BlfReader {
 public:
  BlfReader(std::string_view bytes, std::string_view file_name, const LogWatch& watch)
      : bytes_(bytes),
        file_name_(file_name),
        builder_(name_of(FileFormat::kBlf), file_name, watch, bytes.size()) {}

  Result<CanLog, Problem> read() {
    const ByteRecord header{bytes_};
    const std::size_t header_size = bytes_.size() < 8 ? 0 : header.u32(4);
    if (bytes_.size() < kLeastFileHeader || header_size < kLeastFileHeader ||
        header_size > bytes_.size())
      return refuse(std::string(file_name_) + ": byte 0",
                    "looks like a Vector BLF log, but its file header is cut off or damaged");
    read_start(header);
    read_file(header_size);
    if (stream_.find_first_not_of('\0') != std::string::npos)
      builder_.cut_byte(container_at_, "the last object of this container is cut off");
    note_sizes(header);
    return std::move(builder_).finish();
  }

 private:
  void read_start(ByteRecord header) {
    const auto field = [&](std::size_t i) { return header.u16(kStartAt + 2 * i); };
    const std::int64_t of_day_s = field(4) * 3'600 + field(5) * 60 + field(6);
    const auto start =
        utc_of({.year = field(0), .month = field(1), .day = field(3)},
               of_day_s * kNanosecondsPerSecond + field(7) * kNanosecondsPerMillisecond);
    const bool is_time = field(4) < 24 && field(5) < 60 && field(6) < 61 && field(7) < 1'000;
    const bool is_there = start && is_time;
    if (is_there) zero_ = *start;
    builder_.note(is_there ? "the start time is local time of the recorder; it is taken as UTC"
                           : "there is no start time in the log: time begins at 0");
  }

  void note_sizes(ByteRecord header) {
    const std::uint64_t file_bytes = header.u64(kFileBytesAt), objects = header.u32(kObjectsAt);
    if (file_bytes != bytes_.size())
      builder_.note("the file header says " + std::to_string(file_bytes) + " bytes, " +
                    std::to_string(bytes_.size()) + " are here");
    if (objects != objects_)
      builder_.note("the file header says " + std::to_string(objects) + " objects, " +
                    std::to_string(objects_) + " are here");
  }

  // Where the next object begins: behind padding, or further away, which is told. npos: nowhere.
  std::size_t next_object(std::string_view bytes, std::size_t at, std::size_t reported_at) {
    const std::size_t found = bytes.find(kObjectMark, at);
    if (found != std::string_view::npos && found <= at + kMostPadding) return found;
    builder_.leave_out_byte(reported_at,
                            "expected an object (LOBJ): bytes are skipped up to the next");
    return found;
  }

  void read_file(std::size_t at) {
    while (at < bytes_.size() && builder_.reach(at)) {
      const std::string_view rest = bytes_.substr(at);
      if (rest.size() < kBaseHeader && rest.find_first_not_of('\0') == std::string_view::npos)
        return;
      at = next_object(bytes_, at, at);
      if (at == std::string_view::npos) return;
      if (bytes_.size() - at < kBaseHeader) return builder_.cut_byte(at, "an object is cut off");
      const ByteRecord object{bytes_.substr(at)};
      const std::uint32_t size = object.u32(8);
      if (size < kBaseHeader) {
        builder_.leave_out_byte(at, "an object that is smaller than its header");
        at += kObjectMark.size();
        continue;
      }
      const bool is_cut = size > bytes_.size() - at;
      const std::string_view whole = bytes_.substr(at, size);
      container_at_ = at;
      if (object.u32(12) == kLogContainer)
        read_container(whole, is_cut);
      else if (is_cut)
        builder_.cut_byte(at, "an object is cut off");
      else
        read_object({whole});
      at = is_cut ? resumed(at) : at + size;
    }
  }

  // Behind an object that says it is longer than the file: a later object, or the end.
  std::size_t resumed(std::size_t at) const {
    const std::size_t found = bytes_.find(kObjectMark, at + kObjectMark.size());
    return std::min(found, bytes_.size());
  }

  void read_container(std::string_view container, bool is_cut) {
    if (is_cut) builder_.cut_byte(container_at_, "a container is cut off");
    if (container.size() < kContainerHeader) {
      if (!is_cut) lose_container("a container that is smaller than its header");
      return;
    }
    const ByteRecord record{container};
    const std::uint16_t method = record.u16(16);
    const std::uint32_t size = record.u32(24);
    const std::string_view packed = container.substr(kContainerHeader);
    if (method == kNotPacked) {
      stream_ += packed;
    } else if (method == kPackedByZlib) {
      const Unpacked unpacked = unpack_zlib(packed, kMaxContainerBytes);
      if (!unpacked.problem.empty() && !unpacked.is_cut) return lose_container(unpacked.problem);
      if (unpacked.is_cut && !is_cut) return lose_container(unpacked.problem);
      if (unpacked.bytes.size() != size && !is_cut)
        builder_.leave_out_byte(container_at_, "the container holds " +
                                                   std::to_string(unpacked.bytes.size()) +
                                                   " bytes and says " + std::to_string(size));
      stream_ += unpacked.bytes;
    } else {
      return lose_container("a container that is packed by an unknown method");
    }
    read_stream();
    if (is_cut) stream_.clear();
  }

  void lose_container(std::string_view why) {
    builder_.leave_out_byte(container_at_, why);
    stream_.clear();
    is_lost_ = true;  // what follows may begin inside an object
  }

  void read_stream() {
    std::size_t at = 0;
    if (is_lost_) at = std::min(stream_.find(kObjectMark), stream_.size());
    is_lost_ = false;
    while (stream_.size() - at >= kBaseHeader + kMostPadding || is_whole(at)) {
      const std::size_t found = next_object(stream_, at, container_at_);
      if (found == std::string::npos) {
        at = stream_.size();
        break;
      }
      at = found;
      if (stream_.size() - at < kBaseHeader) break;
      const ByteRecord object{std::string_view(stream_).substr(at)};
      const std::uint32_t size = object.u32(8);
      if (size < kBaseHeader || size > kMaxObjectBytes) {
        builder_.leave_out_byte(container_at_, "an object of an impossible size");
        at += kObjectMark.size();
        continue;
      }
      if (size > object.size()) break;  // it goes on in the next container
      read_object({object.bytes.substr(0, size)});
      at += size;
    }
    stream_.erase(0, at);
  }

  // Whether less than a header with padding is left, and it is an object all the same.
  bool is_whole(std::size_t at) const {
    return stream_.size() - at >= kBaseHeader &&
           std::string_view(stream_).substr(at).starts_with(kObjectMark);
  }

  void read_object(ByteRecord object) {
    ++objects_;
    const std::uint32_t type = object.u32(12);
    if (type == kCanError || type == kCanErrorExt || type == kCanFdError64)
      return void(++builder_.counters().error_frames);
    const bool is_frame = type == kCanMessage || type == kCanMessage2 || type == kCanFdMessage ||
                          type == kCanFdMessage64;
    if (!is_frame) return void(++builder_.counters().other_records);
    BlfFrame frame;
    if (const char* why = read_frame(object, type, frame)) {
      builder_.leave_out_byte(container_at_,
                              "object " + std::to_string(objects_) + " of the log: " + why);
    }
  }

  const char* read_frame(ByteRecord object, std::uint32_t type, BlfFrame& out) {
    const std::uint16_t header = object.u16(4), version = object.u16(6);
    const std::size_t expected = version == 1 ? kHeaderV1 : kHeaderV2;
    if (version < 1 || version > 2 || header != expected || object.size() < header)
      return "expected an object header of version 1 or 2";
    if (const char* why = read_stamp(object, out.logged.at)) return why;
    const ByteRecord body{object.bytes.substr(header)};
    const char* why = type == kCanFdMessage     ? read_fd_message(body, out)
                      : type == kCanFdMessage64 ? read_fd_message_64(body, out)
                                                : read_can_message(body, out);
    if (why != nullptr) return why;
    const auto channel = builder_.numbered_channel(out.channel);
    if (!channel) return "more than 32 channels in one log";
    out.logged.channel = *channel;
    const auto reason = builder_.add(out.logged);
    return reason ? reason->data() : nullptr;
  }

  const char* read_stamp(ByteRecord object, UtcTime& out) const {
    const std::uint32_t flags = object.u32(kBaseHeader);
    if (flags != kTenMicroseconds && flags != kOneNanosecond)
      return "expected a stamp in units of 10 us or 1 ns";
    auto stamp = static_cast<std::int64_t>(object.u64(kBaseHeader + 8));
    const std::int64_t unit_ns = flags == kTenMicroseconds ? 10'000 : 1;
    if (__builtin_mul_overflow(stamp, unit_ns, &stamp) ||
        __builtin_add_overflow(stamp, zero_.ns, &out.ns))
      return "stamp out of range";
    return nullptr;
  }

  std::string_view bytes_, file_name_;
  LogBuilder builder_;
  UtcTime zero_{};
  std::string stream_;  // unpacked and not yet read
  std::size_t container_at_ = 0;
  std::uint64_t objects_ = 0;
  bool is_lost_ = false;
};

}  // namespace

Result<CanLog, Problem> read_blf(std::string_view bytes, std::string_view file_name,
                                 const LogWatch& watch) {
  return BlfReader(bytes, file_name, watch).read();
}

}  // namespace pitwall::replay
