// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_stream.hpp"

#include <algorithm>
#include <string_view>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/little_endian.hpp"
#include "protocol/gnss/novatel_ascii.hpp"

namespace pitwall::gnss {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint8_t kSync1 = 0xAA, kSync2 = 0x44, kSyncLong = 0x12, kSyncShort = 0x13;
constexpr std::size_t kSyncBytes = 3;
constexpr std::size_t kMaxHeaderBytes = 64;  // the format allows headers to grow
// After the '*' of an ASCII log: eight digits and a line end.
constexpr std::size_t kCrcDigits = 8, kTailBytes = kCrcDigits + 2;
// Longer than any log that we know; what looks like the start of a log holds back so much at most.
constexpr std::size_t kMaxTextBytes = 2'000;

struct Lengths {
  std::size_t header = 0, body = 0;
  std::size_t frame() const { return header + body + kCrcBytes; }
};

Lengths read_lengths(Bytes at) {
  if (at[2] == kSyncShort) return {.header = kShortHeaderBytes, .body = at[3]};
  return {.header = at[3], .body = static_cast<std::size_t>(at[8] | at[9] << 8U)};
}

NovatelHeader read_header(Bytes at) {
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

std::uint32_t read_crc(Bytes frame) {
  return ByteReader{frame.last(kCrcBytes)}.get<std::uint32_t>();
}

bool is_text_sync(std::uint8_t byte) { return byte == kAsciiLong || byte == kAsciiShort; }

bool is_printable(std::uint8_t byte) { return byte >= ' ' && byte <= '~'; }

// The receiver writes lower case; what passes its logs on may write upper. Nobody writes both in
// one checksum.
std::optional<std::uint32_t> hex_digit(std::uint8_t byte) {
  if (byte >= '0' && byte <= '9') return static_cast<std::uint32_t>(byte - '0');
  if (byte >= 'a' && byte <= 'f') return static_cast<std::uint32_t>(byte - 'a') + 10U;
  if (byte >= 'A' && byte <= 'F') return static_cast<std::uint32_t>(byte - 'A') + 10U;
  return std::nullopt;
}

// Whether what follows a '*' can be a tail, as far as it is there.
bool may_be_tail(Bytes at) {
  bool lower = false, upper = false;
  for (std::size_t i = 0; i < at.size(); ++i) {
    lower = lower || (at[i] >= 'a' && at[i] <= 'f');
    upper = upper || (at[i] >= 'A' && at[i] <= 'F');
    if (lower && upper) return false;
    if (i < kCrcDigits && !hex_digit(at[i])) return false;
    if (i == kCrcDigits && at[i] != '\r') return false;
    if (i == kCrcDigits + 1 && at[i] != '\n') return false;
  }
  return true;
}

std::uint32_t read_digits(Bytes at) {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : at.first(kCrcDigits)) value = value << 4U | *hex_digit(byte);
  return value;
}

// Where the star of the log that begins here lies: found, still possible or impossible.
struct Star {
  bool found = false;
  bool possible = true;
  std::size_t at = 0;
};

Star find_star(Bytes unread) {
  const auto tail = [&](std::size_t star) {
    return unread.subspan(star + 1, std::min(unread.size() - star - 1, kTailBytes));
  };
  for (std::size_t i = 1; i < unread.size(); ++i) {
    const bool letter = unread[i] >= 'A' && unread[i] <= 'Z';
    if (i >= kMaxTextBytes || !is_printable(unread[i]) || (i == 1 && !letter)) {
      return {.possible = false};
    }
    if (unread[i] != '*' || !may_be_tail(tail(i))) continue;
    return {.found = tail(i).size() == kTailBytes, .at = i};
  }
  return {};
}

std::string_view as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

bool NovatelStream::next(NovatelFrame& frame) {
  while (true) {
    skip_to_sync();
    const Bytes unread = window_.unread();
    if (unread.empty()) return false;
    const Found found = is_text_sync(unread.front()) ? ascii(unread, frame) : binary(unread, frame);
    if (found == Found::kNotYet) return false;
    if (found == Found::kFrame) {
      ++counters_.frames;
      out_of_sync_ = false;
      return true;
    }
    discard(1);
  }
}

NovatelStream::Found NovatelStream::binary(Bytes unread, NovatelFrame& frame) {
  if (unread.size() < kShortHeaderBytes) return Found::kNotYet;  // enough of either for lengths
  const Lengths lengths = read_lengths(unread);
  const bool long_form = unread[2] == kSyncLong;
  if (long_form && (lengths.header < kLongHeaderBytes || lengths.header > kMaxHeaderBytes)) {
    ++counters_.bad_header;
    return Found::kNothing;
  }
  if (lengths.frame() > kMaxFrameBytes) {
    ++counters_.oversize;
    return Found::kNothing;
  }
  if (unread.size() < lengths.frame()) return Found::kNotYet;
  const Bytes whole = unread.first(lengths.frame());
  if (bits::crc32_novatel(whole.first(whole.size() - kCrcBytes)) != read_crc(whole)) {
    ++counters_.bad_crc;
    return Found::kNothing;
  }
  frame = {.header = read_header(whole),
           .body = whole.subspan(lengths.header, lengths.body),
           .ascii = false,
           .bytes = whole.size()};
  window_.take_off(whole.size());
  return Found::kFrame;
}

NovatelStream::Found NovatelStream::ascii(Bytes unread, NovatelFrame& frame) {
  const Star star = find_star(unread);
  if (!star.possible) return Found::kNothing;
  if (!star.found) return Found::kNotYet;
  const Bytes covered = unread.subspan(1, star.at - 1);  // all between sync and star
  if (bits::crc32_novatel(covered) != read_digits(unread.subspan(star.at + 1))) {
    ++counters_.bad_crc;
    return Found::kNothing;
  }
  const std::string_view text = as_text(covered);
  const std::size_t semicolon = text.find(';');
  const auto header = read_ascii_header(text.substr(0, semicolon), unread[0] == kAsciiShort);
  if (!header || semicolon == std::string_view::npos) {
    ++counters_.bad_header;
    return Found::kNothing;
  }
  frame = {.header = *header,
           .body = covered.subspan(semicolon + 1),
           .ascii = true,
           .bytes = star.at + 1 + kTailBytes};
  window_.take_off(frame.bytes);
  ++counters_.ascii_frames;
  return Found::kFrame;
}

void NovatelStream::skip_to_sync() {
  const Bytes unread = window_.unread();
  std::size_t at = 0;
  for (; at < unread.size(); ++at) {
    const Bytes rest = unread.subspan(at);
    const bool binary = rest[0] == kSync1 && (rest.size() < 2 || rest[1] == kSync2) &&
                        (rest.size() < kSyncBytes || rest[2] == kSyncLong || rest[2] == kSyncShort);
    if (binary || is_text_sync(rest[0])) break;
  }
  discard(at);
}

void NovatelStream::discard(std::size_t n) {
  window_.take_off(n);
  counters_.garbage_bytes += n;
  if (n > 0 && !out_of_sync_) ++counters_.resyncs;
  out_of_sync_ = out_of_sync_ || n > 0;
}

}  // namespace pitwall::gnss
