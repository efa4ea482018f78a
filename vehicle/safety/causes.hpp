// Table of the causes for which the car stops, coasts or raises a message: the reaction to each,
// and its deadline from the fault to the tick in which the mode changes, with the limits of the
// default parameters.
//   source paper: the five rules of its system executive are marked; the rest is ours
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::safety {

// In order of precedence: of several in one tick the first listed is "the cause".
enum class Cause : std::uint8_t {
  kNone,
  // emergency stop: brake as hard as grip allows
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
  kRadioLost,
  kGnssRtkLost,
  kSteeringDeviates,
  kSteeringBiased,
  kBrakeDeviates,
  kThrottleDeviates,
  kComputerLate,
  kComputerMemory,
  kComputerHot,
  // coast: faults that may clear by themselves
  kRearSpin,
  kRearLock,
  kYawExcess,
  kPositionPassing,
  kPlanLate,
  kControlLate,
  // message only
  kFrontLock,
  kFlagsDisagree,
  kRoundSpeedTooHigh,
  kTicksMissed,
  kProcessorBusy,
  kClockStepped,
  kClockSkewed,
  kGnssDegraded
};
inline constexpr std::size_t kCauses = 54;

// In rising order of severity.
enum class Reaction : std::uint8_t { kNone, kNotify, kCoast, kControlledStop, kEmergencyStop };

enum class ArmingEffect : std::uint8_t {
  kAllows,  // bars driving only: may hold in the garage
  kBars,
  // Bars arming, and disarms a car in standby, so that it does not start when the cause clears.
  kRevokes
};

struct CauseRow {
  Cause cause;
  const char* text;
  Reaction reaction;
  Duration deadline;
  ArmingEffect arms = ArmingEffect::kAllows;
  bool listed_in_paper = false;
};

inline constexpr std::array<CauseRow, kCauses> kCauseTable = [] {
  using enum Cause;
  using enum ArmingEffect;
  constexpr auto kNotify = Reaction::kNotify, kCoast = Reaction::kCoast,
                 kControlledStop = Reaction::kControlledStop,
                 kEmergencyStop = Reaction::kEmergencyStop;
  constexpr auto ms = [](std::int64_t n) { return milliseconds(n); };
  // Causes that the drive-by-wire reports: diagnostic_report comes every 100 ms, misc_report every
  // second.
  constexpr Duration kReported = ms(120), kReportedSlowly = ms(1'020), kTick = ms(20);
  // clang-format off
  return std::array<CauseRow, kCauses>{{
    {Cause::kNone, "none", Reaction::kNone, {}},
    {kOperatorEmergency, "operator: emergency stop", kEmergencyStop, kTick, kBars},
    {kPurpleFlag, "purple flag", kEmergencyStop, kTick, kBars},
    {kBusDead, "CAN bus dead: the drive-by-wire is silent", kEmergencyStop, ms(100), kBars},
    {kSystemFailure, "drive-by-wire: system failure", kEmergencyStop, kReported, kBars},
    {kEmergencyBrake, "drive-by-wire: emergency brake", kEmergencyStop, kReported, kBars},
    {kSteeringCommsLost, "drive-by-wire: steering lost", kEmergencyStop, kReported, kBars},
    {kSysEmergencyShutdown, "drive-by-wire: emergency shutdown", kEmergencyStop, kReportedSlowly,
     kBars},
    {kOperatorStop, "operator: stop", kControlledStop, kTick, kBars},
    {kDisarmRequest, "operator: disarm", kControlledStop, kTick},
    {kEngineKillFlag, "engine-kill flag", kControlledStop, kTick, kBars},
    {kMotecCommsLost, "drive-by-wire: engine lost", kControlledStop, kReported, kBars},
    {kBrakeOutOfSpec, "drive-by-wire: brake out of spec", kControlledStop, kReported, kBars},
    {kCriticalLimits, "drive-by-wire: critical limits", kControlledStop, kReportedSlowly, kBars},
    {kComputerHeartbeatLost, "drive-by-wire: does not hear us", kControlledStop, kReported},
    {kWrongBus, "CAN bus does not fit the database", kControlledStop, kTick, kBars},
    {kBusOff, "CAN bus off", kControlledStop, ms(500), kBars},
    {kOwnIdOnBus, "another node sends our CAN ids", kControlledStop, kTick, kBars},
    {kBusMessageLost, "CAN message lost", kControlledStop, ms(270), kBars},
    {kCommandRefused, "frame gate refused commands", kControlledStop, ms(40)},
    {kControlFailed, "control failed", kControlledStop, ms(30)},
    {kPlanLost, "planning failed or late", kControlledStop, ms(520)},
    {kLocalizationLost, "localization lost", kControlledStop, kTick},
    {kDeadReckoningTooLong, "dead reckoning too long", kControlledStop, ms(1'520)},
    {kLocalizationUncertain, "position too uncertain", kControlledStop, kTick, kAllows, true},
    {kGnssUnitDisconnected, "GNSS unit disconnected", kControlledStop, ms(520), kAllows, true},
    {kGnssRateLost, "GNSS: both units miss the rate", kControlledStop, ms(1'220), kAllows, true},
    {kGnssSolutionLost, "GNSS: both units lost the solution", kControlledStop, ms(520), kAllows,
     true},
    {kImuLost, "IMU: both units lost", kControlledStop, ms(270)},
    {kRaceControlLost, "race control lost", kControlledStop, ms(10'020)},
    {kRaceControlReportedLost, "race control lost, says the drive-by-wire", kControlledStop,
     kReported},
    {kRadioLost, "base station lost", kControlledStop, ms(3'020), kRevokes},
    {kGnssRtkLost, "GNSS: both units lost RTK and their accuracy", kControlledStop, ms(220),
     kAllows, true},
    {kSteeringDeviates, "steering motor does not do as it is told", kControlledStop, ms(300)},
    {kSteeringBiased, "steering rod: the car turns otherwise than its motor", kControlledStop,
     ms(300)},
    {kBrakeDeviates, "brake does not do as it is told", kControlledStop, ms(300)},
    {kThrottleDeviates, "throttle does not do as it is told", kControlledStop, ms(300)},
    {kComputerLate, "computer misses too many ticks", kControlledStop, ms(2'500)},
    {kComputerMemory, "computer out of memory", kControlledStop, ms(1'020)},
    {kComputerHot, "computer too hot", kControlledStop, ms(1'020)},
    {kRearSpin, "over-steer: rear wheels spin", kCoast, kTick},
    {kRearLock, "over-steer: rear wheels lock", kCoast, kTick},
    {kYawExcess, "over-steer: the car yaws more than steered", kCoast, kTick},
    {kPositionPassing, "no good position", kCoast, ms(320)},
    {kPlanLate, "planning a beat late", kCoast, ms(145)},
    {kControlLate, "control a beat late", kCoast, ms(10)},
    {kFrontLock, "front wheels lock: less brake", kNotify, kTick},
    {kFlagsDisagree, "race control: flags unknown or contradictory", kNotify, kTick},
    {kRoundSpeedTooHigh, "race control: round speed above the car's, capped", kNotify, kTick},
    {kTicksMissed, "computer missed ticks", kNotify, kTick},
    {kProcessorBusy, "computer busy", kNotify, ms(1'020)},
    {kClockStepped, "a clock stepped", kNotify, ms(200), kBars},
    {kClockSkewed, "clock too fast or slow", kNotify, seconds(40), kBars},
    {kGnssDegraded, "GNSS: one unit is bad", kNotify, ms(1'220)},
  }};
  // clang-format on
}();

constexpr const CauseRow& row_of(Cause cause) {
  return kCauseTable[static_cast<std::size_t>(cause)];
}
constexpr const char* text_of(Cause cause) { return row_of(cause).text; }

template <class Property>
consteval bool every_cause(Property holds) {
  for (std::size_t i = 0; i < kCauses; ++i)
    if (!holds(kCauseTable[i], i)) return false;
  return true;
}
static_assert(every_cause([](const CauseRow& row, std::size_t i) {
                return static_cast<std::size_t>(row.cause) == i;
              }),
              "kCauseTable is indexed by Cause");
static_assert(every_cause([](const CauseRow& row, std::size_t) {
                return (row.reaction == Reaction::kNone) == (row.deadline == Duration{});
              }),
              "whatever is reacted to has a deadline");
static_assert(every_cause([](const CauseRow& row, std::size_t) {
                return row.reaction != Reaction::kEmergencyStop ||
                       row.arms != ArmingEffect::kAllows;
              }),
              "what would brake hard bars arming");

// Set of causes, usually those that hold in one tick.
class CauseSet {
 public:
  constexpr void add(Cause cause) { bits_ |= bit(cause); }
  constexpr bool has(Cause cause) const { return (bits_ & bit(cause)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::uint64_t bits() const { return bits_; }
  constexpr CauseSet without(CauseSet other) const { return CauseSet{bits_ & ~other.bits_}; }
  // First cause in order of precedence; kNone for an empty set.
  constexpr Cause first() const {
    for (std::size_t i = 1; i < kCauses; ++i)
      if (has(static_cast<Cause>(i))) return static_cast<Cause>(i);
    return Cause::kNone;
  }
  // Causes with this reaction or a more severe one.
  constexpr CauseSet at_least(Reaction reaction) const {
    CauseSet out;
    for (const CauseRow& row : kCauseTable)
      if (row.reaction >= reaction && has(row.cause)) out.add(row.cause);
    return out;
  }
  constexpr bool operator==(const CauseSet&) const = default;
  constexpr CauseSet() = default;

 private:
  constexpr explicit CauseSet(std::uint64_t bits) : bits_(bits) {}
  static constexpr std::uint64_t bit(Cause cause) {
    return cause == Cause::kNone ? 0 : std::uint64_t{1} << static_cast<unsigned>(cause);
  }
  std::uint64_t bits_ = 0;
};
static_assert(kCauses <= 64);

}  // namespace pitwall::safety
