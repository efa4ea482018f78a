// Summary of a CAN log: time span, channels, and for each identifier its count and regularity.
//   in     CanLog, or its frames in blocks
//   out    one row for each channel and identifier, in this order; as text or as one JSON object
//   units  frames per second; gaps between two frames of a row in nanoseconds, negative if a stamp
//          decreases; calendar time in UTC
//   invariants
//          the counts of all rows add up to the number of frames of the log
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

struct IdRow {
  std::uint8_t channel = 0;
  std::uint32_t id = 0;
  bool extended = false;
  std::uint64_t count = 0;
  std::uint8_t least_length = 0, most_length = 0;
  UtcTime first{}, last{};  // in the order of the log
  Duration least_gap{INT64_MAX}, most_gap{INT64_MIN};

  // Frames per second between the first and the last one; 0 for a single frame.
  double rate_hz() const;
};

struct LogSummary {
  UtcTime first{}, last{};  // the earliest and the latest stamp
  std::uint64_t frames = 0;
  std::vector<std::uint64_t> frames_of_channel;  // one per channel
  std::uint64_t extended = 0, remote = 0, fd = 0, sent = 0, received = 0;
  std::vector<IdRow> rows;
};

// Memory grows with the identifiers, not with the frames.
class LogSummaryBuilder {
 public:
  void add(std::span<const LoggedFrame> frames);
  LogSummary finish(std::size_t channels) &&;

 private:
  LogSummary summary_;
  std::unordered_map<std::uint64_t, std::size_t> rows_;  // by channel and identifier
};

LogSummary summary_of(const CanLog& log);
// The frames in `log` itself are not used: they may have been taken in blocks.
std::string to_text(const LogSummary& summary, const CanLog& log, std::string_view file_name);
std::string to_json(const LogSummary& summary, const CanLog& log, std::string_view file_name);

}  // namespace pitwall::replay
