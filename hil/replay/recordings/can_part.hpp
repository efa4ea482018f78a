// The CAN frames of a recording as a CAN log, so that what works on logs works on recordings too.
//   in     a Recording; or the bytes of any file with CAN frames, a log or a recording
//   out    frames in the recording's order; a channel for each CAN source, by its name where that
//          is one that an interface can have, else can0, can1, ..., with a note
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

// Whether it is a recording of this folder and no CAN log.
bool is_recording(std::string_view file);
Result<replay::CanLog, Problem> read_can_traffic(transport::FileBytes file, const std::string& name,
                                                 const replay::LogWatch& watch = {});

}  // namespace pitwall::traffic
