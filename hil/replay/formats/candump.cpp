// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/candump.hpp"

#include <algorithm>
#include <array>

#include "hil/replay/formats/calendar.hpp"
#include "hil/replay/formats/text_line.hpp"

namespace pitwall::replay {
namespace {

constexpr std::uint32_t kErrorFlag = 0x20000000;
constexpr std::uint32_t kExtendedFlag = 0x80000000;
constexpr std::size_t kStandardDigits = 3, kExtendedDigits = 8;
constexpr std::size_t kMaxClassicBytes = 8;
constexpr std::size_t kMaxSecondDigits = 10;
constexpr int kStampDigits = 9;
constexpr std::size_t kBitsOfByte = 8;
// Stamps of the console below this are no calendar time: the year 2001.
constexpr std::int64_t kLeastCalendar_ns = 1'000'000'000LL * kNanosecondsPerSecond;
constexpr std::size_t kBytesOfLine = 40;  // about, to reserve memory
constexpr std::uint64_t kGapsShare = 10;  // -td: more than one stamp in so many goes back

enum class StampKind : std::uint8_t { kNone, kCalendar, kSmall, kLocal };

// One line; the channel's name is entered in the log once the whole line has been read.
struct CandumpLine : TextLine {
  LoggedFrame logged;
  std::string_view channel;
  std::size_t channel_at = 0;
  StampKind stamp = StampKind::kNone;
  bool is_error = false;

  bool read() {
    skip_spaces();
    if (peek() == '(' && !read_stamp()) return false;
    if (stamp != StampKind::kNone && !at_space()) return refuse("expected a space after the stamp");
    if (!read_channel()) return false;
    const std::string_view next = next_word();
    if (next.find('#') != std::string_view::npos) {
      if (stamp == StampKind::kNone) return refuse_from(0, kStampExpected);
      if (stamp == StampKind::kSmall) stamp = StampKind::kCalendar;
      return read_id() && read_log_payload() && read_log_direction();
    }
    return read_console_direction() && read_id_word() && read_console_payload();
  }

 private:
  static constexpr const char* kStampExpected = "expected a stamp in brackets: (seconds.fraction)";

  bool read_stamp() {
    ++at;
    if (text.substr(at).find(' ') == 10 && text.substr(at).find('-') == 4)
      return read_local_stamp();
    std::int64_t whole_s = 0, fraction_ns = 0;
    std::size_t digits = 0;
    for (; is_digit(peek()) && digits < kMaxSecondDigits; ++at, ++digits)
      whole_s = whole_s * 10 + (peek() - '0');
    if (digits == 0) return refuse("expected the seconds of a stamp");
    if (whole_s > kMaxStampSeconds) return refuse("stamp out of range");
    if (!take('.', "expected '.' after at most 10 digits of seconds")) return false;
    int places = 0;
    for (; is_digit(peek()) && places < kStampDigits; ++at, ++places)
      fraction_ns = fraction_ns * 10 + (peek() - '0');
    if (places == 0) return refuse("expected the fraction of a stamp");
    for (; places < kStampDigits; ++places) fraction_ns *= 10;
    logged.at = {whole_s * kNanosecondsPerSecond + fraction_ns};
    stamp = logged.at.ns < kLeastCalendar_ns ? StampKind::kSmall : StampKind::kCalendar;
    return take(')', "expected ')' after at most 9 digits of fraction");
  }

