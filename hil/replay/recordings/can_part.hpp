// CAN frames of a recording as a CAN log, so that tools for logs also work on recordings.
//   in     a Recording; or the bytes of any file with CAN frames, a log or a recording
//   out    frames in the order of the recording; one channel for each CAN source, with its name if
//          that is short enough for an interface, else can0, can1, ..., with a note
//   errors Problem: a file that is neither, a recording without CAN frames or with more than
//          kMaxChannels sources of them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/formats/can_log.hpp"
#include "hil/replay/recordings/recording.hpp"
#include "protocol/transport/file_bytes.hpp"

namespace pitwall::traffic {

Result<replay::CanLog, Problem> can_part(const Recording& recording, const std::string& format,
                                         const std::string& name);

// True if the file is a recording of this folder and not a CAN log.
bool is_recording(std::string_view file);
Result<replay::CanLog, Problem> read_can_traffic(transport::FileBytes file, const std::string& name,
                                                 const replay::LogWatch& watch = {});

}  // namespace pitwall::traffic
