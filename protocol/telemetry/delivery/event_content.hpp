// Content of an event: one struct per kind, with conversion to payload bytes and back. Both ends
// use it, so that neither handles byte offsets.
//   wire   the fields in the order of the struct, little endian; f32 as IEEE 754
//   errors content_of(): nullopt if the length does not fit the kind, or a flag is neither 0 nor 1
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>

#include "protocol/telemetry/delivery/events.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct LostEvents {
  std::uint32_t count = 0;
  bool operator==(const LostEvents&) const = default;
};
struct FaultEvent {
  std::uint8_t cause = 0;  // as in the registry's labels of first_stop_cause
  bool begins = true;
  float value = 0.0F;  // the value that crossed its limit: age in s, sigma in m, or a count
  bool operator==(const FaultEvent&) const = default;
};
struct ModeEvent {
  std::uint8_t from = 0, to = 0, cause = 0;
  bool operator==(const ModeEvent&) const = default;
};
enum class FlagKind : std::uint8_t { kTrack, kVehicle };
struct FlagEvent {
  FlagKind which = FlagKind::kTrack;
  std::uint8_t from = 0, to = 0;
  bool operator==(const FlagEvent&) const = default;
};
struct ArmingEvent {
  std::uint8_t arming = 0;
  bool operator==(const ArmingEvent&) const = default;
};
struct LapEvent {
  std::uint16_t number = 0;                                // laps finished
  float time_s = std::numeric_limits<float>::quiet_NaN();  // of the last lap; NaN: unknown
  bool operator==(const LapEvent&) const = default;
};
struct RestartEvent {
  std::uint8_t part = 0;
  bool operator==(const RestartEvent&) const = default;
};
struct TextEvent {
  std::string_view text;  // from content_of(): valid as long as the event; longer texts are cut
  bool operator==(const TextEvent&) const = default;
};
struct ThreatEvent {
  std::uint8_t threat = 0;  // as in the registry's labels of radio.threats
  bool begins = true;
  bool seen_by_base = false;     // false: by the car
  std::uint32_t most_per_s = 0;  // highest rate of datagrams so far
  bool operator==(const ThreatEvent&) const = default;
};

using EventContent = std::variant<LostEvents, FaultEvent, ModeEvent, FlagEvent, ArmingEvent,
                                  LapEvent, RestartEvent, TextEvent, ThreatEvent>;

Event make_event(const EventContent& content, Instant at);
std::optional<EventContent> content_of(const Event& event);

}  // namespace pitwall::telemetry
