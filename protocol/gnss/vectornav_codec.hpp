// Codec of VectorNav binary output (VN-310): one whole message to values and back. Used by the car
// (decode) and by the bench, which simulates a sensor (encode).
//   in     a frame that VectorNavStream extracted and checked; a message with its output
//   out    values; a complete frame: 0xFA, groups, fields, payload, CRC-16 (most significant byte
//          first)
//   errors DecodeError (refusal.hpp)
//   bound  the groups common, time, IMU, GNSS 1, attitude, INS, GNSS 2; a header with more groups,
//          with satellites or raw measurements (it does not state their length) is invalid
//   source UM001 v2.22, section 4.3
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/gnss/refusal.hpp"
#include "protocol/gnss/vectornav_message.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::gnss {

inline constexpr std::uint8_t kVectorNavSync = 0xFA;
inline constexpr std::size_t kVectorNavCrcBytes = 2;
// Longer than any message with all known fields.
inline constexpr std::size_t kMaxVectorNavBytes = 1'536;

struct VectorNavHeader {
  VectorNavOutput output;
  std::size_t header_bytes = 0, payload_bytes = 0;

  std::size_t frame_bytes() const { return header_bytes + payload_bytes + kVectorNavCrcBytes; }
};

// Header at the front of `bytes`, which begin with the sync.
//   out    nullopt if the header is invalid; a header of zero bytes if more bytes are needed
std::optional<VectorNavHeader> read_vectornav_header(std::span<const std::uint8_t> bytes);

struct VectorNavFrame {
  VectorNavOutput output;
  std::span<const std::uint8_t> payload;  // valid until the stream is fed again
  std::size_t bytes = 0;                  // of the whole frame, header and CRC included
};

Result<VectorNavMessage, DecodeError> decode(const VectorNavFrame& frame);

// Writes the fields in message.output, which must not be empty and must not contain fields that
// decode() skips. Returns the bytes written; `out` must have room for kMaxVectorNavBytes.
std::size_t encode(const VectorNavMessage& message, std::span<std::uint8_t> out);

// Mask of the fields of a group that encode() can write.
std::uint32_t writable_fields(VectorNavGroup group);

}  // namespace pitwall::gnss