  bool read_local_stamp() {
    constexpr const char* kExpected = "expected a stamp like (2014-04-22 00:57:03.803317)";
    std::uint64_t year = 0, month = 0, day = 0;
    std::int64_t of_day_ns = 0;
    const bool fits = read_unsigned(*this, 10, 9'999, year) && take('-', kExpected) &&
                      read_unsigned(*this, 10, 12, month) && take('-', kExpected) &&
                      read_unsigned(*this, 10, 31, day) && take(' ', kExpected) &&
                      read_time_of_day(*this, of_day_ns);
    if (!fits) return refuse(kExpected);
    const auto utc = utc_of({.year = static_cast<std::int64_t>(year),
                             .month = static_cast<unsigned>(month),
                             .day = static_cast<unsigned>(day)},
                            of_day_ns);
    if (!utc) return refuse("stamp out of range");
    logged.at = *utc;
    stamp = StampKind::kLocal;
    return take(')', "expected ')' after the stamp");
  }

  bool read_channel() {
    skip_spaces();
    channel_at = at;
    channel = word();
    if (!channel.empty() && channel.size() <= kMaxChannelName) return true;
    return refuse_from(channel_at, stamp == StampKind::kNone && channel.empty()
                                       ? kStampExpected
                                       : "expected an interface name of 1 to 15 characters");
  }

  bool read_id() {
    skip_spaces();
    return read_id_digits() && take('#', "expected '#' after the identifier");
  }
  bool read_id_word() {
    skip_spaces();
    if (!read_id_digits()) return false;
    return at_space() || refuse("expected a space after the identifier");
  }

  // Sets is_error where the line is an error frame.
  bool read_id_digits() {
    const std::size_t begin = at;
    std::uint32_t id = 0;
    for (; hex_value(peek()) >= 0 && at - begin < kExtendedDigits; ++at)
      id = id * 16 + static_cast<std::uint32_t>(hex_value(peek()));
    const std::size_t digits = at - begin;
    if (digits != kStandardDigits && digits != kExtendedDigits)
      return refuse("expected an identifier of 3 or 8 hex digits");
    logged.frame.extended = digits == kExtendedDigits;
    is_error = logged.frame.extended && (id & kErrorFlag) != 0;
    if (logged.frame.extended) id &= ~(kErrorFlag | kExtendedFlag);
    if (id > (logged.frame.extended ? can::kMaxExtendedId : can::kMaxStandardId))
      return refuse_from(begin, "identifier out of range");
    logged.frame.id = id;
    return true;
  }

  bool read_log_data(std::size_t most) {
    std::size_t n = 0;
    while (hex_value(peek()) >= 0) {
      if (n == most) return refuse("too many data bytes");
      if (!read_hex_byte(*this, logged.frame.data[n], "")) return false;
      ++n;
      if (peek() == '.') ++at;  // an allowed separator
    }
    logged.frame.length = static_cast<std::uint8_t>(n);
    return true;
  }

  bool read_log_remote() {
    ++at;
    logged.frame.remote = true;
    if (!is_digit(peek())) return true;
    logged.frame.length = static_cast<std::uint8_t>(peek() - '0');
    if (logged.frame.length > kMaxClassicBytes)
      return refuse("a remote frame asks for at most 8 bytes");
    ++at;
    return true;
  }

  bool read_log_fd() {
    ++at;
    const int flags = hex_value(peek());
    if (flags < 0) return refuse("expected one hex digit of CAN FD flags after ##");
    logged.fd_flags = static_cast<std::uint8_t>(flags);
    logged.frame.fd = true;
    ++at;
    if (!read_log_data(can::kMaxDataBytes)) return false;
    return is_fd_length(logged.frame.length) || refuse("CAN FD has no frames of this length");
  }

  bool read_log_payload() {
    if (peek() == '#') return read_log_fd();
    if (peek() == 'R' || peek() == 'r') return read_log_remote();
    if (!read_log_data(kMaxClassicBytes)) return false;
    if (peek() != '_') return true;
    ++at;  // the raw length code 9..F of an 8-byte frame: the same 8 bytes on the bus
    const int code = hex_value(peek());
    if (logged.frame.length != kMaxClassicBytes || code <= 8)
      return refuse("a raw length code needs 8 data bytes and is 9 to F");
    ++at;
    return true;
  }

  bool read_log_direction() {
    if (!at_space()) return refuse("unexpected character after the frame");
    skip_spaces();
    if (peek() == 'T' || peek() == 'R') {
      logged.direction = peek() == 'T' ? LoggedDirection::kTransmitted : LoggedDirection::kReceived;
      ++at;
      skip_spaces();
    }
    return done() || refuse("expected the end of the line, or T or R");
  }

  // "RX B -": of -x.
  bool read_console_direction() {
    const std::string_view next = next_word();
    if (next != "RX" && next != "TX") return true;
    word();
    logged.direction = next == "TX" ? LoggedDirection::kTransmitted : LoggedDirection::kReceived;
    const std::string_view rate = word(), state = word();
    if ((rate != "B" && rate != "-") || (state != "E" && state != "-"))
      return refuse("expected \"- -\", \"B -\", \"- E\" or \"B E\" after RX or TX");
    logged.fd_flags = static_cast<std::uint8_t>((rate == "B" ? kFdBitRateSwitch : 0) |
                                                (state == "E" ? kFdErrorState : 0));
    return true;
  }

  // [8] of a classic frame, [08] of CAN FD, {F} for a raw length code of 8 bytes.
  bool read_console_length() {
    skip_spaces();
    const bool is_code = peek() == '{';
    if (!is_code && peek() != '[') return refuse("expected the length in brackets: [8]");
    const std::size_t begin = ++at;
    std::uint64_t length = 0;
    if (!read_unsigned(*this, is_code ? 16 : 10, can::kMaxDataBytes, length)) return false;
    const std::size_t digits = at - begin;
    logged.frame.fd = !is_code && digits == 2;
    if (digits > 2 || (is_code && (length <= kMaxClassicBytes || length > 0xF)))
      return refuse_from(begin, "expected a length of one or two digits");
    if (is_code) length = kMaxClassicBytes;
    if (logged.frame.fd ? !is_fd_length(length) : length > kMaxClassicBytes)
      return refuse_from(begin, "no frame has this length");
    logged.frame.length = static_cast<std::uint8_t>(length);
    return take(is_code ? '}' : ']', "expected the closing bracket of the length");
  }

  bool read_console_byte(std::uint8_t& out) {
    const std::string_view next = next_word();
    skip_spaces();
    if (next.size() != kBitsOfByte || next.find_first_not_of("01") != std::string_view::npos)
      return read_hex_byte(*this, out, "fewer data bytes than the length in brackets");
    for (std::size_t i = 0; i < kBitsOfByte; ++i)  // -i
      out = static_cast<std::uint8_t>(out * 2 + (text[at++] - '0'));
    return true;
  }

  bool read_console_payload() {
    if (!read_console_length()) return false;
    if (!logged.frame.fd) logged.fd_flags = 0;
    const std::string_view next = next_word();
    if (next == "remote" && !logged.frame.fd) {
      word();
      logged.frame.remote = true;
      return word() == "request" && is_blank(text.substr(at)) ? (at = text.size(), true)
                                                              : refuse("expected remote request");
    }
    const std::size_t n = logged.frame.length;
    bool is_swapped = false;
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0 && peek() == '`')
        is_swapped = true, ++at;  // -S: last byte first
      else if (peek() != ' ' && peek() != '\t')
        return refuse("expected a space before a data byte");
      if (!read_console_byte(logged.frame.data[i])) return false;
    }
    if (is_swapped) std::reverse(logged.frame.data.begin(), logged.frame.data.begin() + n);
    return read_ascii_column(n);
  }

