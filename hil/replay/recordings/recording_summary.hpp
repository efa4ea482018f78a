// Summary of a recording: each source with its kind, rate and longest gap, and what was left out.
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
  const Source* source = nullptr;  // points into the recording
  std::uint64_t bytes = 0;
  Duration longest_gap{};

  double rate_hz() const;  // 0 for a single record
};

struct RecordingSummary {
  std::vector<SourceRow> rows;  // in the order of the sources
};

// The result refers to the recording, which must outlive it.
RecordingSummary summary_of(const Recording& recording);
std::string to_text(const RecordingSummary& summary, const Recording& recording,
                    const std::string& format, const std::string& name);
// Remarks, one per line; empty if nothing was left out.
std::string remarks_of(const Recording& recording);
std::string to_json(const RecordingSummary& summary, const Recording& recording,
                    const std::string& format, const std::string& name);

}  // namespace pitwall::traffic
