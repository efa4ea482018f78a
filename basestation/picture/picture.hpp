// The latest value of every field and how old it is: what all outlets show.
//   in     accepted packets and when they were received
//   out    value, age and quality of each field at any later time
//   age    time since reception plus the age of the sample when it was sent; the time on the way is
//          not in it (the clocks are not compared in this version)
//   unset  a field that the car no longer knows keeps its last value and grows old
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::picture {

enum class Quality : std::uint8_t {
  kFresh,  // within the field's target age
  kLate,   // within three times of it
  kStale,
  kNever
};
inline constexpr int kLateFactor = 3;
const char* text_of(Quality quality);

struct FieldView {
  double value = kUnset;
  Duration age{};
  Quality quality = Quality::kNever;
};

class Picture {
 public:
  void update(const telemetry::StatePacket& packet, Instant received);

  FieldView view(telemetry::FieldIndex field, Instant now) const;
  bool ever() const { return ever_; }
  telemetry::Source source() const { return source_; }  // of the last packet

 private:
  struct Latest {
    double value = kUnset;
    Instant received{};
    Duration age_when_sent{};
    bool ever = false;
  };

  std::array<Latest, telemetry::kFieldCount> latest_{};
  telemetry::Source source_ = telemetry::Source::kSimulation;
  bool ever_ = false;
};

}  // namespace pitwall::picture
