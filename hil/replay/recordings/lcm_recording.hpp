// Event logs of LCM, as lcm-logger and our own recorder write them.
//   in     the whole file; its name for remarks
//   out    a source for each channel. Of the types that our recorder has, found by the fingerprint
//          that each message bears: CAN frames and the bytes of receivers; all else as it is, with
//          its fingerprint as type
//   units  stamps: time of the event, whole microseconds
//   errors Problem for a file without an event. Bytes between events, and messages of our types
//          that are shorter than they say, are left out and told
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
