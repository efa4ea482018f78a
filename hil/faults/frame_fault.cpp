// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/frame_fault.hpp"

#include <algorithm>

#include "hil/faults/signal_change.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/can/integrity_bench.hpp"
#include "protocol/can/message_monitor.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::faults {
namespace {

struct Name {
  FrameFaultKind kind;
  std::string_view name;
};
constexpr std::array<Name, kFrameFaultKinds> kNames{
    Name{FrameFaultKind::kDrop, "drop"},
    Name{FrameFaultKind::kDropBurst, "drop_burst"},
    Name{FrameFaultKind::kDropAll, "drop_all"},
    Name{FrameFaultKind::kDelay, "delay"},
    Name{FrameFaultKind::kDuplicate, "duplicate"},
    Name{FrameFaultKind::kBitFlip, "bit_flip"},
    Name{FrameFaultKind::kStuckCounter, "stuck_counter"},
    Name{FrameFaultKind::kCounterJump, "counter_jump"},
    Name{FrameFaultKind::kWrongLength, "wrong_length"},
    Name{FrameFaultKind::kUnknownId, "unknown_id"},
    Name{FrameFaultKind::kFrozenValue, "frozen_value"},
    Name{FrameFaultKind::kWrongChecksum, "wrong_checksum"},
    Name{FrameFaultKind::kExtendedAlias, "extended_alias"},
    Name{FrameFaultKind::kMasquerade, "masquerade"},
    Name{FrameFaultKind::kSignalOffset, "signal_offset"},
    Name{FrameFaultKind::kSignalDrift, "signal_drift"},
    Name{FrameFaultKind::kSignalNoise, "signal_noise"},
    Name{FrameFaultKind::kSignalSet, "signal_set"}};

const can::MessageRow* row_with_counter(std::uint32_t id) {
  for (const can::MessageRow& row : can::av21::kMessages)
    if (row.id == id && row.has_counter) return &row;
  return nullptr;
}

void set_counter(can::Frame& frame, const can::MessageRow& row, std::uint32_t value) {
  for (std::uint32_t i = 0; i < row.counter_bits; ++i) {
    const std::uint32_t bit = row.counter_start + i;
    const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
    std::uint8_t& byte = frame.data[bit / 8];
    byte = static_cast<std::uint8_t>(((value >> i) & 1U) != 0U ? byte | mask : byte & ~mask);
  }
}

bool reaches(const can::Frame& frame, const can::MessageRow& row) {
  return row.counter_start + row.counter_bits <= 8U * frame.length;
}

// The frame as it was when the fault first saw its identifier; nullptr when the memory is full.
const can::Frame* frozen(FrameFaultState::One& one, const can::Frame& frame) {
  for (const auto& held : one.frozen)
    if (held.frame.id == frame.id && held.frame.extended == frame.extended) return &held.frame;
  if (!one.frozen.push({frame})) return nullptr;
  return &one.frozen.back().frame;
}

// Different bits of the payload, `count` of them or as many as there are.
void flip_bits(can::Frame& frame, std::uint32_t count, Random& random) {
  const std::uint32_t bits = 8U * frame.length;
  std::uint64_t flipped = 0;
  for (std::uint32_t i = 0; i < std::min(count, bits); ++i) {
    auto bit = static_cast<std::uint32_t>(random.below(bits));
    while (((flipped >> bit) & 1U) != 0U) bit = (bit + 1) % bits;
    flipped |= std::uint64_t{1} << bit;
    frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] ^ (1U << (bit % 8)));
  }
}

void rewrite_counter(const FrameFault& fault, FrameFaultState::One& one, can::Frame& frame) {
  const can::MessageRow* row = row_with_counter(frame.id);
  if (row == nullptr || !reaches(frame, *row)) return;
  if (fault.kind == FrameFaultKind::kCounterJump) {
    set_counter(frame, *row, can::counter_of(*row, frame) + fault.count);
    return;
  }
  const can::Frame* held = frozen(one, frame);
  if (held != nullptr) set_counter(frame, *row, can::counter_of(*row, *held));
}

void freeze_value(FrameFaultState::One& one, can::Frame& frame) {
  const can::Frame* held = frozen(one, frame);
  if (held == nullptr) return;
  can::Frame old = *held;
  const can::MessageRow* row = row_with_counter(frame.id);
  if (row != nullptr && reaches(frame, *row) && reaches(old, *row))
    set_counter(old, *row, can::counter_of(*row, frame));
  frame = old;
}

bool drops(const FrameFault& fault, FrameFaultState::One& one) {
  switch (fault.kind) {
    case FrameFaultKind::kDropAll:
      return true;
    case FrameFaultKind::kDrop:
      return one.random.uniform() < fault.probability;
    case FrameFaultKind::kDropBurst:
      if (one.burst_left == 0 && one.random.uniform() < fault.probability)
        one.burst_left = fault.count;
      if (one.burst_left == 0) return false;
      --one.burst_left;
      return true;
    default:
      return false;
  }
}

bool adds_a_frame(FrameFaultKind kind) {
  return kind == FrameFaultKind::kDuplicate || kind == FrameFaultKind::kUnknownId ||
         kind == FrameFaultKind::kExtendedAlias || kind == FrameFaultKind::kMasquerade;
}

