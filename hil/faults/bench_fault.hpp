// Table of the faults that the bench carries out in its models: data only, one row per kind. The
// scenario file names them; `acts_on` gives the part of the bench that applies each.
//   units  of `value`: as given in the row; 0 if the kind needs none
//   invariants
//          a process killed for a duration is restarted at its end (never armed); one killed
//          without a duration stays dead; a paused one continues at the end. A base that is
//          replaced dies, and at the end a spare base starts at the second address of the car's
//          list. A base that moves has an address outside the list until the end of the fault
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::faults {

enum class BenchFaultKind : std::uint8_t {
  kGnssUnitOutage,
  kGnssRtkLost,
  kGnssVarianceSpike,
  kGnssPositionJump,
  kGnssHeadingFlip,
  kGnssStampFrozen,
  kImuBias,
  kImuOutage,
  kWheelSpeedLoss,
  kGnssNoSolution,
  kGnssSingle,
  kGnssRtkFloat,
  kGnssCorrectionsLost,
  kGnssNoise,
  kGnssPositionJumpNorth,
  kGnssPositionJumpUp,
  kGnssPositionJumpLeft,
  kGnssPositionJumpAhead,
  kGnssPositionDrift,
  kGnssPositionDriftAhead,
  kGnssPositionFrozen,
  kGnssStampFuture,
  kGnssStampBack,
  kGnssHeadingOffset,
  kGnssHeadingOutage,
  kGnssVelocityWrong,
  kGnssVelocityWrongLeft,
  kGnssNotANumber,
  kGnssNegativeSigma,
  kGnssLatency,
  kGnssGaps,
  kImuAccelBias,
  kImuAccelBiasLeft,
  kImuGyroScale,
  kImuFrozen,
  kImuNotANumber,
  kWheelLoss,
  kWheelLock,
  kWheelSpin,
  kLidarOutage,
  kLidarLate,
  kCameraOutage,
  kRadarOutage,
  kDust,
  kRadioLoss,
  kRadioDown,
  kRadioDelay,
  kBaseStationSilent,
  kRaceControlSilent,
  kRaceHeartbeatStop,
  kWrongRoundSpeed,
  kSteeringStuck,
  kSteeringSlow,
  kSteeringBias,
  kBrakeLeak,
  kBrakeStuck,
  kBrakeCircuitLost,
  kThrottleStuck,
  kEngineStall,
  kColdTyres,
  kLowGrip,
  kFuelOut,
  kBusSilent,
  kBusBabble,
  kComputerSilent,
  kComputerPaused,
  kComputerKilled,
  kComputerSlow,
  kGuardianKilled,
  kBaseKilled,
  kBasePaused,
  kClockStep,
  kClockSkew,
  kLogDiskFull,
  kBusErrors,
  kBusTransmitter,
  kTransmitStall,
  kGnssBytesDamaged,
  kGpsTimeStep,
  kBaseMoved,
  kBaseReplaced,
  kPlannerHangs,
  kFlagsLate
};

enum class BenchPart : std::uint8_t {
  kGnss,
  kImu,
  kWheels,
  kPerception,
  kRadio,
  kRaceControl,
  kActuators,
  kPlant,
  kBus,
  kComputer,
  kClock,
  kRecorder
};

struct BenchFaultRow {
  BenchFaultKind kind;
  std::string_view name;  // in scenario files
  BenchPart acts_on;
  std::string_view value;  // meaning and unit of BenchFault::value; empty: unused
};

struct BenchFault {
  BenchFaultKind kind = BenchFaultKind::kGnssUnitOutage;
  Instant start{};
  std::optional<Duration> duration{};  // absent: until the end
  std::uint8_t unit = 0;               // index of one of several equal parts, from 0
  double value = 0.0;
  std::uint64_t seed = 1;
};

inline constexpr std::size_t kBrakeCircuits = 2;  // unit 0: front, unit 1: rear

inline constexpr std::size_t kBenchFaultKinds = 83;
extern const std::array<BenchFaultRow, kBenchFaultKinds> kBenchFaults;

const BenchFaultRow& row_of(BenchFaultKind kind);
std::optional<BenchFaultKind> bench_fault_kind(std::string_view name);

bool active(const BenchFault& fault, Instant now);

}  // namespace pitwall::faults
