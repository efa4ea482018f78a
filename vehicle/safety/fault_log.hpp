// Every reason for which the car stops, as one table, and the log of those that occurred: a ring of
// (instant, cause, value) that also keeps the first since the last reset.
//   out    a value; copying it is a snapshot
//   errors an entry that falls out of the ring stays counted in total
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::safety {

// In the order of precedence: of several in one tick the first listed is "the cause".
enum class Cause : std::uint8_t {
  kNone,
  // emergency: brake as hard as grip allows
  kOperatorEmergency,
  kPurpleFlag,
  kBusDead,
  kSystemFailure,
  kEmergencyBrake,
  kSteeringCommsLost,
  kSysEmergencyShutdown,
  // controlled stop
  kOperatorStop,
  kDisarmRequest,
  kEngineKillFlag,
  kMotecCommsLost,
  kBrakeOutOfSpec,
  kCriticalLimits,
  kComputerHeartbeatLost,
  kWrongBus,
  kBusOff,
  kOwnIdOnBus,
  kBusMessageLost,
  kCommandRefused,
  kControlFailed,
  kPlanLost,
  kLocalizationLost,
  kDeadReckoningTooLong,
  kLocalizationUncertain,
  kGnssUnitDisconnected,
  kGnssRateLost,
  kGnssSolutionLost,
  kImuLost,
  kRaceControlLost,
  kRaceControlReportedLost,
  kRadioLost
};
inline constexpr std::size_t kCauses = 32;

enum class Reaction : std::uint8_t { kNone, kControlledStop, kEmergencyStop };

struct CauseRow {
  Cause cause;
  const char* text;
  Reaction reaction;
  bool bars_arming;  // the rest may be absent in the garage and bars driving only
  // An armed car that has not moved yet is disarmed: when the cause is gone it must not set off.
  bool voids_arming = false;
};

inline constexpr std::array<CauseRow, kCauses> kCauseTable{{
    {Cause::kNone, "none", Reaction::kNone, false},
    {Cause::kOperatorEmergency, "operator: emergency stop", Reaction::kEmergencyStop, true},
    {Cause::kPurpleFlag, "purple flag", Reaction::kEmergencyStop, true},
    {Cause::kBusDead, "CAN bus dead: the drive-by-wire is silent", Reaction::kEmergencyStop, true},
    {Cause::kSystemFailure, "drive-by-wire: system failure", Reaction::kEmergencyStop, true},
    {Cause::kEmergencyBrake, "drive-by-wire: emergency brake", Reaction::kEmergencyStop, true},
    {Cause::kSteeringCommsLost, "drive-by-wire: steering lost", Reaction::kEmergencyStop, true},
    {Cause::kSysEmergencyShutdown, "drive-by-wire: emergency shutdown", Reaction::kEmergencyStop,
     true},
    {Cause::kOperatorStop, "operator: stop", Reaction::kControlledStop, true},
    {Cause::kDisarmRequest, "operator: disarm", Reaction::kControlledStop, false},
    {Cause::kEngineKillFlag, "engine-kill flag", Reaction::kControlledStop, true},
    {Cause::kMotecCommsLost, "drive-by-wire: engine lost", Reaction::kControlledStop, true},
    {Cause::kBrakeOutOfSpec, "drive-by-wire: brake out of spec", Reaction::kControlledStop, true},
    {Cause::kCriticalLimits, "drive-by-wire: critical limits", Reaction::kControlledStop, true},
    {Cause::kComputerHeartbeatLost, "drive-by-wire: does not hear us", Reaction::kControlledStop,
     false},
    {Cause::kWrongBus, "CAN bus does not fit the database", Reaction::kControlledStop, true},
    {Cause::kBusOff, "CAN bus off", Reaction::kControlledStop, true},
    {Cause::kOwnIdOnBus, "another node sends our CAN ids", Reaction::kControlledStop, true},
    {Cause::kBusMessageLost, "CAN message lost", Reaction::kControlledStop, true},
    {Cause::kCommandRefused, "frame gate refused commands", Reaction::kControlledStop, false},
    {Cause::kControlFailed, "control failed", Reaction::kControlledStop, false},
    {Cause::kPlanLost, "planning failed or late", Reaction::kControlledStop, false},
    {Cause::kLocalizationLost, "localization lost", Reaction::kControlledStop, false},
    {Cause::kDeadReckoningTooLong, "dead reckoning too long", Reaction::kControlledStop, false},
    {Cause::kLocalizationUncertain, "position too uncertain", Reaction::kControlledStop, false},
    {Cause::kGnssUnitDisconnected, "GNSS unit disconnected", Reaction::kControlledStop, false},
    {Cause::kGnssRateLost, "GNSS: both units miss the rate", Reaction::kControlledStop, false},
    {Cause::kGnssSolutionLost, "GNSS: both units lost the solution", Reaction::kControlledStop,
     false},
    {Cause::kImuLost, "IMU: both units lost", Reaction::kControlledStop, false},
    {Cause::kRaceControlLost, "race control lost", Reaction::kControlledStop, false},
    {Cause::kRaceControlReportedLost, "race control lost, says the drive-by-wire",
     Reaction::kControlledStop, false},
    {Cause::kRadioLost, "base station lost", Reaction::kControlledStop, true, true},
}};

constexpr const CauseRow& row_of(Cause cause) {
  return kCauseTable[static_cast<std::size_t>(cause)];
}
constexpr const char* text_of(Cause cause) { return row_of(cause).text; }

consteval bool causes_are_in_order() {
  for (std::size_t i = 0; i < kCauses; ++i)
    if (static_cast<std::size_t>(kCauseTable[i].cause) != i) return false;
  return true;
}
static_assert(causes_are_in_order(), "kCauseTable is indexed by Cause");

// A set of causes: what holds in one tick.
class CauseSet {
 public:
  constexpr void add(Cause cause) { bits_ |= bit(cause); }
  constexpr bool has(Cause cause) const { return (bits_ & bit(cause)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::uint32_t bits() const { return bits_; }
  constexpr CauseSet without(CauseSet other) const { return CauseSet{bits_ & ~other.bits_}; }
  // The first in the order of precedence; kNone of an empty set.
  constexpr Cause first() const {
    for (std::size_t i = 1; i < kCauses; ++i)
      if (has(static_cast<Cause>(i))) return static_cast<Cause>(i);
    return Cause::kNone;
  }
  constexpr bool operator==(const CauseSet&) const = default;
  constexpr CauseSet() = default;

 private:
  constexpr explicit CauseSet(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Cause cause) {
    return cause == Cause::kNone ? 0u : 1u << static_cast<unsigned>(cause);
  }
  std::uint32_t bits_ = 0;
};
static_assert(kCauses <= 32);

struct FaultEntry {
  Instant at{};
  Cause cause = Cause::kNone;
  double value = kUnset;  // age in s, sigma in m, count: what crossed its limit
};

inline constexpr std::size_t kFaultEntries = 64;  // a run that has more has one cause worth reading

struct FaultLog {
  std::array<FaultEntry, kFaultEntries> ring{};
  std::uint64_t total = 0;  // ever recorded; the newest is ring[(total - 1) % kFaultEntries]
  FaultEntry first{};  // that stopped the car since the last reset; cause kNone if there is none

  constexpr std::size_t size() const {
    return total < kFaultEntries ? static_cast<std::size_t>(total) : kFaultEntries;
  }
  // 0 is the oldest kept; i < size().
  constexpr const FaultEntry& entry(std::size_t i) const {
    return ring[static_cast<std::size_t>((total - size() + i) % kFaultEntries)];
  }
  // `stops`: the car was to move, so the fault is a candidate for the first cause.
  constexpr void record(const FaultEntry& fault, bool stops) {
    ring[static_cast<std::size_t>(total % kFaultEntries)] = fault;
    ++total;
    if (stops && first.cause == Cause::kNone) first = fault;
  }
  constexpr void forget_first() { first = FaultEntry{}; }
};
static_assert(std::is_trivially_copyable_v<FaultLog>);

}  // namespace pitwall::safety
