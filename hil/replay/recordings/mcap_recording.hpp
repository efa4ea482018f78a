// Reader of MCAP recordings: our own (black box of the car, recording of the base) and ROS 2 bags.
//   in     the whole file; its name for remarks
//   out    CAN frames: /can/in and /can/out of our recordings, can_msgs/msg/Frame and
//          ros2_socketcan_msgs/msg/FdFrame of bags. Receiver bytes: /gnss/N of our recordings. ROS
//          2 messages: encoding "cdr". Everything else is unchanged, under its encoding
//   units  stamps: log time, when the recorder received the message
//   errors Problem if it is not an MCAP file. Of a cut or damaged file the readable part is
//          returned; each chunk, message and byte range that is left out has a remark with its
//          place
//   cost   O(bytes); an uncompressed file is not copied
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
