// Builder of a Recording: readers and CAN logs add sources and records in the order of their file.
//   in     sources; records with their stamp and their byte offset in the file; what is left out
//          and why; an optional callback for the progress of the reading
//   out    finish(): the recording, in total order
//   invariants
//          refusals and remarks of the same kind become one remark with a count, at the first place
//   errors a record with a stamp before 1970 or after kLatestStamp is refused with a remark
//   cost   O(1) per record; finish() sorts, O(n) if the stamps are already ascending
//
//   RecordingBuilder builder{"can0.log"};
//   const auto can0 = builder.add_source("can0", SourceKind::kCan, "can");
//   for (const LoggedFrame& logged : log.frames) builder.add(can0, logged.at, logged.frame, byte);
//   Recording recording = std::move(builder).finish();
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "hil/replay/formats/log_watch.hpp"
#include "hil/replay/recordings/recording.hpp"

namespace pitwall::traffic {

// In the year 2191: stamps can be moved by 63 years in both directions without an overflow.
inline constexpr UtcTime kLatestStamp{7'000'000'000 * kNanosecondsPerSecond};

class RecordingBuilder {
 public:
  explicit RecordingBuilder(std::string file, replay::ReadProgress reached = {},
                            std::size_t file_bytes = 0)
      : file_(std::move(file)), reached_(std::move(reached)), file_bytes_(file_bytes) {}

  std::uint32_t add_source(std::string name, SourceKind kind, std::string type);
  bool add(std::uint32_t source, UtcTime at, const can::Frame& frame, std::uint64_t byte);
  // `bytes` are in pool().
  bool add(std::uint32_t source, UtcTime at, Bytes bytes, std::uint64_t byte);

  void remark(std::uint64_t byte, std::string_view what, std::uint64_t times = 1);
  // For files without byte offsets: `where` is "run.db3: message 17".
  void remark_at(std::string_view where, std::string_view what, std::uint64_t times = 1);
  // Counts a message that is left out, and adds a remark.
  void refuse(std::uint64_t byte, std::string_view what);

  BytePool& pool() { return recording_.pool; }
  RecordingCounters& counters() { return recording_.counters; }
  std::vector<Source>& sources() { return recording_.sources; }
  // The bytes of the first records of a source in sequence, up to `most` bytes.
  std::string first_bytes(std::uint32_t source, std::size_t most) const;

  Recording finish() &&;

 private:
  bool put(std::uint32_t source, UtcTime at, std::variant<Bytes, can::Frame> content,
           std::uint64_t byte);

  std::string file_;
  replay::ReadProgress reached_;
  std::size_t file_bytes_ = 0, next_report_ = 0;
  Recording recording_;
  std::vector<UtcTime> latest_;  // newest stamp so far of each source
  // Index of each remark, by its text.
  std::map<std::string, std::size_t, std::less<>> remarks_;
};

// Sorts into total order.
void sort(std::vector<Record>& records);

}  // namespace pitwall::traffic