std::uint32_t copies(const FrameFault& fault, FrameFaultState::One& one) {
  if (!adds_a_frame(fault.kind) || one.random.uniform() >= fault.probability) return 0;
  return fault.kind == FrameFaultKind::kDuplicate ? fault.count : 1;
}

can::Frame extra_frame(const FrameFault& fault, const can::Frame& like) {
  can::Frame extra = like;
  if (fault.kind == FrameFaultKind::kUnknownId) extra.id = fault.other_id;
  if (fault.kind == FrameFaultKind::kExtendedAlias) extra.extended = true;
  if (fault.kind != FrameFaultKind::kMasquerade) return extra;
  extra = {};
  extra.id = fault.id.value_or(0);
  for (const can::MessageRow& row : can::av21::kMessages)
    if (row.id == extra.id) extra.length = row.length;
  return extra;
}

// The checksum byte alone: everything else of the frame is true.
void spoil_checksum(can::Frame& frame) {
  for (const can::MessageRow& row : can::integrity_bench::kMessages)
    if (row.id == frame.id && row.protection.profile != can::Protection::kNone)
      frame.data[row.protection.crc_byte] ^= 0x55U;
}

void rewrite(const FrameFault& fault, FrameFaultState::One& one, TimedFrame& timed, Instant now) {
  can::Frame& frame = timed.frame;
  switch (fault.kind) {
    case FrameFaultKind::kDelay:
      timed.at += fault.delay;
      if (fault.jitter.ns > 0)
        timed.at += nanoseconds(static_cast<std::int64_t>(
            one.random.below(static_cast<std::uint64_t>(fault.jitter.ns) + 1)));
      return;
    case FrameFaultKind::kBitFlip:
      if (one.random.uniform() < fault.probability) flip_bits(frame, fault.count, one.random);
      return;
    case FrameFaultKind::kStuckCounter:
    case FrameFaultKind::kCounterJump:
      return rewrite_counter(fault, one, frame);
    case FrameFaultKind::kWrongLength:
      frame.length = static_cast<std::uint8_t>(frame.length == 0 ? 1 : frame.length - 1);
      return;
    case FrameFaultKind::kFrozenValue:
      return freeze_value(one, frame);
    case FrameFaultKind::kWrongChecksum:
      return spoil_checksum(frame);
    case FrameFaultKind::kSignalOffset:
      return add_to_signal(frame, fault.unit, fault.value);
    case FrameFaultKind::kSignalDrift:
      return add_to_signal(frame, fault.unit, fault.value * (now - fault.start).seconds());
    case FrameFaultKind::kSignalNoise:
      return add_to_signal(frame, fault.unit, fault.value * (2.0 * one.random.uniform() - 1.0));
    case FrameFaultKind::kSignalSet:
      return set_signal(frame, fault.unit, fault.value);
    default:
      return;
  }
}

// What one fault makes of one frame, appended to `out`.
void pass_on(const FrameFault& fault, FrameFaultState& state, FrameFaultState::One& one,
             TimedFrame timed, Instant now, TimedFrames& out) {
  const auto put = [&](const TimedFrame& t) { state.overflow += out.push(t) ? 0U : 1U; };
  const bool concerned = fault.kind == FrameFaultKind::kMasquerade
                             ? timed.frame.id == kBeside
                             : !fault.id || *fault.id == timed.frame.id;
  if (!concerned) return put(timed);
  if (drops(fault, one)) {
    ++one.acted;
    return;
  }
  const TimedFrame before = timed;
  rewrite(fault, one, timed, now);
  put(timed);
  TimedFrame extra = timed;
  extra.frame = extra_frame(fault, timed.frame);
  const std::uint32_t more = copies(fault, one);
  for (std::uint32_t i = 0; i < more; ++i) {
    if (fault.kind == FrameFaultKind::kDuplicate) extra.at += kCopyAfter;
    put(extra);
  }
  if (more > 0 || !(timed.frame == before.frame) || timed.at != before.at) ++one.acted;
}

}  // namespace

std::string_view name_of(FrameFaultKind kind) {
  for (const Name& row : kNames)
    if (row.kind == kind) return row.name;
  CHECK(false);
  return {};
}

std::optional<FrameFaultKind> frame_fault_kind(std::string_view name) {
  for (const Name& row : kNames)
    if (row.name == name) return row.kind;
  return std::nullopt;
}

bool active(const FrameFault& fault, Instant now) {
  return now >= fault.start && (!fault.duration || now < fault.start + *fault.duration);
}

TimedFrames apply(std::span<const FrameFault> faults, FrameFaultState& state,
                  const can::Frame& frame, Instant now) {
  CHECK(faults.size() <= kMaxFrameFaults);
  TimedFrames frames;
  CHECK(frames.push({frame, now}));
  for (std::size_t i = 0; i < faults.size(); ++i) {
    if (!active(faults[i], now)) continue;
    FrameFaultState::One& one = state.faults[i];
    if (!one.seeded) one.random.state = faults[i].seed;
    one.seeded = true;
    TimedFrames next;
    for (const TimedFrame& timed : frames) pass_on(faults[i], state, one, timed, now, next);
    frames = next;
  }
  return frames;
}

}  // namespace pitwall::faults
