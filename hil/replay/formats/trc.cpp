// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/trc.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/replay/formats/calendar.hpp"
#include "hil/replay/formats/text_line.hpp"

namespace pitwall::replay {
namespace {

constexpr std::uint64_t kMaxTrcBus = 255;
constexpr std::size_t kMostStandardDigits = 4, kMostDigits = 8;
constexpr std::uint64_t kBusInformation = 0xFFFFFFFF;  // the identifier of such rows
constexpr std::uint64_t kMaxDays = 129'735;            // the year 2255, with kMaxStamp_ns

// Columns by their letters in $COLUMNS: N number, O offset, T type, B bus, I identifier,
// d direction, R reserved, l bytes of data, L length code, D data.
struct TrcVersion {
  std::string_view name, columns;
};
constexpr std::array kTrcVersions{TrcVersion{"1.0", "NOIlD"},   TrcVersion{"1.1", "NOTIlD"},
                                  TrcVersion{"1.2", "NOBTIlD"}, TrcVersion{"1.3", "NOBTIRlD"},
                                  TrcVersion{"2.0", "NOTIdlD"}, TrcVersion{"2.1", "NOTBIdRLD"}};

constexpr std::string_view kTrcColumns = "NOTBIdRlLD";
constexpr std::string_view kNeededTrcColumns = "OTID";  // and a length

enum class TrcKind : std::uint8_t { kFrame, kError, kOther };

struct TrcType {
  std::string_view name;
  TrcKind kind = TrcKind::kFrame;
  bool fd = false, remote = false;
  std::uint8_t fd_flags = 0;
  LoggedDirection direction = LoggedDirection::kUnknown;
};
constexpr std::array kTrcTypes{
    TrcType{.name = "Rx", .direction = LoggedDirection::kReceived},
    TrcType{.name = "Tx", .direction = LoggedDirection::kTransmitted},
    TrcType{.name = "DT"},
    TrcType{.name = "RR", .remote = true},
    TrcType{.name = "FD", .fd = true},
    TrcType{.name = "FB", .fd = true, .fd_flags = kFdBitRateSwitch},
    TrcType{.name = "FE", .fd = true, .fd_flags = kFdErrorState},
    TrcType{.name = "BI", .fd = true, .fd_flags = kFdBitRateSwitch | kFdErrorState},
    TrcType{.name = "Error", .kind = TrcKind::kError},
    TrcType{.name = "ER", .kind = TrcKind::kError},
    TrcType{.name = "Warng", .kind = TrcKind::kOther},
    TrcType{.name = "ST", .kind = TrcKind::kOther},
    TrcType{.name = "EC", .kind = TrcKind::kOther},
    TrcType{.name = "EV", .kind = TrcKind::kOther},
};

// One row, column by column.
struct TrcRow : TextLine {
  bool is_old = true;  // 1.x: the number has a bracket, a remote frame is RTR in place of its data
  LoggedFrame logged{};
  std::uint64_t bus = 1;
  TrcKind kind = TrcKind::kFrame;

  bool read(std::string_view columns) {
    for (const char column : columns) {
      skip_spaces();
      if (!read_column(column)) return false;
      if (column != 'D' && !at_space()) return refuse("expected a space after the column");
      if (kind != TrcKind::kFrame) return true;
    }
    skip_spaces();
    return done() || refuse("more data bytes than the length says");
  }

 private:
  bool read_column(char column) {
    std::uint64_t number = 0;
    switch (column) {
      case 'N':
        return read_unsigned(*this, 10, UINT32_MAX, number) &&
               (!is_old || take(')', "expected ')' after the number of the row"));
      case 'O':
        return read_decimal(*this, kNanosecondsPerMillisecond, logged.at.ns);
      case 'T':
        return read_type();
      case 'B':
        if (peek() == '-') return ++at, true;
        return read_unsigned(*this, 10, kMaxTrcBus, bus);
      case 'I':
        return read_trc_id();
      case 'd':
        return read_trc_direction();
      case 'l':
      case 'L':
        return read_trc_length(column == 'L');
      case 'D':
        return read_trc_data();
      default:  // R
        return !word().empty() || refuse("expected one more column");
    }
  }

  bool read_type() {
    const std::size_t begin = at;
    const std::string_view name = word();
    const auto* const type = std::find_if(kTrcTypes.begin(), kTrcTypes.end(),
                                          [&](const TrcType& t) { return t.name == name; });
    if (type == kTrcTypes.end())
      return refuse_from(begin, "expected the type of the row: Rx, DT..");
    kind = type->kind;
    logged.frame.fd = type->fd;
    logged.frame.remote = type->remote;
    logged.fd_flags = type->fd_flags;
    logged.direction = type->direction;
    return true;
  }

