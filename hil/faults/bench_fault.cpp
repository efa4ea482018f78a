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
    {Kind::kGnssNoSolution, "gnss_no_solution", Part::kGnss, ""},
    {Kind::kGnssSingle, "gnss_single", Part::kGnss, ""},
    {Kind::kGnssRtkFloat, "gnss_rtk_float", Part::kGnss,
     "seconds: time constant of its convergence"},
    {Kind::kGnssCorrectionsLost, "gnss_corrections_lost", Part::kGnss,
     "m/s that the deviation grows by"},
    {Kind::kGnssNoise, "gnss_noise", Part::kGnss,
     "factor on the noise, not on the deviation reported"},
    {Kind::kGnssPositionJumpNorth, "gnss_position_jump_north", Part::kGnss, "metres north"},
    {Kind::kGnssPositionJumpUp, "gnss_position_jump_up", Part::kGnss, "metres up"},
    {Kind::kGnssPositionJumpLeft, "gnss_position_jump_left", Part::kGnss,
     "metres to the car's left"},
    {Kind::kGnssPositionJumpAhead, "gnss_position_jump_ahead", Part::kGnss,
     "metres ahead of the car"},
    {Kind::kGnssPositionDrift, "gnss_position_drift", Part::kGnss, "m/s to the car's left"},
    {Kind::kGnssPositionDriftAhead, "gnss_position_drift_ahead", Part::kGnss,
     "m/s ahead of the car"},
    {Kind::kGnssPositionFrozen, "gnss_position_frozen", Part::kGnss, ""},
    {Kind::kGnssStampFuture, "gnss_stamp_future", Part::kGnss, "seconds"},
    {Kind::kGnssStampBack, "gnss_stamp_back", Part::kGnss, "seconds"},
    {Kind::kGnssHeadingOffset, "gnss_heading_offset", Part::kGnss, "rad, clockwise"},
    {Kind::kGnssHeadingOutage, "gnss_heading_outage", Part::kGnss, ""},
    {Kind::kGnssVelocityWrong, "gnss_velocity_wrong", Part::kGnss, "m/s ahead of the car"},
    {Kind::kGnssVelocityWrongLeft, "gnss_velocity_wrong_left", Part::kGnss,
     "m/s to the car's left"},
    {Kind::kGnssNotANumber, "gnss_not_a_number", Part::kGnss, ""},
    {Kind::kGnssNegativeSigma, "gnss_negative_sigma", Part::kGnss, ""},
    {Kind::kGnssLatency, "gnss_latency", Part::kGnss, "seconds"},
    {Kind::kGnssGaps, "gnss_gaps", Part::kGnss, "share of the epochs that never come"},
    {Kind::kImuAccelBias, "imu_accel_bias", Part::kImu, "m/s^2 ahead"},
    {Kind::kImuAccelBiasLeft, "imu_accel_bias_left", Part::kImu, "m/s^2 to the left"},
    {Kind::kImuGyroScale, "imu_gyro_scale", Part::kImu, "factor on the rates"},
    {Kind::kImuFrozen, "imu_frozen", Part::kImu, ""},
    {Kind::kImuNotANumber, "imu_not_a_number", Part::kImu, ""},
    {Kind::kWheelLoss, "wheel_loss", Part::kWheels, ""},
    {Kind::kWheelLock, "wheel_lock", Part::kWheels, ""},
    {Kind::kWheelSpin, "wheel_spin", Part::kWheels, "factor on the speed"},
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
    {Kind::kBrakeStuck, "brake_stuck", Part::kActuators, "kPa in both circuits, whatever is asked"},
    {Kind::kBrakeCircuitLost, "brake_circuit_lost", Part::kActuators, ""},
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
    {Kind::kBusErrors, "bus_errors", Part::kBus, "probability that a bit is seen wrong"},
    {Kind::kBusTransmitter, "bus_transmitter", Part::kBus,
     "share of the computer's frames that are destroyed"},
    {Kind::kTransmitStall, "transmit_stall", Part::kBus, ""},
    {Kind::kGnssBytesDamaged, "gnss_bytes_damaged", Part::kGnss,
     "share of the messages that are damaged"},
    {Kind::kGpsTimeStep, "gps_time_step", Part::kClock, "seconds by which all receivers step"},
    {Kind::kBaseMoved, "base_moved", Part::kRadio, ""},
    {Kind::kBaseReplaced, "base_replaced", Part::kRadio, ""},
    {Kind::kPlannerHangs, "planner_hangs", Part::kComputer, ""},
    {Kind::kFlagsLate, "flags_late", Part::kRaceControl, "seconds"},
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
