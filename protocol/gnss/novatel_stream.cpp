// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_stream.hpp"

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/little_endian.hpp"

namespace pitwall::gnss {
namespace {

constexpr std::uint8_t kSync1 = 0xAA, kSync2 = 0x44, kSyncLong = 0x12, kSyncShort = 0x13;
constexpr std::size_t kSyncBytes = 3;
constexpr std::size_t kMaxHeaderBytes = 64;  // the format allows headers to grow

struct Lengths {
  std::size_t header = 0, body = 0;
  std::size_t frame() const { return header + body + kCrcBytes; }
};

Lengths read_lengths(std::span<const std::uint8_t> at) {
  if (at[2] == kSyncShort) return {.header = kShortHeaderBytes, .body = at[3]};
  return {.header = at[3], .body = static_cast<std::size_t>(at[8] | at[9] << 8U)};
}

NovatelHeader read_header(std::span<const std::uint8_t> at) {
  NovatelHeader h;
  h.short_form = at[2] == kSyncShort;
  ByteReader in{at.subspan(4)};
  h.id = in.get<std::uint16_t>();
  if (h.short_form) {
    h.port = 0;
    h.time_status = 0;  // a short header does not say
  } else {
    h.message_type = in.get<std::uint8_t>();
    h.port = in.get<std::uint8_t>();
    in.get<std::uint16_t>();  // length of the body, read before
    h.sequence = in.get<std::uint16_t>();
    h.idle_time = in.get<std::uint8_t>();
    h.time_status = in.get<std::uint8_t>();
  }
  h.week = in.get<std::uint16_t>();
  h.milliseconds = in.get<std::uint32_t>();
  if (!h.short_form) {
    h.receiver_status = in.get<std::uint32_t>();
    h.reserved = in.get<std::uint16_t>();
    h.receiver_version = in.get<std::uint16_t>();
  }
  return h;
}

std::uint32_t read_crc(std::span<const std::uint8_t> frame) {
  return ByteReader{frame.last(kCrcBytes)}.get<std::uint32_t>();
}

}  // namespace

bool NovatelStream::next(NovatelFrame& frame) {
  while (true) {
    skip_to_sync();
    const std::span<const std::uint8_t> unread{buffer_.data() + begin_, size_ - begin_};
    if (unread.size() < kShortHeaderBytes) return false;  // enough of either header for lengths
    const Lengths lengths = read_lengths(unread);
    const bool long_form = unread[2] == kSyncLong;
    if (long_form && (lengths.header < kLongHeaderBytes || lengths.header > kMaxHeaderBytes)) {
      ++counters_.bad_header;
      discard(1);
      continue;
    }
    if (lengths.frame() > kMaxFrameBytes) {
      ++counters_.oversize;
      discard(1);
      continue;
    }
    if (unread.size() < lengths.frame()) return false;
    const auto whole = unread.first(lengths.frame());
    if (bits::crc32_novatel(whole.first(whole.size() - kCrcBytes)) != read_crc(whole)) {
      ++counters_.bad_crc;
      discard(1);
      continue;
    }
    frame = {.header = read_header(whole), .body = whole.subspan(lengths.header, lengths.body)};
    begin_ += whole.size();
    ++counters_.frames;
    return true;
  }
}

void NovatelStream::skip_to_sync() {
  while (begin_ < size_) {
    const std::uint8_t* at = buffer_.data() + begin_;
    const std::size_t left = size_ - begin_;
    const bool possible = at[0] == kSync1 && (left < 2 || at[1] == kSync2) &&
                          (left < kSyncBytes || at[2] == kSyncLong || at[2] == kSyncShort);
    if (possible) return;
    discard(1);
  }
}

void NovatelStream::discard(std::size_t n) {
  begin_ += n;
  counters_.garbage_bytes += n;
}

void NovatelStream::compact() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
  size_ -= begin_;
  begin_ = 0;
}

}  // namespace pitwall::gnss
