// Files with the raw bytes of a NovAtel or VectorNav receiver, as a logger keeps them.
//   in     the whole file; its name for remarks
//   out    one source, "receiver", with a record for each message: its bytes and those in front of
//          it that belong to none, so that the records one after the other are the file
//   units  stamps: the GPS time that the messages state, as UTC; of a file in which no message
//          knows GPS time, the time since the receiver's start
//   invariants
//          the order of the bytes is kept: a message is due no earlier than the one before, though
//          it states an earlier time (a solution is later than the measurement that came meanwhile)
//   errors Problem for a file without a message of either receiver, or without any time. Bytes of
//          no message and messages without a time are told; a cut tail is left out and told
//   bound  GPS time is 18 s ahead of UTC since 2017; an earlier recording is told of
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

// By the messages that the bytes hold. So many bytes are enough.
inline constexpr std::size_t kReceiverProbeBytes = std::size_t{1} << 16;
Receiver receiver_of(Bytes bytes);

Result<Recording, Problem> read_receiver_stream(const transport::FileBytes& file,
                                                const std::string& name);

}  // namespace pitwall::traffic
