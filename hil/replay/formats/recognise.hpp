// Recognition of the format of a recorded file by its content, never by its name.
//   in     the beginning of a file, or all of it
//   out    a FileFormat; its name as messages use it ("a Vector BLF log")
//   invariants
//          a magic number at the beginning decides; without one, the format that most of the first
//          lines look like
//   errors none: an unknown format is kUnknownText or kUnknownBinary
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace pitwall::replay {

enum class FileFormat : unsigned char {
  // Logs of CAN frames that read_can_log() reads.
  kCandump,
  kAsc,
  kBlf,
  kTrc,
  kPcap,
  kPcapng,
  kGzip,  // of any of these formats
  // Recordings of more than CAN.
  kMcap,
  kLcm,
  kSqlite,     // a ROS 2 bag, among others
  kNovatel,    // byte stream of a receiver
  kVectorNav,  // byte stream of a receiver
  // Recognised, but not readable.
  kMf4,
  kMdf3,
  kRosbag1,
  kBusmaster,
  kCsv,
  kHtml,
  kXml,
  kJson,
  kUtf16,
  kZip,
  kZstd,
  kBzip2,
  kXz,
  kLz4,
  kElf,
  kPdf,
  kDbc,
  kEmpty,
  kUnknownText,
  kUnknownBinary,
};

FileFormat recognise(std::string_view bytes);

std::string_view name_of(FileFormat format);
// Advice for the user of a file of this format, as a sentence; empty: none.
std::string_view advice_on(FileFormat format);
// The readable formats of CAN logs, for messages.
std::string_view formats_that_are_read();

}  // namespace pitwall::replay
