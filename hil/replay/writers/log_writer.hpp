// A CAN log as a file of another format, which its name asks for.
//
//   .log candump   .asc Vector ASC   .blf Vector BLF   .trc PEAK TRC 2.1
//   .pcap .pcapng SocketCAN captures; .gz behind any of them: packed by gzip
//
//   in     a log that was read; the name of the file to be
//   out    its bytes, and what the format cannot keep, in words
//   errors Problem: another suffix, or stamps that the format cannot hold
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline constexpr std::string_view kWrittenSuffixes =
    ".log (candump), .asc, .blf, .trc, .pcap or .pcapng, each also with .gz behind it";

struct WrittenLog {
  std::string bytes;
  std::vector<std::string> losses;
};

Result<WrittenLog, Problem> write_can_log(const CanLog& log, std::string_view file_name);

// Numbers from 1 for formats without names: canN has N+1, others what is left.
std::vector<unsigned> channel_numbers_of(const CanLog& log);

}  // namespace pitwall::replay
