// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/frame.hpp"

#include <algorithm>
#include <bit>

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr std::uint8_t kNeverCode = 255, kOldestCode = 254;
constexpr unsigned kJudgementShift = 2;
constexpr std::uint8_t kUnsetBit = 1U << 5U;

// Steps of an age: from `first` on, each so long.
struct AgeStep {
  std::uint8_t first;
  Duration from, step;
};
constexpr std::array<AgeStep, 4> kAgeSteps{{{250, seconds(70), seconds(60)},
                                            {190, seconds(10), seconds(1)},
                                            {100, seconds(1), milliseconds(100)},
                                            {0, seconds(0), milliseconds(10)}}};

template <class Number>
void put(std::vector<std::uint8_t>& out, Number number) {
  const std::size_t at = out.size();
  out.resize(at + sizeof number);
  store(std::span{out}, at, number);
}

}  // namespace

std::array<std::uint8_t, kFrameHeader> header_of(const Frame& frame, std::uint32_t dropped) {
  std::array<std::uint8_t, kFrameHeader> header{};
  header[0] = static_cast<std::uint8_t>(frame.kind);
  header[1] = kFrameVersion;
  header[2] = frame.car;
  header[3] = frame.flags;
  store(header, 4, frame.count);
  store(header, 8, frame.sequence);
  store(header, 12, dropped);
  store(header, 16, static_cast<std::uint64_t>(frame.at.ns));
  return header;
}

bool Entry::same(const Entry& other) const {
  return field == other.field && status == other.status && age == other.age &&
         std::bit_cast<std::uint32_t>(value) == std::bit_cast<std::uint32_t>(other.value);
}

std::uint8_t age_code(Duration age) {
  for (const AgeStep& range : kAgeSteps) {
    if (age < range.from) continue;
    const std::int64_t code = range.first + (age - range.from) / range.step;
    return static_cast<std::uint8_t>(std::min<std::int64_t>(code, kOldestCode));
  }
  return 0;
}

Entry entry_of(std::uint16_t field, const state::FieldView& view, alarms::Evaluation evaluation) {
  const bool old = view.quality >= state::Quality::kStale;
  const auto code = static_cast<unsigned>(old ? alarms::Evaluation::kNone : evaluation);
  const unsigned status =
      static_cast<unsigned>(view.quality) | code << kJudgementShift | (view.unset ? kUnsetBit : 0U);
  const bool never = view.quality == state::Quality::kNever;
  return {.field = field,
          .status = static_cast<std::uint8_t>(status),
          .age = never ? kNeverCode : age_code(view.age),
          .value = static_cast<float>(view.value)};
}

void append(Frame& frame, const Entry& entry) {
  put(frame.entries, entry.field);
  put(frame.entries, entry.status);
  put(frame.entries, entry.age);
  put(frame.entries, std::bit_cast<std::uint32_t>(entry.value));
  ++frame.count;
}

Frame history_frame(std::uint16_t field, std::span<const state::TrendPoint> points, Instant at) {
  Frame frame{.kind = FrameKind::kHistory, .count = 1, .at = at};
  frame.entries.reserve(kSnapshotEntry + points.size() * kHistoryPoint);
  put(frame.entries, field);
  put(frame.entries, std::uint16_t{0});
  put(frame.entries, static_cast<std::uint32_t>(points.size()));
  for (const state::TrendPoint& point : points) {
    put(frame.entries, std::bit_cast<std::uint64_t>(point.time_s));
    put(frame.entries, std::bit_cast<std::uint32_t>(point.value));
    put(frame.entries, static_cast<std::uint32_t>(point.quality));
  }
  return frame;
}

Frame lap_frame(const state::Lap& lap, double step_m, Instant at) {
  Frame frame{.kind = FrameKind::kLap, .count = 1, .at = at};
  const std::size_t points = lap.columns.front().size();
  frame.entries.reserve(kLapHead + state::kLapColumns * points * sizeof(float));
  put(frame.entries, lap.id);
  put(frame.entries, static_cast<std::uint32_t>(state::kLapColumns));
  put(frame.entries, static_cast<std::uint32_t>(points));
  put(frame.entries, std::bit_cast<std::uint32_t>(static_cast<float>(step_m)));
  for (const std::vector<float>& column : lap.columns) {
    for (const float value : column) put(frame.entries, std::bit_cast<std::uint32_t>(value));
  }
  return frame;
}

}  // namespace pitwall::publishers::web