  bool read_trc_id() {
    const std::size_t begin = at;
    std::uint64_t id = 0;
    if (peek() == '-' && (kind != TrcKind::kFrame)) return ++at, true;
    if (!read_unsigned(*this, 16, UINT32_MAX, id)) return refuse("expected an identifier");
    const std::size_t digits = at - begin;
    if (is_old && id == kBusInformation) return kind = TrcKind::kOther, true;
    logged.frame.extended = digits > kMostStandardDigits;
    if (digits > kMostDigits ||
        id > (logged.frame.extended ? can::kMaxExtendedId : can::kMaxStandardId))
      return refuse_from(begin, "identifier out of range");
    logged.frame.id = static_cast<std::uint32_t>(id);
    return true;
  }

  bool read_trc_direction() {
    const std::string_view direction = word();
    if (direction == "Rx")
      logged.direction = LoggedDirection::kReceived;
    else if (direction == "Tx")
      logged.direction = LoggedDirection::kTransmitted;
    else
      return refuse("expected Rx or Tx");
    return true;
  }

  bool read_trc_length(bool is_code) {
    std::uint64_t length = 0;
    const std::uint64_t most = is_code ? 0xF : logged.frame.fd ? can::kMaxDataBytes : 8;
    if (!read_unsigned(*this, 10, most, length)) return refuse("expected the length of the data");
    if (is_code) length = length_of_code(static_cast<unsigned>(length), logged.frame.fd);
    logged.frame.length = static_cast<std::uint8_t>(length);
    return true;
  }

  bool read_trc_data() {
    if (is_old && next_word() == "RTR") return word(), logged.frame.remote = true;
    if (logged.frame.remote) return true;
    for (std::size_t i = 0; i < logged.frame.length; ++i) {
      skip_spaces();
      if (!read_hex_byte(*this, logged.frame.data[i], "fewer data bytes than the length says"))
        return false;
      if (!at_space()) return refuse("expected a space after a data byte");
    }
    return true;
  }
};

class TrcReader {
 public:
  TrcReader(std::string_view file_name, const LogWatch& watch, std::size_t file_bytes)
      : builder_(kTrcName, file_name, watch, file_bytes) {}

  Result<CanLog, Problem> read(std::string_view text) {
    TextLines lines(text);
    while (builder_.reach(lines.position()) && lines.next()) read_line(lines);
    builder_.note(zero_ns_ == 0
                      ? "there is no start time in the log: time begins at 0"
                      : "the start time is local time of the recorder; it is taken as UTC");
    return std::move(builder_).finish();
  }

 private:
  void read_line(const TextLines& lines) {
    const std::string_view text = lines.line();
    LogCounters& counters = builder_.counters();
    if (is_blank(text)) return void(++counters.blank_lines);
    if (!lines.has_end()) return builder_.cut_line(lines.number());
    TextLine line{.text = text};
    line.skip_spaces();
    const bool is_comment = line.peek() == ';';
    bool fits = true;
    if (is_comment)
      fits = read_comment(line);
    else
      fits = read_row(line);
    if (!fits)
      builder_.leave_out_line(lines.number(), line.at + 1, line.what);
    else if (is_comment)
      ++counters.comments;
  }

  bool read_comment(TextLine& line) {
    const std::string_view text = line.text.substr(line.at);
    if (text.starts_with(";$FILEVERSION=")) return read_version(line, text.substr(14));
    if (text.starts_with(";$STARTTIME=")) return line.at += 12, read_start(line);
    if (text.starts_with(";$COLUMNS=")) return read_columns(line, text.substr(10));
    constexpr std::string_view kStart = "Start time:";
    const std::size_t at = line.text.find(kStart);
    if (at == std::string_view::npos || zero_ns_ != 0) return true;
    line.at = at + kStart.size();
    static_cast<void>(read_start_comment(line));  // a comment only: nobody has to write it so
    return true;
  }

  bool read_version(TextLine& line, std::string_view name) {
    while (name.ends_with(' ')) name.remove_suffix(1);
    const auto* const version = std::find_if(kTrcVersions.begin(), kTrcVersions.end(),
                                             [&](const TrcVersion& v) { return v.name == name; });
    if (version == kTrcVersions.end())
      return line.refuse("expected a version of 1.0, 1.1, 1.2, 1.3, 2.0 or 2.1");
    columns_ = version->columns;
    is_old_ = name.front() == '1';
    return true;
  }

