// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/asc.hpp"

#include <algorithm>
#include <array>

#include "hil/replay/formats/calendar.hpp"
#include "hil/replay/formats/text_line.hpp"

namespace pitwall::replay {
namespace {

constexpr std::size_t kDecimal = 10, kHex = 16;
constexpr std::size_t kBytesOfEvent = 55;  // of a line, about, to reserve memory
constexpr std::uint64_t kMaxAscChannel = 255;
constexpr std::uint64_t kFlagExtendedLength = 1U << 12U;  // EDL: the frame is CAN FD
constexpr std::uint64_t kFlagRemote = 1U << 4U;
constexpr std::size_t kLeastFdTail = 3;  // duration, length in bits, flags
constexpr std::int64_t kHalfDay_ns = 12 * 3'600 * kNanosecondsPerSecond;

struct MonthName {
  std::string_view name;
  unsigned month;
};
constexpr std::array kMonthNames{
    MonthName{"jan", 1},   MonthName{"feb", 2},  MonthName{"mar", 3},  MonthName{"apr", 4},
    MonthName{"may", 5},   MonthName{"jun", 6},  MonthName{"jul", 7},  MonthName{"aug", 8},
    MonthName{"sep", 9},   MonthName{"oct", 10}, MonthName{"nov", 11}, MonthName{"dec", 12},
    MonthName{"mai", 5},   MonthName{"okt", 10}, MonthName{"dez", 12}, MonthName{"m\xC3\xA4r", 3},
    MonthName{"m\xE4r", 3}};

bool is_word(std::string_view word, std::string_view lower_word) {
  return word.size() == lower_word.size() && starts_with_word(word, lower_word);
}

bool is_number(std::string_view word, bool hex) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [&](char c) {
    return hex ? hex_value(c) >= 0 : is_digit(c);
  });
}

