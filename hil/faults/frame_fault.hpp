// Faults of single CAN frames on their way from the bench to the car (F01 to F12, F16 to F18 of the
// catalogue).
//   in     the fault list of the scenario, its state, one frame, now
//   out    the frames that replace it on the bus, each with its earliest send time (later than
//          `now` for a delay: the caller keeps it in a DelayQueue)
//   order  faults act in the order of the list, each on the result of those before it
//   invariants
//          one seed gives one sequence of faults; a fault outside its time changes nothing
//   errors a copy beyond kMaxCopies is dropped and counted
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::faults {

enum class FrameFaultKind : std::uint8_t {
  kDrop,           // F01 each frame with `probability`
  kDropBurst,      // F02 with `probability` a burst of `count` frames is lost
  kDropAll,        // F03 one id, F04 without an id
  kDelay,          // F05 `delay` plus up to `jitter`
  kDuplicate,      // F06 `count` additional copies at intervals of kCopyAfter, with `probability`
  kBitFlip,        // F07 `count` bits of the payload, with `probability`
  kStuckCounter,   // F08 the counter keeps its value from the start of the fault
  kCounterJump,    // F09 the counter is `count` ahead
  kWrongLength,    // F11 one byte less (one more if the message is empty)
  kUnknownId,      // F11 an extra frame with identifier `other_id`, with `probability`
  kFrozenValue,    // F16 the payload from the start of the fault, with a live counter
  kWrongChecksum,  // F10 with a correct counter; only messages with a checksum
  kExtendedAlias,  // F11 an extra frame with the same identifier in 29 bit format
  // F12 an extra frame of zeros with `id`, one of the computer's own, beside each kBeside
  kMasquerade,
  kSignalOffset,  // F17 `value` is added to signal number `unit` of the message
  kSignalDrift,   // F17 `value` per second is added
  kSignalNoise,   // F17 random, up to +-`value`, is added
  kSignalSet      // F17, F18 the signal becomes `value`, even outside its range
};
inline constexpr std::size_t kFrameFaultKinds = 18;
// A controller has one slot per identifier: an immediate copy would replace the original.
inline constexpr Duration kCopyAfter = milliseconds(1);
inline constexpr std::uint32_t kBeside = 1301;  // brake_pressure_report

std::string_view name_of(FrameFaultKind kind);  // "drop", "drop_burst", ... as in scenario files
std::optional<FrameFaultKind> frame_fault_kind(std::string_view name);

struct FrameFault {
  FrameFaultKind kind = FrameFaultKind::kDrop;
  std::optional<std::uint32_t> id{};  // absent: every frame
  Instant start{};
  std::optional<Duration> duration{};  // absent: until the end
  std::uint64_t seed = 1;
  double probability = 1.0;
  std::uint32_t count = 1;
  Duration delay{}, jitter{};
  std::uint32_t other_id = 0x7A0;
  std::uint8_t unit = 0;
  double value = 0.0;  // in the unit of the database
};

inline constexpr std::size_t kMaxFrameFaults = 32;
inline constexpr std::size_t kMaxFrozen = 48;  // identifiers per fault: all of the database
inline constexpr std::size_t kMaxCopies = 8;

struct TimedFrame {
  can::Frame frame;
  Instant at{};
};
using TimedFrames = FixedVector<TimedFrame, kMaxCopies>;

struct FrameFaultState {
  struct Frozen {
    can::Frame frame;
  };
  struct One {
    bool seeded = false;
    Random random;
    std::uint32_t burst_left = 0;
    FixedVector<Frozen, kMaxFrozen> frozen;
    std::uint64_t acted = 0;
  };
  std::array<One, kMaxFrameFaults> faults{};
  std::uint64_t overflow = 0;
};

bool active(const FrameFault& fault, Instant now);

TimedFrames apply(std::span<const FrameFault> faults, FrameFaultState& state,
                  const can::Frame& frame, Instant now);

}  // namespace pitwall::faults
