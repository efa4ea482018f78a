// Recordings in MCAP: our own (the car's black box, the base's) and bags of ROS 2.
//   in     the whole file; its name for remarks
//   out    /can/in and /can/out of ours, can_msgs/msg/Frame and ros2_socketcan_msgs/msg/FdFrame of
//          bags: CAN. /gnss/N of ours: a receiver. What is encoded as "cdr": ROS 2. All else as it
//          is, under its encoding
//   units  stamps: log time, when the message was taken down
//   errors Problem for what is no MCAP file. A cut or damaged file gives what can be read of it;
//          each chunk, message and byte range that is left out is a remark with its place
//   cost   O(bytes); of an uncompressed file nothing is copied
//   source https://mcap.dev/spec; protocol/recorder/channels.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/formats/log_watch.hpp"
#include "hil/replay/recordings/recording.hpp"
#include "protocol/transport/file_bytes.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

Result<Recording, Problem> read_mcap(const transport::FileBytes& file, const std::string& name,
                                     const replay::ReadProgress& reached = {});

}  // namespace pitwall::traffic
