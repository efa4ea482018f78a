// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/candump_log.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

namespace pitwall::replay {
namespace {

constexpr std::size_t kMaxChannelName = 15;  // IFNAMSIZ - 1
constexpr std::uint32_t kErrorFlag = 0x20000000;
constexpr std::uint32_t kExtendedFlag = 0x80000000;
constexpr std::size_t kStandardDigits = 3, kExtendedDigits = 8;
constexpr std::size_t kMaxClassicBytes = 8;
constexpr int kStampDigits = 9;
constexpr std::size_t kMaxSecondDigits = 10;
constexpr std::int64_t kMaxSeconds = 9'000'000'000;  // the year 2255; int64 nanoseconds end later

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr bool is_fd_length(std::size_t n) {
  return n <= 8 || n == 12 || n == 16 || n == 20 || n == 24 || n == 32 || n == 48 || n == 64;
}

// One line, read from left to right; `what` is set at the first thing that does not fit.
struct Line {
  std::string_view text;
  std::size_t at = 0;
  const char* what = nullptr;

  bool done() const { return at == text.size(); }
  char peek() const { return done() ? '\0' : text[at]; }
  bool refuse(const char* reason) { return what = reason, false; }
  bool take(char c, const char* reason) { return peek() == c ? (++at, true) : refuse(reason); }
  void skip_spaces() {
    while (peek() == ' ' || peek() == '\t') ++at;
  }
};

bool read_stamp(Line& line, UtcTime& out) {
  if (!line.take('(', "expected a stamp in brackets: (seconds.fraction)")) return false;
  std::int64_t whole_s = 0, fraction_ns = 0;
  std::size_t digits = 0;
  for (; is_digit(line.peek()) && digits < kMaxSecondDigits; ++line.at, ++digits)
    whole_s = whole_s * 10 + (line.peek() - '0');
  if (digits == 0) return line.refuse("expected the seconds of a stamp");
  if (whole_s > kMaxSeconds) return line.refuse("stamp out of range");
  if (!line.take('.', "expected '.' after at most 10 digits of seconds")) return false;
  int places = 0;
  for (; is_digit(line.peek()) && places < kStampDigits; ++line.at, ++places)
    fraction_ns = fraction_ns * 10 + (line.peek() - '0');
  if (places == 0) return line.refuse("expected the fraction of a stamp");
  for (; places < kStampDigits; ++places) fraction_ns *= 10;
  out = {whole_s * kNanosecondsPerSecond + fraction_ns};
  return line.take(')', "expected ')' after at most 9 digits of fraction");
}

bool read_channel(Line& line, CandumpLog& log, std::uint8_t& out) {
  line.skip_spaces();
  const std::size_t begin = line.at;
  while (!line.done() && line.peek() != ' ' && line.peek() != '\t') ++line.at;
  const std::string_view name = line.text.substr(begin, line.at - begin);
  if (name.empty() || name.size() > kMaxChannelName) {
    line.at = begin;
    return line.refuse("expected an interface name of 1 to 15 characters");
  }
  const auto known = std::find(log.channels.begin(), log.channels.end(), name);
  out = static_cast<std::uint8_t>(known - log.channels.begin());
  if (known != log.channels.end()) return true;
  if (log.channels.size() == kMaxChannels) {
    line.at = begin;
    return line.refuse("more than 32 interfaces in one log");
  }
  log.channels.emplace_back(name);
  return true;
}

// Sets is_error where the line is an error frame.
bool read_id(Line& line, can::Frame& out, bool& is_error) {
  line.skip_spaces();
  const std::size_t begin = line.at;
  std::uint32_t id = 0;
  for (; hex_value(line.peek()) >= 0 && line.at - begin < kExtendedDigits; ++line.at)
    id = id * 16 + static_cast<std::uint32_t>(hex_value(line.peek()));
  const std::size_t digits = line.at - begin;
  if (digits != kStandardDigits && digits != kExtendedDigits)
    return line.refuse("expected an identifier of 3 or 8 hex digits");
  out.extended = digits == kExtendedDigits;
  is_error = out.extended && (id & kErrorFlag) != 0;
  if (out.extended) id &= ~(kErrorFlag | kExtendedFlag);
  if (id > (out.extended ? can::kMaxExtendedId : can::kMaxStandardId)) {
    line.at = begin;
    return line.refuse("identifier out of range");
  }
  out.id = id;
  return line.take('#', "expected '#' after the identifier");
}

bool read_data(Line& line, can::Frame& out, std::size_t most) {
  std::size_t n = 0;
  while (hex_value(line.peek()) >= 0) {
    const int high = hex_value(line.peek());
    if (n == most) return line.refuse("too many data bytes");
    ++line.at;
    const int low = hex_value(line.peek());
    if (low < 0) return line.refuse("a data byte needs two hex digits");
    ++line.at;
    out.data[n++] = static_cast<std::uint8_t>(high * 16 + low);
    if (line.peek() == '.') ++line.at;  // an allowed separator
  }
  out.length = static_cast<std::uint8_t>(n);
  return true;
}

bool read_remote(Line& line, can::Frame& out) {
  ++line.at;
  out.remote = true;
  if (!is_digit(line.peek())) return true;
  out.length = static_cast<std::uint8_t>(line.peek() - '0');
  if (out.length > kMaxClassicBytes) return line.refuse("a remote frame asks for at most 8 bytes");
  ++line.at;
  return true;
}

bool read_fd(Line& line, LoggedFrame& out) {
  ++line.at;
  const int flags = hex_value(line.peek());
  if (flags < 0) return line.refuse("expected one hex digit of CAN FD flags after ##");
  out.fd_flags = static_cast<std::uint8_t>(flags);
  out.frame.fd = true;
  ++line.at;
  if (!read_data(line, out.frame, can::kMaxDataBytes)) return false;
  return is_fd_length(out.frame.length) || line.refuse("CAN FD has no frames of this length");
}

bool read_payload(Line& line, LoggedFrame& out) {
  if (line.peek() == '#') return read_fd(line, out);
  if (line.peek() == 'R' || line.peek() == 'r') return read_remote(line, out.frame);
  if (!read_data(line, out.frame, kMaxClassicBytes)) return false;
  if (line.peek() != '_') return true;
  ++line.at;  // the raw length code 9..F of an 8-byte frame: the same 8 bytes on the bus
  const int code = hex_value(line.peek());
  if (out.frame.length != kMaxClassicBytes || code <= 8)
    return line.refuse("a raw length code needs 8 data bytes and is 9 to F");
  ++line.at;
  return true;
}

bool read_direction(Line& line, LoggedFrame& out) {
  if (!line.done() && line.peek() != ' ' && line.peek() != '\t')
    return line.refuse("unexpected character after the frame");
  line.skip_spaces();
  if (line.peek() == 'T' || line.peek() == 'R') {
    out.direction = line.peek() == 'T' ? LoggedDirection::kTransmitted : LoggedDirection::kReceived;
    ++line.at;
    line.skip_spaces();
  }
  return line.done() || line.refuse("expected the end of the line, or T or R");
}

// "DROPCOUNT: dropped 12 CAN frames on 'can0' socket (total drops 34)"
bool read_drop_line(std::string_view text, CandumpCounters& counters) {
  constexpr std::string_view kStart = "DROPCOUNT: dropped ";
  if (!text.starts_with("DROPCOUNT")) return false;
  ++counters.drop_lines;
  if (!text.starts_with(kStart)) return true;
  std::uint64_t n = 0;
  for (const char c : text.substr(kStart.size(), kMaxSecondDigits)) {
    if (!is_digit(c)) break;
    n = n * 10 + static_cast<std::uint64_t>(c - '0');
  }
  counters.recorder_drops += n;
  return true;
}

bool read_frame_line(Line& line, CandumpLog& log) {
  LoggedFrame logged;
  bool is_error = false;
  const bool fits = read_stamp(line, logged.at) && read_channel(line, log, logged.channel) &&
                    read_id(line, logged.frame, is_error) && read_payload(line, logged) &&
                    read_direction(line, logged);
  if (!fits) return false;
  if (is_error) {
    ++log.counters.error_frames;
    return true;
  }
  if (!log.frames.empty() && logged.at < log.frames.back().at) ++log.counters.backward_stamps;
  log.frames.push_back(logged);
  return true;
}

}  // namespace

Result<CandumpLog, Problem> parse_candump_log(std::string_view text, std::string_view file_name) {
  CandumpLog log;
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = text.find('\n');
    const bool is_cut_off = end == std::string_view::npos;
    std::string_view raw = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (raw.ends_with('\r')) raw.remove_suffix(1);
    if (raw.find_first_not_of(" \t") == std::string_view::npos) {
      ++log.counters.blank_lines;
      continue;
    }
    if (read_drop_line(raw, log.counters)) continue;
    Line line{.text = raw};
    if (read_frame_line(line, log)) continue;
    if (is_cut_off && !log.frames.empty()) {
      ++log.counters.cut_off_lines;
      continue;
    }
    return Unexpected{Problem{
        std::string(file_name) + ":" + std::to_string(number) + ":" + std::to_string(line.at + 1),
        line.what}};
  }
  return log;
}

