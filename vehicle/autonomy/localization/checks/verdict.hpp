// Verdicts of the localization checks on samples, and their counts.
//   invariants
//          every sample gets one verdict; a refused sample changes no estimate, and no sample is
//          repaired
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::localization {

enum class Source : std::uint8_t { kPosition, kVelocity, kHeading, kImu, kWheelSpeed, kAttitude };
inline constexpr std::size_t kSources = 6;

enum class Gate : std::uint8_t {
  kUnknown,
  kAccepted,
  kNotFinite,
  kUnknownUnit,
  kNotSolved,
  kTooUncertain,
  kTooOld,
  kFromTheFuture,
  kOutlier,  // a jump relative to the predicted motion
  kNotStarted,
  kStandby,           // healthy, but another unit or source is preferred
  kImplausible,       // finite, but impossible for a car on a track or for a receiver
  kExcluded,          // excluded by the operator
  kNegativeVariance,  // refused; its absolute value is not used
  kOldCorrections,
  kWrongBaseline,  // antenna distance differs from the mounting
  kRepeated,       // a stamp that was used before
  kRanBack,
  kFrozen,  // new stamps, but constant content while the car moves
  kDisagrees,
  kOffCourse,      // heading contradicts the course over ground
  kReceiverError,  // the receiver reports an error
  kProbation,      // consistent, but not yet long enough after refusals
  kSilent          // state of a stream without samples
};
inline constexpr std::size_t kGates = 24;

// In the order of Gate; the telemetry labels must match them.
inline constexpr std::array<std::string_view, kGates> kGateNames{"-",
                                                                 "in use",
                                                                 "NOT A NUMBER",
                                                                 "no such unit",
                                                                 "no solution",
                                                                 "too uncertain",
                                                                 "too old",
                                                                 "from the future",
                                                                 "JUMPED",
                                                                 "waits for a start",
                                                                 "stands by",
                                                                 "IMPLAUSIBLE",
                                                                 "excluded",
                                                                 "NEGATIVE VARIANCE",
                                                                 "old corrections",
                                                                 "WRONG BASELINE",
                                                                 "STAMP STANDS STILL",
                                                                 "STAMP RAN BACK",
                                                                 "FROZEN",
                                                                 "CONTRADICTS THE OTHER",
                                                                 "OFF ITS COURSE",
                                                                 "receiver error",
                                                                 "on probation",
                                                                 "SILENT"};
constexpr std::string_view text_of(Gate gate) { return kGateNames[static_cast<std::size_t>(gate)]; }

struct Verdict {
  Source source = Source::kPosition;
  std::uint8_t unit = 0;
  Gate gate = Gate::kUnknown;
  double nis = kUnset;
  double age_s = kUnset;
};

// Counts since the start; one row per source and unit (wheel speed is unit 0).
struct Tally {
  std::array<std::uint32_t, kGates> by_gate{};
  Instant last_accepted{};
  bool ever_accepted = false;
};
using Tallies = std::array<std::array<Tally, world::kGnssUnits>, kSources>;

}  // namespace pitwall::localization
