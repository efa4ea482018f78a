// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/bench_fault.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::faults {

using Kind = BenchFaultKind;
using Part = BenchPart;

constexpr std::array<BenchFaultRow, kBenchFaultKinds> kBenchFaults{{
    {Kind::kGnssUnitOutage, "gnss_unit_outage", Part::kGnss, ""},
    {Kind::kGnssRtkLost, "gnss_rtk_lost", Part::kGnss, ""},
    {Kind::kGnssVarianceSpike, "gnss_variance_spike", Part::kGnss, "factor on the deviation"},
    {Kind::kGnssPositionJump, "gnss_position_jump", Part::kGnss, "metres east"},
    {Kind::kGnssHeadingFlip, "gnss_heading_flip", Part::kGnss, ""},
    {Kind::kGnssStampFrozen, "gnss_stamp_frozen", Part::kGnss, ""},
    {Kind::kImuBias, "imu_bias", Part::kImu, "rad/s on the yaw rate"},
    {Kind::kImuOutage, "imu_outage", Part::kImu, ""},
    {Kind::kWheelSpeedLoss, "wheel_speed_loss", Part::kWheels, ""},
    {Kind::kLidarOutage, "lidar_outage", Part::kPerception, ""},
    {Kind::kLidarLate, "lidar_late", Part::kPerception, "seconds"},
    {Kind::kCameraOutage, "camera_outage", Part::kPerception, ""},
    {Kind::kRadarOutage, "radar_outage", Part::kPerception, ""},
    {Kind::kDust, "dust", Part::kPerception, "false detections per second"},
    {Kind::kRadioLoss, "radio_loss", Part::kRadio, "probability"},
    {Kind::kRadioDown, "radio_down", Part::kRadio, ""},
    {Kind::kRadioDelay, "radio_delay", Part::kRadio, "seconds"},
    {Kind::kBaseStationSilent, "base_station_silent", Part::kRadio, ""},
    {Kind::kRaceControlSilent, "race_control_silent", Part::kRaceControl, ""},
    {Kind::kRaceHeartbeatStop, "race_heartbeat_stop", Part::kRaceControl, ""},
    {Kind::kWrongRoundSpeed, "wrong_round_speed", Part::kRaceControl, "mph"},
    {Kind::kSteeringStuck, "steering_stuck", Part::kActuators, ""},
    {Kind::kSteeringSlow, "steering_slow", Part::kActuators, "rad/s at the motor"},
    {Kind::kSteeringBias, "steering_bias", Part::kActuators, "rad at the motor"},
    {Kind::kBrakeLeak, "brake_leak", Part::kActuators, "share of the pressure that is lost"},
    {Kind::kThrottleStuck, "throttle_stuck", Part::kActuators, ""},
    {Kind::kEngineStall, "engine_stall", Part::kPlant, ""},
    {Kind::kColdTyres, "cold_tyres", Part::kPlant, "degrees Celsius"},
    {Kind::kLowGrip, "low_grip", Part::kPlant, "factor on the friction"},
    {Kind::kFuelOut, "fuel_out", Part::kPlant, ""},
    {Kind::kBusSilent, "bus_silent", Part::kBus, ""},
    {Kind::kBusBabble, "bus_babble", Part::kBus, "share of the bus"},
    {Kind::kComputerSilent, "computer_silent", Part::kComputer, ""},
    {Kind::kComputerPaused, "computer_paused", Part::kComputer, ""},
    {Kind::kComputerKilled, "computer_killed", Part::kComputer, ""},
    {Kind::kComputerSlow, "computer_slow", Part::kComputer, "share of the time that it is stopped"},
    {Kind::kGuardianKilled, "guardian_killed", Part::kComputer, ""},
    {Kind::kBaseKilled, "base_killed", Part::kRadio, ""},
    {Kind::kBasePaused, "base_paused", Part::kRadio, ""},
    {Kind::kClockStep, "clock_step", Part::kClock, "seconds"},
    {Kind::kClockSkew, "clock_skew", Part::kClock, "parts per million"},
    {Kind::kLogDiskFull, "log_disk_full", Part::kRecorder, ""},
}};

const BenchFaultRow& row_of(BenchFaultKind kind) {
  const auto index = static_cast<std::size_t>(kind);
  CHECK(index < kBenchFaults.size() && kBenchFaults[index].kind == kind);
  return kBenchFaults[index];
}

std::optional<BenchFaultKind> bench_fault_kind(std::string_view name) {
  for (const BenchFaultRow& row : kBenchFaults)
    if (row.name == name) return row.kind;
  return std::nullopt;
}

bool active(const BenchFault& fault, Instant now) {
  return now >= fault.start && (!fault.duration || now < fault.start + *fault.duration);
}

}  // namespace pitwall::faults