std::string to_candump_line(const LoggedFrame& logged, std::string_view channel) {
  const can::Frame& f = logged.frame;
  const auto whole_s = static_cast<long long>(logged.at.ns / kNanosecondsPerSecond);
  const auto rest_ns = static_cast<long long>(logged.at.ns % kNanosecondsPerSecond);
  std::array<char, 64> start{};
  if (rest_ns % 1'000 == 0)
    std::snprintf(start.data(), start.size(), "(%010lld.%06lld) ", whole_s, rest_ns / 1'000);
  else
    std::snprintf(start.data(), start.size(), "(%010lld.%09lld) ", whole_s, rest_ns);
  std::array<char, 16> id{};
  std::snprintf(id.data(), id.size(), f.extended ? "%08X#" : "%03X#", f.id);
  std::string out = start.data() + std::string(channel) + " " + id.data();
  constexpr const char* kHex = "0123456789ABCDEF";
  if (f.fd) out += {'#', kHex[logged.fd_flags & 0xFU]};
  if (f.remote) {
    out += 'R';
    if (f.length > 0) out += kHex[f.length];
  } else {
    for (const std::uint8_t byte : f.payload()) out += {kHex[byte >> 4U], kHex[byte & 0xFU]};
  }
  if (logged.direction == LoggedDirection::kTransmitted) out += " T";
  if (logged.direction == LoggedDirection::kReceived) out += " R";
  return out;
}

}  // namespace pitwall::replay