  // Of -a: '..3D' with as many characters as there are bytes; of error frames the word for it.
  bool read_ascii_column(std::size_t n) {
    if (!at_space()) return refuse("expected a space after the data");
    skip_spaces();
    if (is_error && word() == "ERRORFRAME" && done()) return true;
    if (done()) return !is_error || refuse("expected ERRORFRAME behind the data of an error frame");
    const char quote = peek();
    if (quote != '\'' && quote != '`') return refuse("more data than the length in brackets says");
    at = text.size() - 1;
    const std::size_t opening = text.find(quote);
    return (text.size() - opening == n + 2 && peek() == quote) ? (++at, true)
                                                               : refuse(
                                                                     "the text column needs one "
                                                                     "character for each byte");
  }
};

// "DROPCOUNT: dropped 12 CAN frames on 'can0' socket (total drops 34)"
bool read_drop_line(std::string_view text, LogCounters& counters) {
  constexpr std::string_view kStart = "DROPCOUNT: dropped ";
  if (!text.starts_with(kStart)) return false;
  TextLine line{.text = text, .at = kStart.size()};
  std::uint64_t n = 0;
  if (!read_unsigned(line, 10, UINT32_MAX, n) ||
      !line.text.substr(line.at).starts_with(" CAN frame"))
    return false;
  ++counters.drop_lines;
  counters.recorder_drops += n;
  return true;
}

class CandumpReader {
 public:
  CandumpReader(std::string_view file_name, const LogWatch& watch, std::size_t file_bytes)
      : builder_(kCandumpName, file_name, watch, file_bytes) {}