// "Sat Sep 30 15:06:13.191 2017", "Sat Sep 30 03:06:13.191 pm 2017"; the weekday is any word.
bool read_asc_date(TextLine& line, UtcTime& out) {
  constexpr const char* kExpected = "expected a date like Sat Sep 30 15:06:13.191 2017";
  line.word();
  const std::string_view month = line.word();
  const auto* const named =
      std::find_if(kMonthNames.begin(), kMonthNames.end(),
                   [&](const MonthName& m) { return is_word(month, m.name); });
  std::uint64_t day = 0, year = 0;
  std::int64_t of_day_ns = 0;
  line.skip_spaces();
  if (named == kMonthNames.end() || !read_unsigned(line, kDecimal, 31, day))
    return line.refuse(kExpected);
  line.skip_spaces();
  if (!read_time_of_day(line, of_day_ns)) return line.refuse(kExpected);
  const std::string_view half = line.next_word();
  if (is_word(half, "am") || is_word(half, "pm")) {
    line.word();
    if (of_day_ns >= kHalfDay_ns + 3'600 * kNanosecondsPerSecond) return line.refuse(kExpected);
    of_day_ns %= kHalfDay_ns;
    if (is_word(half, "pm")) of_day_ns += kHalfDay_ns;
  }
  line.skip_spaces();
  if (!read_unsigned(line, kDecimal, 9'999, year)) return line.refuse(kExpected);
  const auto utc = utc_of({.year = static_cast<std::int64_t>(year),
                           .month = named->month,
                           .day = static_cast<unsigned>(day)},
                          of_day_ns);
  if (!utc || !is_blank(line.text.substr(line.at))) return line.refuse(kExpected);
  out = *utc;
  return true;
}

enum class AscKind : std::uint8_t { kFrame, kError, kOther };

// What follows the stamp of one line.
struct AscEvent : TextLine {
  unsigned base = kHex;
  LoggedFrame logged{};
  std::uint64_t channel = 0;
  AscKind kind = AscKind::kOther;

  bool read() {
    const std::string_view first = next_word();
    if (first == "CANFD") return word(), read_fd();
    if (!is_number(first, false)) return read_other();
    skip_spaces();
    if (!read_unsigned(*this, kDecimal, kMaxAscChannel, channel)) return false;
    const std::string_view next = next_word();
    if (starts_with_word(next, "errorframe")) return kind = AscKind::kError, true;
    if (next == "Statistic:" || next == "J1939TP" || is_word(next, "overloadframe")) return true;
    kind = AscKind::kFrame;
    return read_classic();
  }

 private:
  // A word that says which event it is, known or not: as long as no frame hides in it.
  bool read_other() {
    skip_spaces();
    const std::size_t begin = at;
    while (!done()) {
      const std::string_view next = word();
      if (next == "Rx" || next == "Tx")
        return refuse_from(begin, "expected a channel or CANFD before a frame");
    }
    return true;
  }

  bool read_asc_id() {
    skip_spaces();
    std::uint64_t id = 0;
    const std::size_t begin = at;
    if (!read_unsigned(*this, base, UINT32_MAX, id))
      return refuse_from(begin, "expected an identifier");
    logged.frame.extended = lower(peek()) == 'x';
    if (logged.frame.extended) ++at;
    if (!at_space()) return refuse("expected a space after the identifier");
    if (id > (logged.frame.extended ? can::kMaxExtendedId : can::kMaxStandardId))
      return refuse_from(begin, "identifier out of range");
    logged.frame.id = static_cast<std::uint32_t>(id);
    return true;
  }

  bool read_asc_direction() {
    const std::string_view direction = word();
    if (direction == "TxRq") kind = AscKind::kOther;  // asked for, not sent
    if (direction == "Tx" || direction == "TxRq")
      logged.direction = LoggedDirection::kTransmitted;
    else if (direction == "Rx")
      logged.direction = LoggedDirection::kReceived;
    else
      return refuse("expected Rx, Tx or TxRq");
    return true;
  }

  bool read_classic() {
    if (!read_asc_id() || !read_asc_direction()) return false;
    const std::string_view type = word();
    if (is_word(type, "r")) return read_classic_remote();
    if (!is_word(type, "d")) return refuse("expected d or r before the length");
    std::uint64_t code = 0;
    skip_spaces();
    if (!read_unsigned(*this, base, 0xF, code)) return refuse("expected a length of 0 to 15");
    logged.frame.length =
        static_cast<std::uint8_t>(length_of_code(static_cast<unsigned>(code), false));
    return read_bytes() && read_attributes();
  }

  bool read_classic_remote() {
    logged.frame.remote = true;
    std::uint64_t code = 0;
    skip_spaces();
    if (hex_value(peek()) >= 0 && at + 1 <= text.size() && next_word().size() == 1) {
      if (!read_unsigned(*this, base, 0xF, code)) return false;
      logged.frame.length =
          static_cast<std::uint8_t>(length_of_code(static_cast<unsigned>(code), false));
    }
    return read_attributes();
  }

  bool read_bytes() {
    for (std::size_t i = 0; i < logged.frame.length; ++i) {
      if (!at_space()) return refuse("expected a space before a data byte");
      skip_spaces();
      const std::size_t begin = at;
      std::uint64_t byte = 0;
      if (!read_unsigned(*this, base, UINT8_MAX, byte) || at - begin > 3)
        return refuse_from(begin, "fewer data bytes than the length says");
      logged.frame.data[i] = static_cast<std::uint8_t>(byte);
    }
    return at_space() || refuse("expected a space after a data byte");
  }

  // "Length = 273910 BitCount = 141 ID = 418119424x"
  bool read_attributes() {
    for (skip_spaces(); !done(); skip_spaces()) {
      const std::size_t begin = at;
      const std::string_view name = word();
      if (name.size() < 3 && hex_value(name.front()) >= 0)
        return refuse_from(begin, "more data bytes than the length says");
      if (is_digit(name.front()) || word() != "=" || word().empty())
        return refuse_from(begin, "expected NAME = VALUE behind the data");
    }
    return true;
  }

  bool read_fd() {
    skip_spaces();
    if (!read_unsigned(*this, kDecimal, kMaxAscChannel, channel) || !at_space())
      return refuse("expected a channel after CANFD");
    kind = AscKind::kFrame;
    if (!read_asc_direction()) return false;
    if (starts_with_word(next_word(), "errorframe")) return kind = AscKind::kError, true;
    if (!read_asc_id()) return false;
    std::string_view rate = word();
    if (rate != "0" && rate != "1") rate = word();  // behind a symbolic name
    const std::string_view state = word();
    if ((rate != "0" && rate != "1") || (state != "0" && state != "1"))
      return refuse("expected 0 or 1 for BRS and for ESI");
    return read_fd_payload(rate == "1", state == "1");
  }

  bool read_fd_payload(bool rate_switch, bool error_state) {
    std::uint64_t code = 0, length = 0, flags = 0;
    skip_spaces();
    if (!read_unsigned(*this, base, 0xF, code)) return refuse("expected a length code of 0 to 15");
    if (!at_space()) return refuse("expected a space after the length code");
    skip_spaces();
    if (!read_unsigned(*this, kDecimal, can::kMaxDataBytes, length))
      return refuse("expected the number of data bytes");
    logged.frame.length = static_cast<std::uint8_t>(length);
    if (!read_bytes() || !read_fd_tail(flags)) return false;
    const bool is_remote = flags != 0 && (flags & kFlagRemote) != 0;
    if (is_remote && length > 0) return refuse("a remote frame has no data bytes");
    logged.frame.fd = flags == 0 || (flags & kFlagExtendedLength) != 0;
    logged.frame.remote = is_remote || (length == 0 && code > 0);
    if (logged.frame.remote) logged.frame.fd = false;
    const std::size_t by_code = length_of_code(static_cast<unsigned>(code), logged.frame.fd);
    if (logged.frame.remote)
      logged.frame.length = static_cast<std::uint8_t>(by_code);
    else if (by_code != length)
      return refuse("the length code is not that of the data bytes");
    if (logged.frame.fd)
      logged.fd_flags = static_cast<std::uint8_t>((rate_switch ? kFdBitRateSwitch : 0) |
                                                  (error_state ? kFdErrorState : 0));
    return true;
  }

  // Duration, length, flags, CRC and bit timings: nothing, or at least up to the flags.
  bool read_fd_tail(std::uint64_t& flags) {
    std::size_t words = 0;
    for (skip_spaces(); !done(); skip_spaces(), ++words) {
      const std::size_t begin = at;
      const std::string_view value = word();
      if (!is_number(value, true)) return refuse_from(begin, "expected a number behind the data");
      if (words != kLeastFdTail - 1) continue;
      TextLine number{.text = value};
      if (!read_unsigned(number, kHex, UINT32_MAX, flags))
        return refuse_from(begin, "expected the flags of the frame");
    }
    return words == 0 || words >= kLeastFdTail || refuse("expected duration, length and flags");
  }
};

class AscReader {
 public:
  AscReader(std::string_view file_name, const LogWatch& watch, std::size_t file_bytes)
      : builder_(kAscName, file_name, watch, file_bytes) {}

  Result<CanLog, Problem> read(std::string_view text) {
    builder_.expect(text.size() / kBytesOfEvent);
    TextLines lines(text);
    while (builder_.reach(lines.position()) && lines.next()) read_line(lines);
    if (!has_date_)
      builder_.note("there is no date in the log: time begins at 0");
    else
      builder_.note("the date is local time of the recorder; it is taken as UTC");
    if (!has_base_) builder_.note("there is no line \"base hex\" or \"base dec\": hex is taken");
    if (is_open_) builder_.note("there is no End TriggerBlock: the recording was not closed");
    return std::move(builder_).finish();
  }

 private:
  void read_line(const TextLines& lines) {
    const std::string_view text = lines.line();
    if (is_blank(text)) return void(++builder_.counters().blank_lines);
    const std::size_t start = text.find_first_not_of(" \t");
    const std::string_view content = text.substr(start);
    const bool is_end = starts_with_word(content, "end triggerblock");
    if (!lines.has_end() && !is_end) return builder_.cut_line(lines.number());
    if (content.starts_with("//")) return void(++builder_.counters().comments);
    TextLine line{.text = text, .at = start};
    const bool fits = is_digit(content.front()) ? read_event(line) : read_header(line, content);
    if (!fits) builder_.leave_out_line(lines.number(), line.at + 1, line.what);
  }

  bool read_header(TextLine& line, std::string_view content) {
    if (starts_with_word(content, "date ")) return line.word(), read_zero(line);
    if (starts_with_word(content, "begin triggerblock")) {
      is_open_ = true;
      line.word(), line.word();
      return is_blank(line.text.substr(line.at)) || read_zero(line);
    }
    if (starts_with_word(content, "end triggerblock")) return is_open_ = false, true;
    if (starts_with_word(content, "base ")) return read_base(line);
    const bool is_known = starts_with_word(content, "internal events logged") ||
                          starts_with_word(content, "no internal events logged");
    return is_known || line.refuse("expected a stamp, or a line of the header");
  }

  bool read_zero(TextLine& line) {
    UtcTime zero;
    if (!read_asc_date(line, zero)) return false;
    zero_ = zero;
    elapsed_ns_ = 0;
    return has_date_ = true;
  }

  bool read_base(TextLine& line) {
    constexpr const char* kExpected = "expected: base hex|dec  timestamps absolute|relative";
    line.word();
    const std::string_view base = line.word(), stamps = line.word(), kind = line.word();
    const bool fits =
        (is_word(base, "hex") || is_word(base, "dec")) &&
        (stamps.empty() || (is_word(stamps, "timestamps") &&
                            (is_word(kind, "absolute") || is_word(kind, "relative"))));
    if (!fits) return line.refuse(kExpected);
    base_ = is_word(base, "dec") ? kDecimal : kHex;
    is_relative_ = is_word(kind, "relative");
    return has_base_ = true;
  }

  bool read_event(TextLine& line) {
    std::int64_t stamp_ns = 0;
    const std::size_t begin = line.at;
    if (!read_decimal(line, kNanosecondsPerSecond, stamp_ns)) return false;
    if (line.text.substr(begin, line.at - begin).find_first_of(".,") == std::string_view::npos ||
        !line.at_space())
      return line.refuse_from(begin, "expected a stamp: seconds.fraction");
    const std::int64_t before_ns = is_relative_ ? elapsed_ns_ : 0;
    if (stamp_ns > kMaxStamp_ns - zero_.ns - before_ns)
      return line.refuse_from(begin, "stamp out of range");
    elapsed_ns_ = before_ns + stamp_ns;
    AscEvent event{line};
    event.base = base_;
    const bool fits = event.read() && enter(event);
    if (!fits) line.at = event.at, line.what = event.what;
    return fits;
  }

  bool enter(AscEvent& event) {
    if (event.kind == AscKind::kError) ++builder_.counters().error_frames;
    if (event.kind == AscKind::kOther) ++builder_.counters().other_records;
    if (event.kind != AscKind::kFrame) return true;
    const auto channel = builder_.numbered_channel(event.channel);
    if (!channel) return event.refuse_from(0, "channels are numbered from 1, and at most 32");
    event.logged.channel = *channel;
    event.logged.at = {zero_.ns + elapsed_ns_};
    const auto reason = builder_.add(event.logged);
    return !reason || event.refuse(reason->data());
  }

  LogBuilder builder_;
  unsigned base_ = kHex;
  UtcTime zero_{};
  std::int64_t elapsed_ns_ = 0;
  bool is_relative_ = false, has_date_ = false, has_base_ = false, is_open_ = false;
};

}  // namespace

Result<CanLog, Problem> read_asc(std::string_view text, std::string_view file_name,
                                 const LogWatch& watch) {
  return AscReader(file_name, watch, text.size()).read(text);
}

bool looks_like_asc(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t");
  if (start == std::string_view::npos) return false;
  TextLine line{.text = text.substr(start)};
  if (starts_with_word(line.text, "begin triggerblock") ||
      starts_with_word(line.text, "base hex") || starts_with_word(line.text, "base dec"))
    return true;
  std::int64_t stamp_ns = 0;
  if (!read_decimal(line, 1, stamp_ns) || !line.at_space()) return false;
  const std::string_view channel = line.word();
  if (channel == "CANFD") return true;
  if (!is_number(channel, false)) return false;
  const std::string_view id = line.word(), direction = line.word();
  return starts_with_word(id, "errorframe") || direction == "Rx" || direction == "Tx";
}

}  // namespace pitwall::replay
