// Encoder of records as LCM messages, with the same channels, types and bytes in an event log and
// on the wire.
//   in     a record of channels.hpp; the clock map of the file or of the process
//   out    the name of its channel; the bytes of its message, most significant byte first:
//          fingerprint, utime of the sample in microseconds since 1970, members. Types:
//          `pitwall-base export lcm`
//   invariants
//          the snapshot of all known values has no LCM message, because the groups have its values;
//          the tick record has none either
//   errors encode() must not be called for a channel for which has() is false
//   cost   no allocation once the buffer has grown
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/recorder/channels.hpp"
#include "protocol/recorder/record_queue.hpp"

namespace pitwall::recorder {

class LcmEncoder {
 public:
  explicit LcmEncoder(const ClockMap& clock);

  bool has(std::uint16_t channel) const;
  const std::string& topic(std::uint16_t channel) const { return kinds_[channel].topic; }
  UtcTime utc(Instant at) const { return UtcTime{utc_of_zero_.ns + at.ns}; }
  // Overwrites `out`.
  void encode(const Record& record, std::vector<std::uint8_t>& out) const;

 private:
  struct Kind {
    std::string topic;
    std::uint64_t fingerprint = 0;
  };

  Instant utc_of_zero_{};  // UTC at zero of the records' clock
  std::vector<Kind> kinds_;
};

}  // namespace pitwall::recorder