  Result<CanLog, Problem> read(std::string_view text) {
    builder_.expect(text.size() / kBytesOfLine);
    TextLines lines(text);
    while (builder_.reach(lines.position()) && lines.next()) read_line(lines);
    finish_stamps();
    return std::move(builder_).finish();
  }

 private:
  void read_line(const TextLines& lines) {
    const std::string_view text = lines.line();
    LogCounters& counters = builder_.counters();
    if (is_blank(text)) return void(++counters.blank_lines);
    if (!lines.has_end()) return builder_.cut_line(lines.number());
    if (text.front() == '#') return void(++counters.comments);
    if (read_drop_line(text, counters)) return;
    // Of -e: what an error frame says, on lines of their own below it.
    if (after_error_ && text.front() == '\t') return void(++counters.other_records);
    CandumpLine line{};
    line.text = text;
    after_error_ = false;
    if (!line.read()) return leave_out(lines, line);
    after_error_ = line.is_error;
    if (line.is_error) return void(++counters.error_frames);
    const auto channel = builder_.channel(line.channel);
    if (!channel) {
      static_cast<void>(line.refuse_from(line.channel_at, "more than 32 interfaces in one log"));
      return leave_out(lines, line);
    }
    line.logged.channel = *channel;
    // Where all stamps are small, they can turn out to be gaps.
    if (line.stamp == StampKind::kSmall && builder_.added() == 0) builder_.hold_frames();
    ++stamps_[static_cast<std::size_t>(line.stamp)];
    if (const auto reason = builder_.add(line.logged))
      builder_.leave_out_line(lines.number(), line.at + 1, *reason);
  }

  void leave_out(const TextLines& lines, const TextLine& line) {
    builder_.leave_out_line(lines.number(), line.at + 1, line.what);
  }

  std::uint64_t& of(StampKind kind) { return stamps_[static_cast<std::size_t>(kind)]; }

  void finish_stamps() {
    if (of(StampKind::kNone) > 0)
      builder_.note("frames without a stamp: they are given the time 0, all at once");
    if (of(StampKind::kLocal) > 0)
      builder_.note("the stamps are local times of the recorder; they are taken as UTC");
    if (of(StampKind::kSmall) == 0) return;
    const std::uint64_t frames = builder_.added();
    const bool are_gaps = of(StampKind::kSmall) == frames &&
                          builder_.counters().backward_stamps * kGapsShare > frames;
    builder_.note(are_gaps ? "the stamps are gaps between frames (candump -td): time begins at 0"
                           : "the stamps are offsets (candump -tz): time begins at 0");
    if (!are_gaps) return;
    UtcTime now;
    for (LoggedFrame& logged : builder_.frames()) {
      now.ns = std::min(now.ns + logged.at.ns, kMaxStamp_ns);
      logged.at = now;
    }
    builder_.counters().backward_stamps = 0;
  }

  LogBuilder builder_;
  std::array<std::uint64_t, 4> stamps_{};  // frames of each StampKind
  bool after_error_ = false;
};

}  // namespace

Result<CanLog, Problem> read_candump(std::string_view text, std::string_view file_name,
                                     const LogWatch& watch) {
  return CandumpReader(file_name, watch, text.size()).read(text);
}

bool looks_like_candump(std::string_view text) {
  TextLine line{.text = text};
  line.skip_spaces();
  const bool has_stamp = line.peek() == '(';
  if (has_stamp) {
    const std::size_t end = text.find(')', line.at);
    if (end == std::string_view::npos) return false;
    line.at = end + 1;
  }
  if (line.word().empty()) return false;
  std::string_view id = line.word();
  if (id == "RX" || id == "TX") {
    line.word(), line.word();
    id = line.word();
  }
  const std::size_t digits = std::min(id.find_first_not_of("0123456789abcdefABCDEF"), id.size());
  if (digits != kStandardDigits && digits != kExtendedDigits) return false;
  if (digits < id.size()) return has_stamp && id[digits] == '#';
  const std::string_view length = line.word();
  return length.size() >= 3 && (length.front() == '[' || length.front() == '{');
}

}  // namespace pitwall::replay
