// Recorded CAN log in memory, independent of the file format, and the builder that each reader
// fills.
//
//   in     frames in the order of the file; places of unreadable records
//   out    frames, names of channels, counters of everything else, and remarks: the place of each
//          record that was left out (line and column of a text, byte offset of a binary file)
//   units  stamps in nanoseconds on the calendar clock of the recording; 0 is 1970 if the file has
//          no date
//   invariants
//          every record of a file becomes a frame, is counted, or has a remark
//   errors LogBuilder::finish() returns a Problem if records were left out and nothing was read,
//          and if a CanLog reaches the caller's max_frames
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
  std::uint64_t bad_records = 0;    // unreadable lines or objects: left out, with a remark
  std::uint64_t cut_tails = 0;      // the last record, if it may be incomplete: left out
  std::uint64_t error_frames = 0;   // error reports of a controller, not traffic
  std::uint64_t other_records = 0;  // well-formed records other than CAN frames: events, statistics
  std::uint64_t comments = 0;       // comment lines
  std::uint64_t blank_lines = 0;
  std::uint64_t drop_lines = 0;       // DROPCOUNT lines of candump
  std::uint64_t recorder_drops = 0;   // frames that the recorder reports as lost
  std::uint64_t backward_stamps = 0;  // frames with an earlier stamp than the one before

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
  std::vector<LogRemark> remarks;      // for the first kListedRemarks records that were left out
  std::uint64_t remarks_left_off = 0;  // remarks beyond kListedRemarks
  std::vector<std::string> notes;      // how the whole file was interpreted
};

// Messages for the user about a log, one line each; empty if there are none.
std::string to_text(const CanLog& log, std::string_view file_name);

// True for a permitted data length of CAN FD.
constexpr bool is_fd_length(std::size_t n) {
  return n <= 8 || n == 12 || n == 16 || n == 20 || n == 24 || n == 32 || n == 48 || n == 64;
}
// Data length of a data length code; 9 to 15 mean 8 bytes in a classic frame.
std::size_t length_of_code(unsigned code, bool fd);
// Smallest data length code for this many bytes.
unsigned code_of_length(std::size_t length);

class LogBuilder {
 public:
  LogBuilder(std::string_view format, std::string_view file_name, const LogWatch& watch = {},
             std::size_t file_bytes = 0);

  // To be called before each record is read: reports the progress to the watch. Returns false if no
  // further frame is allowed; finish() then returns a Problem.
  bool reach(std::size_t byte) {
    if (byte >= next_report_) report(byte);
    return log_.frames.size() < watch_.max_frames;
  }
  // Reserves memory for about this many frames.
  void expect(std::size_t frames);
  // Stops the delivery of blocks: later records may still change the frames.
  void hold_frames() { is_holding_ = true; }
  // The index of a channel; nullopt if its name is too long or there are too many channels.
  std::optional<std::uint8_t> channel(std::string_view name);
  // Channels numbered from 1 become can0 and up, as in python-can and can-utils.
  std::optional<std::uint8_t> numbered_channel(std::uint64_t number);
  // Adds a frame. Returns nullopt, or the reason why it is not a valid CAN frame and was not added.
  std::optional<std::string_view> add(const LoggedFrame& logged);

  void leave_out_line(std::size_t line, std::size_t column, std::string_view what);
  void leave_out_byte(std::size_t offset, std::string_view what);
  void cut_line(std::size_t line);
  void cut_byte(std::size_t offset, std::string_view what);
  void note(std::string_view text);  // added only once

  LogCounters& counters() { return log_.counters; }
  std::uint64_t added() const { return added_; }
  std::vector<LoggedFrame>& frames() { return log_.frames; }  // without frames of earlier blocks
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
