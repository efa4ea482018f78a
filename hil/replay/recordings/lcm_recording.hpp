// Reader of LCM event logs, as lcm-logger and our own recorder write them.
//   in     the whole file; its name for remarks
//   out    one source per channel. Messages of our recorder's types, known by the fingerprint that
//          each carries, become CAN frames and bytes of receivers; all others stay bytes, with
//          their fingerprint as type
//   units  stamps: time of the event, whole microseconds
//   errors Problem for a file without an event. Bytes between events, and messages of our types
//          that are too short for their own length field, are left out with a remark
//   cost   O(bytes); nothing is copied
//   source protocol/recording/lcm_log.hpp; protocol/telemetry/export/lcm_schema.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/formats/log_watch.hpp"
#include "hil/replay/recordings/recording.hpp"
#include "protocol/transport/file_bytes.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

Result<Recording, Problem> read_lcm(const transport::FileBytes& file, const std::string& name,
                                    const replay::ReadProgress& reached = {});

}  // namespace pitwall::traffic
