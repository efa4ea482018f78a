// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/event_content.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

// Of each kind; kText has any length.
constexpr std::array<std::size_t, kEventKinds> kLengths{4, 6, 3, 3, 1, 6, 1, 0, 7};

template <class T>
void append(Event& event, T value) {
  std::array<std::uint8_t, sizeof(T)> bytes{};
  store(bytes, 0, value);
  for (const std::uint8_t byte : bytes) static_cast<void>(event.payload.push(byte));
}

struct Writer {
  Event& event;

  void operator()(const LostEvents& c) const { append(event, c.count); }
  void operator()(const FaultEvent& c) const {
    append(event, c.cause);
    append(event, static_cast<std::uint8_t>(c.begins));
    append(event, std::bit_cast<std::uint32_t>(c.value));
  }
  void operator()(const ModeEvent& c) const {
    for (const std::uint8_t value : {c.from, c.to, c.cause}) append(event, value);
  }
  void operator()(const FlagEvent& c) const {
    for (const std::uint8_t value : {static_cast<std::uint8_t>(c.which), c.from, c.to})
      append(event, value);
  }
  void operator()(const ArmingEvent& c) const { append(event, c.arming); }
  void operator()(const LapEvent& c) const {
    append(event, c.number);
    append(event, std::bit_cast<std::uint32_t>(c.time_s));
  }
  void operator()(const RestartEvent& c) const { append(event, c.part); }
  void operator()(const TextEvent& c) const {
    for (const char letter : c.text.substr(0, kEventPayload))
      append(event, static_cast<std::uint8_t>(letter));
  }
  void operator()(const ThreatEvent& c) const {
    append(event, c.threat);
    append(event, static_cast<std::uint8_t>(c.begins));
    append(event, static_cast<std::uint8_t>(c.seen_by_base));
    append(event, c.most_per_s);
  }
};

// In the order of EventContent.
constexpr std::array<EventKind, kEventKinds> kKindOfContent{
    EventKind::kLost,       EventKind::kFault,  EventKind::kModeChange,
    EventKind::kFlagChange, EventKind::kArming, EventKind::kLap,
    EventKind::kRestart,    EventKind::kText,   EventKind::kThreat};
static_assert(std::variant_size_v<EventContent> == kEventKinds);

float float_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return std::bit_cast<float>(load<std::uint32_t>(bytes, at));
}

}  // namespace

Event make_event(const EventContent& content, Instant at) {
  Event event;
  event.kind = kKindOfContent[content.index()];
  event.at = at;
  std::visit(Writer{event}, content);
  return event;
}

std::optional<EventContent> content_of(const Event& event) {
  const std::span<const std::uint8_t> bytes = event.payload.span();
  const auto kind = static_cast<std::size_t>(event.kind);
  if (kind >= kEventKinds) return std::nullopt;
  if (event.kind != EventKind::kText && bytes.size() != kLengths[kind]) return std::nullopt;
  switch (event.kind) {
    case EventKind::kLost:
      return LostEvents{load<std::uint32_t>(bytes, 0)};
    case EventKind::kFault:
      if (bytes[1] > 1) return std::nullopt;
      return FaultEvent{bytes[0], bytes[1] == 1, float_at(bytes, 2)};
    case EventKind::kModeChange:
      return ModeEvent{bytes[0], bytes[1], bytes[2]};
    case EventKind::kFlagChange:
      if (bytes[0] > 1) return std::nullopt;
      return FlagEvent{static_cast<FlagKind>(bytes[0]), bytes[1], bytes[2]};
    case EventKind::kArming:
      return ArmingEvent{bytes[0]};
    case EventKind::kLap:
      return LapEvent{load<std::uint16_t>(bytes, 0), float_at(bytes, 2)};
    case EventKind::kRestart:
      return RestartEvent{bytes[0]};
    case EventKind::kText:
      return TextEvent{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
    case EventKind::kThreat:
      if (bytes[1] > 1 || bytes[2] > 1) return std::nullopt;
      return ThreatEvent{bytes[0], bytes[1] == 1, bytes[2] == 1, load<std::uint32_t>(bytes, 3)};
  }
  return std::nullopt;
}

}  // namespace pitwall::telemetry
