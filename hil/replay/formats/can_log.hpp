// A recorded CAN log in memory, whatever file it came from, and the builder that each reader fills.
//
//   in     frames in the order of the file; places of records that do not read
//   out    frames, names of channels, counters of all that is no frame, and remarks: the place of
//          each record that was left out (line and column of a text, byte offset of a binary file)
//   units  stamps in nanoseconds on the calendar clock of the recording; 0 is 1970 where the file
//          has no date
//   invariants
//          whatever a file holds is a frame, is counted, or is told in a remark
//   errors LogBuilder::finish() is a Problem where records were left out and nothing was read, and
//          where there are more frames than the caller's watch allows
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hil/replay/formats/log_watch.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

inline constexpr std::size_t kMaxChannels = 32;
inline constexpr std::size_t kMaxChannelName = 15;  // IFNAMSIZ - 1
inline constexpr std::size_t kListedRemarks = 20;
// Stamps are from 1970 to the year 2255; sums and differences of two fit into int64.
inline constexpr std::int64_t kMaxStamp_ns = 9'000'000'000 * kNanosecondsPerSecond;

enum class LoggedDirection : std::uint8_t { kUnknown, kReceived, kTransmitted };

inline constexpr std::uint8_t kFdBitRateSwitch = 0x01;  // CANFD_BRS
inline constexpr std::uint8_t kFdErrorState = 0x02;     // CANFD_ESI

struct LoggedFrame {
  UtcTime at;
  can::Frame frame;
  std::uint8_t channel = 0;   // index into CanLog::channels
  std::uint8_t fd_flags = 0;  // CANFD_BRS, CANFD_ESI as logged; 0 for classic frames
  LoggedDirection direction = LoggedDirection::kUnknown;

  bool operator==(const LoggedFrame&) const = default;
};

struct LogCounters {
  std::uint64_t bad_records = 0;    // lines or objects that do not read: left out, with a remark
  std::uint64_t cut_tails = 0;      // the last record, where it may not be whole: left out
  std::uint64_t error_frames = 0;   // reports of a controller, not traffic
  std::uint64_t other_records = 0;  // what is well-formed and no CAN frame: events, statistics
  std::uint64_t comments = 0;       // lines
  std::uint64_t blank_lines = 0;
  std::uint64_t drop_lines = 0;       // DROPCOUNT lines of candump
  std::uint64_t recorder_drops = 0;   // frames that the recorder itself lost, as it says
  std::uint64_t backward_stamps = 0;  // frames stamped earlier than the one before

  bool operator==(const LogCounters&) const = default;
};

struct LogRemark {
  std::string place, what;
};

struct CanLog {
  std::string format;                 // "candump", "Vector ASC", ...
  std::vector<std::string> channels;  // in order of first appearance
  std::vector<LoggedFrame> frames;
  LogCounters counters;
  std::vector<LogRemark> remarks;      // on the first kListedRemarks records that were left out
  std::uint64_t remarks_left_off = 0;  // on further ones
  std::vector<std::string> notes;      // how the file as a whole was understood
};

// All that a user has to be told of a log, one line each; empty for a clean one.
std::string to_text(const CanLog& log, std::string_view file_name);

// Lengths that a CAN FD frame can have.
constexpr bool is_fd_length(std::size_t n) {
  return n <= 8 || n == 12 || n == 16 || n == 20 || n == 24 || n == 32 || n == 48 || n == 64;
}
// Bytes of data by the data length code; 9 to 15 are 8 bytes in a classic frame.
std::size_t length_of_code(unsigned code, bool fd);
// The least code for so many bytes.
unsigned code_of_length(std::size_t length);

class LogBuilder {
 public:
  LogBuilder(std::string_view format, std::string_view file_name, const LogWatch& watch = {},
             std::size_t file_bytes = 0);

  // For each record, before it is read: tells the watch how far the file has been read. False: no
  // more fits, and finish() says so.
  bool reach(std::size_t byte) {
    if (byte >= next_report_) report(byte);
    return log_.frames.size() < watch_.max_frames;
  }
  // About so many frames are to come: memory for them.
  void expect(std::size_t frames);
  // No blocks from now on: what is still to come can change the frames.
  void hold_frames() { is_holding_ = true; }
  // The index of a channel; nothing if its name is too long or there are too many of them.
  std::optional<std::uint8_t> channel(std::string_view name);
  // Channels that a format numbers from 1 are can0 and up, as python-can and can-utils have it.
  std::optional<std::uint8_t> numbered_channel(std::uint64_t number);
  // Nothing, or why it is no CAN frame; then it has not been added.
  std::optional<std::string_view> add(const LoggedFrame& logged);

  void leave_out_line(std::size_t line, std::size_t column, std::string_view what);
  void leave_out_byte(std::size_t offset, std::string_view what);
  void cut_line(std::size_t line);
  void cut_byte(std::size_t offset, std::string_view what);
  void note(std::string_view text);  // once, however often it is said

  LogCounters& counters() { return log_.counters; }
  std::uint64_t added() const { return added_; }
  std::vector<LoggedFrame>& frames() { return log_.frames; }  // without those of earlier blocks
  Result<CanLog, Problem> finish() &&;

 private:
  void remark(std::string place, std::string_view what);
  void report(std::size_t byte);

  std::string file_;
  LogWatch watch_;
  std::size_t file_bytes_ = 0, next_report_ = SIZE_MAX;
  std::uint64_t added_ = 0;
  UtcTime last_at_{};
  bool is_holding_ = false;
  std::uint8_t last_channel_ = 0;
  CanLog log_;
};

}  // namespace pitwall::replay
