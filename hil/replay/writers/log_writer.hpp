// Conversion of a CAN log into the file format that the suffix of the file name selects.
//
//   .log candump   .asc Vector ASC   .blf Vector BLF   .trc PEAK TRC 2.1
//   .pcap .pcapng SocketCAN captures; a further .gz compresses with gzip
//
//   in     a log that was read; the name of the output file
//   out    the bytes of that file, and a text for each property that the format cannot keep
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

// Channel numbers from 1 for formats without names: canN gets N+1, others get free numbers.
std::vector<unsigned> channel_numbers_of(const CanLog& log);

}  // namespace pitwall::replay
