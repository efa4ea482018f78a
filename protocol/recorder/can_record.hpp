// CAN frame as a record of the topics /can/in and /can/out of the car.
//   errors decode_frame(): a record that cannot be read, an identifier out of range
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "protocol/can/frame.hpp"
#include "protocol/recording/cdr_struct.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::recorder {

inline constexpr const char *kReceivedTopic = "/can/in", *kSentTopic = "/can/out";

struct CanRecord {
  std::uint32_t id = 0;  // without flag bits
  bool extended = false, remote = false, fd = false;
  recording::CdrBytes<can::kMaxDataBytes> data;
};
constexpr recording::CdrName cdr_name(std::type_identity<CanRecord>) { return "CarCanFrame"; }
constexpr auto cdr_fields(std::type_identity<CanRecord>) {
  using recording::CdrField;
  return std::tuple{CdrField{"id", &CanRecord::id}, CdrField{"extended", &CanRecord::extended},
                    CdrField{"remote", &CanRecord::remote}, CdrField{"fd", &CanRecord::fd},
                    CdrField{"data", &CanRecord::data}};
}
using CanBytes = std::array<std::uint8_t, recording::cdr_bytes_max<CanRecord>()>;

inline std::span<const std::uint8_t> encode(const can::Frame& frame, CanBytes& bytes) {
  CanRecord record{.id = frame.id,
                   .extended = frame.extended,
                   .remote = frame.remote,
                   .fd = frame.fd,
                   .data = {}};
  for (const std::uint8_t byte : frame.payload()) CHECK(record.data.push(byte));
  return recording::to_cdr(record, bytes);
}

// The frame of the record, or a text that says why there is none.
inline Result<can::Frame, const char*> decode_frame(std::span<const std::uint8_t> bytes) {
  CanRecord record;
  if (!recording::from_cdr(bytes, record)) return Unexpected{"CAN frame that cannot be read"};
  if (record.id > (record.extended ? can::kMaxExtendedId : can::kMaxStandardId))
    return Unexpected{"CAN frame: identifier out of range"};
  can::Frame frame{.id = record.id,
                   .extended = record.extended,
                   .remote = record.remote,
                   .fd = record.fd,
                   .length = static_cast<std::uint8_t>(record.data.size())};
  std::ranges::copy(record.data.span(), frame.data.begin());
  return frame;
}

}  // namespace pitwall::recorder
