// Binary frames from base to console, as PROTOCOL.md describes them.
//   in     fields with value, age, quality, evaluation; points of the history of a field
//   out    bytes, little endian. The header of 24 bytes is made for each client, because it counts
//          the frames that this client has lost
//   cost   O(entries)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "basestation/alarms/limits.hpp"
#include "basestation/state/laps/lap.hpp"
#include "basestation/state/trends.hpp"
#include "basestation/state/vehicle_state.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::web {

enum class FrameKind : std::uint8_t { kSnapshot = 1, kHistory = 2, kLap = 3 };
inline constexpr std::uint8_t kFrameVersion = 1;
inline constexpr std::uint8_t kAtOnce = 1, kFullPicture = 2;  // flags
inline constexpr std::size_t kFrameHeader = 24, kSnapshotEntry = 8, kHistoryPoint = 16,
                             kLapHead = 16;

struct Frame {
  FrameKind kind = FrameKind::kSnapshot;
  std::uint8_t car = 0, flags = 0;
  std::uint16_t count = 0;
  std::uint32_t sequence = 0;
  Instant at{};
  std::vector<std::uint8_t> entries{};
};

std::array<std::uint8_t, kFrameHeader> header_of(const Frame& frame, std::uint32_t dropped);

// One field of a frame. Equal entries look the same on a console.
struct Entry {
  std::uint16_t field = 0;
  std::uint8_t status = 0, age = 0;
  float value = 0.0F;

  bool same(const Entry& other) const;  // bit by bit: a NaN equals itself
};
std::uint8_t age_code(Duration age);  // at most 254; never received: 255, set by entry_of()
Entry entry_of(std::uint16_t field, const state::FieldView& view, alarms::Evaluation evaluation);

void append(Frame& frame, const Entry& entry);
Frame history_frame(std::uint16_t field, std::span<const state::TrendPoint> points, Instant at);
Frame lap_frame(const state::Lap& lap, double step_m, Instant at);

}  // namespace pitwall::publishers::web
