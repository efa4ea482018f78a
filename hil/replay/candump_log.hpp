// Logs in the format of `candump -l`, the one that every Linux team has:
//
//   (1398128223.803317) can0 166#D0320009          classic; 3 hex digits: standard id, 8: extended
//   (1398128223.803317123) can0 18DAF110#R8 T      9-digit stamp; remote; transmitted by the logger
//   (1398128223.803317) can0 123##1AABBCC          CAN FD: one digit of flags, then data
//
//   in     the whole text
//   out    frames in the order of the file, whatever their stamps; counters of what is no frame
//   units  stamps in nanoseconds on the calendar clock of the recording
//   errors Problem with file:line:column; nothing is returned of a malformed log. Only a last line
//          that was cut off (no line end, does not read) is skipped and counted: a recorder that
//          was stopped hard leaves one
//   source can-utils lib.c parse_canframe, candump.c
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

inline constexpr std::size_t kMaxChannels = 32;

enum class LoggedDirection : std::uint8_t { kUnknown, kReceived, kTransmitted };

struct LoggedFrame {
  UtcTime at;
  can::Frame frame;
  std::uint8_t channel = 0;   // index into CandumpLog::channels
  std::uint8_t fd_flags = 0;  // CANFD_BRS, CANFD_ESI as logged; 0 for classic frames
  LoggedDirection direction = LoggedDirection::kUnknown;

  bool operator==(const LoggedFrame&) const = default;
};

struct CandumpCounters {
  std::uint64_t drop_lines = 0;      // DROPCOUNT lines of the recorder
  std::uint64_t recorder_drops = 0;  // frames that the recorder itself lost, as these lines say
  std::uint64_t blank_lines = 0;
  std::uint64_t error_frames = 0;     // reports of a controller, not traffic: skipped
  std::uint64_t backward_stamps = 0;  // frames stamped earlier than the one before
  std::uint64_t cut_off_lines = 0;    // 0 or 1: the last one
};

struct CandumpLog {
  std::vector<std::string> channels;  // in order of first appearance
  std::vector<LoggedFrame> frames;
  CandumpCounters counters;
};

Result<CandumpLog, Problem> parse_candump_log(std::string_view text, std::string_view file_name);

// One line without its end, as candump -l writes it: a stamp of whole microseconds has 6 digits,
// any other 9; a direction that is known is said.
std::string to_candump_line(const LoggedFrame& frame, std::string_view channel);

}  // namespace pitwall::replay
