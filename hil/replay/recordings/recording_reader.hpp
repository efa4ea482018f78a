// Reader of any recording with sensor traffic, recognised by its content.
//   in     the whole file, also compressed as a whole by rosbag2 (.mcap.zstd, .db3.zstd); its name
//   out    what the reader of its format gives
//   errors Problem for a file of none of these formats, with what is read
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

// Of the bytes as they are after decompression.
RecordingFormat format_of(Bytes file);

Result<Recording, Problem> read_recording(transport::FileBytes file, const std::string& name,
                                          const replay::ReadProgress& reached = {});

}  // namespace pitwall::traffic
