// What a recording holds: each source with its kind, rate and longest silence, and what was left
// out of it.
//   in     a Recording, its name and format
//   out    text for a person; one JSON object
//   units  seconds, records a second; calendar time in UTC
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/replay/recordings/recording.hpp"

namespace pitwall::traffic {

struct SourceRow {
  const Source* source = nullptr;  // of the recording
  std::uint64_t bytes = 0;
  Duration longest_gap{};

  double rate_hz() const;  // 0 of a single record
};

struct RecordingSummary {
  std::vector<SourceRow> rows;  // in the order of the sources
};

// Refers to the recording.
RecordingSummary summary_of(const Recording& recording);
std::string to_text(const RecordingSummary& summary, const Recording& recording,
                    const std::string& format, const std::string& name);
// Remarks, a line each; empty: nothing was left out.
std::string remarks_of(const Recording& recording);
std::string to_json(const RecordingSummary& summary, const Recording& recording,
                    const std::string& format, const std::string& name);

}  // namespace pitwall::traffic
