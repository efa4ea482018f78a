// Reader of files with the raw bytes of a NovAtel or VectorNav receiver, as a logger keeps them.
//   in     the whole file; its name for remarks
//   out    one source, "receiver", with one record per message: the bytes of the message, preceded
//          by the bytes in front of it that belong to no message, so that all records in sequence
//          are the file
//   units  stamps: the GPS time of the messages, as UTC; if no message of the file has GPS time,
//          the time since the start of the receiver
//   invariants
//          the order of the bytes is kept: no stamp is earlier than the one before it, even if the
//          message states an earlier time (a solution may follow newer measurements)
//   errors Problem for a file without a message of either receiver, or without any time. Bytes
//          outside of messages and messages without a time get a remark; a cut tail is left out
//          with a remark
//   bound  GPS time is 18 s ahead of UTC since 2017; an earlier recording gets a remark
//   cost   O(bytes); nothing is copied
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hil/replay/recordings/recording.hpp"
#include "protocol/transport/file_bytes.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

enum class Receiver : std::uint8_t { kUnknown, kNovatel, kVectorNav };
std::string_view to_string(Receiver receiver);

// Detects the receiver by the messages in the bytes. kReceiverProbeBytes are enough.
inline constexpr std::size_t kReceiverProbeBytes = std::size_t{1} << 16;
Receiver receiver_of(Bytes bytes);

Result<Recording, Problem> read_receiver_stream(const transport::FileBytes& file,
                                                const std::string& name);

}  // namespace pitwall::traffic
