// What a recorded file is, by its content and never by its name.
//   in     the beginning of a file, or all of it
//   out    a FileFormat; its name, as a message says it ("a Vector BLF log")
//   invariants
//          a magic number at the beginning decides; without one, the format that most of the first
//          lines look like
//   errors none: what nobody knows is kUnknownText or kUnknownBinary
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
  kGzip,  // of any of them
  // Recordings of more than CAN.
  kMcap,
  kLcm,
  kSqlite,     // a ROS 2 bag, among others
  kNovatel,    // a receiver's byte stream
  kVectorNav,  // likewise
  // What is known by name only.
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
// What a user can do with a file of this format, as a sentence; empty: nothing is known.
std::string_view advice_on(FileFormat format);
// The CAN logs that are read, for messages.
std::string_view formats_that_are_read();

}  // namespace pitwall::replay