  // What is in no column that is read would be lost in silence.
  bool read_columns(TextLine& line, std::string_view list) {
    constexpr const char* kExpected = "expected columns of N,O,T,B,I,d,R,L,D or l, each once";
    std::string columns;
    for (const char c : list) {
      if (c == ',' || c == ' ' || c == '\t') continue;
      const bool is_length = lower(c) == 'l';
      const bool is_there = columns.find(c) != std::string::npos ||
                            (is_length && columns.find_first_of("lL") != std::string::npos);
      if (is_there || kTrcColumns.find(c) == std::string_view::npos) return line.refuse(kExpected);
      columns += c;
    }
    for (const char needed : kNeededTrcColumns)
      if (columns.find(needed) == std::string::npos) return line.refuse(kExpected);
    if (columns.find_first_of("lL") == std::string::npos) return line.refuse(kExpected);
    columns_ = columns;
    return true;
  }

  // Days as a decimal number with 10 places and more: beyond what a stamp in nanoseconds has.
  bool read_start(TextLine& line) {
    std::uint64_t days = 0;
    if (!read_unsigned(line, 10, kMaxDays, days)) return line.refuse("expected days since 1899");
    long double part = 0.0L, scale = 1.0L;
    if (line.peek() == '.' || line.peek() == ',')
      for (++line.at; is_digit(line.peek()); ++line.at)
        part += static_cast<long double>(line.peek() - '0') * (scale /= 10.0L);
    if (!is_blank(line.text.substr(line.at)) || static_cast<std::int64_t>(days) < kTrcDaysTo1970)
      return line.refuse("expected days since 1899, after 1970");
    constexpr std::int64_t kDay_ns = kSecondsPerDay * kNanosecondsPerSecond;
    zero_ns_ = (static_cast<std::int64_t>(days) - kTrcDaysTo1970) * kDay_ns +
               static_cast<std::int64_t>(std::llround(part * static_cast<long double>(kDay_ns)));
    return true;
  }

  // "18.12.2021 14:28:07.062.0"
  bool read_start_comment(TextLine& line) {
    std::uint64_t day = 0, month = 0, year = 0;
    std::int64_t of_day_ns = 0;
    line.skip_spaces();
    const bool fits = read_unsigned(line, 10, 31, day) && line.take('.', "") &&
                      read_unsigned(line, 10, 12, month) && line.take('.', "") &&
                      read_unsigned(line, 10, 9'999, year) && line.take(' ', "") &&
                      read_time_of_day(line, of_day_ns);
    if (!fits) return false;
    const auto utc = utc_of({.year = static_cast<std::int64_t>(year),
                             .month = static_cast<unsigned>(month),
                             .day = static_cast<unsigned>(day)},
                            of_day_ns);
    if (utc) zero_ns_ = utc->ns;
    return utc.has_value();
  }

  bool read_row(TextLine& line) {
    TrcRow row{line};
    row.is_old = is_old_;
    const bool fits = row.read(columns_) && enter(row);
    if (!fits) line.at = row.at, line.what = row.what;
    return fits;
  }

  bool enter(TrcRow& row) {
    if (row.kind == TrcKind::kError) ++builder_.counters().error_frames;
    if (row.kind == TrcKind::kOther) ++builder_.counters().other_records;
    if (row.kind != TrcKind::kFrame) return true;
    const auto channel = builder_.numbered_channel(row.bus);
    if (!channel) return row.refuse_from(0, "buses are numbered from 1, and at most 32");
    row.logged.channel = *channel;
    if (row.logged.at.ns > kMaxStamp_ns - zero_ns_) return row.refuse("stamp out of range");
    row.logged.at.ns += zero_ns_;
    const auto reason = builder_.add(row.logged);
    return !reason || row.refuse(reason->data());
  }

  LogBuilder builder_;
  std::string columns_{kTrcVersions[0].columns};
  std::int64_t zero_ns_ = 0;
  bool is_old_ = true;
};

}  // namespace

Result<CanLog, Problem> read_trc(std::string_view text, std::string_view file_name,
                                 const LogWatch& watch) {
  return TrcReader(file_name, watch, text.size()).read(text);
}

bool looks_like_trc(std::string_view text) {
  TextLine line{.text = text};
  line.skip_spaces();
  const std::string_view content = text.substr(line.at);
  if (content.starts_with(";$FILEVERSION=") || content.starts_with(";$STARTTIME=")) return true;
  std::uint64_t number = 0;
  std::int64_t offset_ns = 0;
  if (!read_unsigned(line, 10, UINT32_MAX, number)) return false;
  const bool has_bracket = line.peek() == ')';
  if (has_bracket) ++line.at;
  line.skip_spaces();
  if (!read_decimal(line, kNanosecondsPerMillisecond, offset_ns)) return false;
  const std::string_view type = line.word();
  return has_bracket ||
         (type.size() == 2 && std::any_of(kTrcTypes.begin(), kTrcTypes.end(),
                                          [&](const TrcType& t) { return t.name == type; }));
}

}  // namespace pitwall::replay
