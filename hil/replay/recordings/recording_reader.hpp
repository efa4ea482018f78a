// Reader of any recording with sensor traffic; it detects the format by the content.
//   in     the whole file, also compressed as a whole by rosbag2 (.mcap.zstd, .db3.zstd); its name
//   out    the recording from the reader of its format
//   errors Problem for a file of another format; it lists the formats that are supported
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hil/replay/formats/log_watch.hpp"
#include "hil/replay/recordings/recording.hpp"
#include "protocol/transport/file_bytes.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

enum class RecordingFormat : std::uint8_t { kNone, kMcap, kSqliteBag, kLcm, kReceiver };
std::string_view to_string(RecordingFormat format);

// Expects decompressed bytes.
RecordingFormat format_of(Bytes file);

Result<Recording, Problem> read_recording(transport::FileBytes file, const std::string& name,
                                          const replay::ReadProgress& reached = {});

}  // namespace pitwall::traffic
