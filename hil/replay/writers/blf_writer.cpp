// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/blf_writer.hpp"

#include <zlib.h>

#include "hil/replay/formats/calendar.hpp"
#include "hil/replay/writers/byte_text.hpp"
#include "hil/replay/writers/log_start.hpp"

namespace pitwall::replay {
namespace {

constexpr std::size_t kFileHeaderBytes = 144;
constexpr std::size_t kContainerBytes = 128 * 1'024;  // unpacked
constexpr std::uint16_t kBaseBytes = 16, kObjectHeaderBytes = 32;
constexpr std::uint32_t kMessage = 1, kContainer = 10, kFdMessage = 100;
constexpr std::uint16_t kDeflated = 2;
constexpr std::uint32_t kInNanoseconds = 2;

void append_base(std::string& out, std::uint16_t header, std::size_t size, std::uint32_t type) {
  out += "LOBJ";
  append_little(out, header);
  append_little(out, std::uint16_t{1});
  append_little(out, static_cast<std::uint32_t>(size));
  append_little(out, type);
}

std::string message_body(const LoggedFrame& logged, unsigned channel) {
  const can::Frame& f = logged.frame;
  std::string out;
  append_little(out, static_cast<std::uint16_t>(channel));
  out += static_cast<char>((logged.direction == LoggedDirection::kTransmitted ? 0x01 : 0) |
                           (f.remote ? 0x80 : 0));
  out += static_cast<char>(code_of_length(f.length));
  append_little(out, f.id | (f.extended ? 0x80000000U : 0U));
  if (f.fd) {
    append_little(out, std::uint32_t{0});  // length on the bus
    out += '\0';                           // bits
    out += static_cast<char>(1U | (logged.fd_flags & 0x3U) << 1U);
    out += static_cast<char>(f.length);
    out.append(5, '\0');
  }
  const std::size_t end = out.size() + (f.fd ? can::kMaxDataBytes : 8U);
  if (!f.remote) out.append(f.data.begin(), f.data.begin() + f.length);
  pad_to(out, end);
  return out;
}

void append_object(std::string& out, const LoggedFrame& logged, unsigned channel, UtcTime zero) {
  const std::string body = message_body(logged, channel);
  append_base(out, kObjectHeaderBytes, kObjectHeaderBytes + body.size(),
              logged.frame.fd ? kFdMessage : kMessage);
  append_little(out, kInNanoseconds);
  append_little(out, std::uint32_t{0});  // client, version
  append_little(out, static_cast<std::uint64_t>(logged.at.ns - zero.ns));
  out += body;  // a multiple of 4 bytes: no padding
}

bool append_container(std::string& out, const std::string& objects) {
  uLongf size = compressBound(static_cast<uLong>(objects.size()));
  std::string packed(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(objects.data()),
               static_cast<uLong>(objects.size())) != Z_OK)
    return false;
  packed.resize(size);
  const std::size_t whole = kBaseBytes + 16U + packed.size();
  append_base(out, kBaseBytes, whole, kContainer);
  append_little(out, kDeflated);
  out.append(6, '\0');
  append_little(out, static_cast<std::uint32_t>(objects.size()));
  out.append(4, '\0');
  out += packed;
  out.append(whole % 4, '\0');  // as Vector's own writer has it
  return true;
}

void append_system_time(std::string& out, UtcTime at) {
  const CalendarParts t = parts_of(at);
  for (const std::int64_t field :
       {t.day.year, std::int64_t{t.day.month}, t.weekday, std::int64_t{t.day.day}, t.hour, t.minute,
        t.second, t.ns / kNanosecondsPerMillisecond})
    append_little(out, static_cast<std::uint16_t>(field));
}

std::string file_header(const CanLog& log, std::size_t packed, std::size_t unpacked) {
  std::string out = "LOGG";
  append_little(out, std::uint32_t{kFileHeaderBytes});
  out += std::string("\0\1\0\0\2\6\10\1", 8);  // application 0, version 1; format 2.6.8.1
  append_little(out, static_cast<std::uint64_t>(kFileHeaderBytes + packed));
  append_little(out, static_cast<std::uint64_t>(kFileHeaderBytes + unpacked));
  append_little(out, static_cast<std::uint32_t>(log.frames.size()));
  append_little(out, std::uint32_t{0});
  append_system_time(out, start_of(log));
  append_system_time(out, log.frames.empty() ? UtcTime{} : log.frames.back().at);
  pad_to(out, kFileHeaderBytes);
  return out;
}

}  // namespace

Result<std::string, Problem> to_blf(const CanLog& log, std::span<const unsigned> channel_numbers) {
  const UtcTime zero = start_of(log);
  std::string containers, objects;
  std::size_t unpacked = 0;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    const LoggedFrame& logged = log.frames[i];
    append_object(objects, logged, channel_numbers[logged.channel], zero);
    if (objects.size() < kContainerBytes && i + 1 < log.frames.size()) continue;
    unpacked += 2U * kBaseBytes + objects.size();
    if (!append_container(containers, objects))
      return refuse("BLF", "there is no memory to pack a container");
    objects.clear();
  }
  return file_header(log, containers.size(), unpacked) + containers;
}

}  // namespace pitwall::replay
