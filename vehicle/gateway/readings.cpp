// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/readings.hpp"

#include <algorithm>

#include "protocol/can/av21.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/gateway/flag_tables.hpp"
#include "vehicle/gateway/plausibility.hpp"

namespace pitwall::gateway {
namespace {

namespace av21 = can::av21;
using world::Corner;

constexpr double kPercent = 0.01;
constexpr double kKpaPerMbar = 0.1;

template <class T>
void receive(world::Received<T>& slot, const T& value, Instant at) {
  slot = {value, at, true};
}

Reading take(Context& c, const av21::WheelSpeedReport& m) {
  const Span& span = c.params.wheel_speed_mps;
  const world::PerWheel wheels{{from_kmh(m.wheel_speed_FL), from_kmh(m.wheel_speed_FR),
                                from_kmh(m.wheel_speed_RL), from_kmh(m.wheel_speed_RR)}};
  constexpr auto kId = av21::WheelSpeedReport::kId;
  const Reading reading = accept(
      c,
      std::array<Ranged, world::kCorners>{
          {{wheels.at[0], span}, {wheels.at[1], span}, {wheels.at[2], span}, {wheels.at[3], span}}},
      std::array<Change, world::kCorners>{{{slew_row(kId, "wheel_speed_FL"), m.wheel_speed_FL},
                                           {slew_row(kId, "wheel_speed_FR"), m.wheel_speed_FR},
                                           {slew_row(kId, "wheel_speed_RL"), m.wheel_speed_RL},
                                           {slew_row(kId, "wheel_speed_RR"), m.wheel_speed_RR}}});
  if (reading != Reading::kApplied) return reading;
  world::VehicleSignals& signals = c.state.signals;
  signals.wheel_speed_before_mps = signals.wheel_speed_mps;
  receive(signals.wheel_speed_mps, wheels, c.at);
  return reading;
}

Reading take(Context& c, const av21::BrakePressureReport& m) {
  const Span& span = c.params.brake_kpa;
  constexpr auto kId = av21::BrakePressureReport::kId;
  const Reading reading =
      accept(c,
             std::array<Ranged, 2>{
                 {{m.brake_pressure_fdbk_front, span}, {m.brake_pressure_fdbk_rear, span}}},
             std::array<Change, 2>{
                 {{slew_row(kId, "brake_pressure_fdbk_front"), m.brake_pressure_fdbk_front},
                  {slew_row(kId, "brake_pressure_fdbk_rear"), m.brake_pressure_fdbk_rear}}});
  if (reading == Reading::kApplied)
    receive(c.state.signals.brake,
            world::BrakePressure{m.brake_pressure_fdbk_front, m.brake_pressure_fdbk_rear}, c.at);
  return reading;
}

Reading take(Context& c, const av21::AcceleratorReport& m) {
  constexpr auto kId = av21::AcceleratorReport::kId;
  const double fraction = m.acc_pedal_fdbk * kPercent;
  const Reading reading =
      accept(c, std::array<Ranged, 1>{{{fraction, c.params.throttle_fraction}}},
             std::array<Change, 1>{{{slew_row(kId, "acc_pedal_fdbk"), m.acc_pedal_fdbk}}});
  if (reading == Reading::kApplied) receive(c.state.signals.throttle_fraction, fraction, c.at);
  return reading;
}

Reading take(Context& c, const av21::SteeringReport& m) {
  constexpr auto kId = av21::SteeringReport::kId;
  const double angle_deg = m.steering_motor_ang_avg_fdbk;
  const Reading reading =
      accept(c, std::array<Ranged, 1>{{{angle_deg, c.params.steering_motor_deg}}},
             std::array<Change, 1>{{{slew_row(kId, "steering_motor_ang_avg_fdbk"), angle_deg}}});
  if (reading == Reading::kApplied)
    receive(c.state.signals.steering_motor_rad, from_deg(angle_deg), c.at);
  return reading;
}

constexpr bool is_sys_state(double raw) {
  constexpr double kLast = static_cast<double>(world::SysState::kStandby);
  constexpr double kDefault = static_cast<double>(world::SysState::kDefault);
  return (raw >= 0.0 && raw <= kLast) || raw == kDefault;
}

Reading take(Context& c, const av21::MiscReport& m) {
  const Reading reading =
      accept(c, std::array<Ranged, 1>{{{m.battery_voltage, c.params.battery_v}}});
  if (reading != Reading::kApplied) return reading;
  const bool ranged = !c.params.off.has(world::Monitor::kDecodedRange);
  if (ranged && !is_sys_state(m.sys_state)) return Reading::kOutOfRange;
  const auto sys = static_cast<world::SysState>(static_cast<std::uint8_t>(m.sys_state));
  receive(c.state.signals.misc,
          world::Misc{.battery_v = m.battery_voltage,
                      .sys_state = sys,
                      .mode_switch = static_cast<std::uint8_t>(m.mode_switch_state),
                      .safety_switch = static_cast<std::uint8_t>(m.safety_switch_state)},
          c.at);
  return Reading::kApplied;
}

Reading take(Context& c, const av21::PtReport1& m) {
  constexpr auto kId = av21::PtReport1::kId;
  constexpr double kShiftStates = 4.0;
  const double fraction = m.throttle_position * kPercent;
  const double speed_mps = from_kmh(m.vehicle_speed_kmph);
  const Reading reading =
      accept(c,
             std::array<Ranged, 5>{{{fraction, c.params.throttle_fraction},
                                    {m.engine_speed_rpm, c.params.engine_speed_rpm},
                                    {speed_mps, c.params.wheel_speed_mps},
                                    {m.current_gear, {0.0, static_cast<double>(c.params.gear_max)}},
                                    {m.gear_shift_status, {0.0, kShiftStates}}}},
             std::array<Change, 3>{{{slew_row(kId, "throttle_position"), m.throttle_position},
                                    {slew_row(kId, "engine_speed_rpm"), m.engine_speed_rpm},
                                    {slew_row(kId, "vehicle_speed_kmph"), m.vehicle_speed_kmph}}});
  if (reading != Reading::kApplied) return reading;
  receive(c.state.signals.powertrain,
          world::Powertrain{.throttle_fraction = fraction,
                            .engine_speed_rpm = m.engine_speed_rpm,
                            .vehicle_speed_mps = speed_mps,
                            .gear = static_cast<std::uint8_t>(m.current_gear),
                            .engine_running = m.engine_state > 0.0,
                            .engine_switch_on = m.engine_run_switch > 0.0,
                            .gear_shift_status = static_cast<std::uint8_t>(m.gear_shift_status)},
          c.at);
  return Reading::kApplied;
}

Reading take(Context& c, const av21::PtReport2& m) {
  receive(c.state.signals.engine,
          world::EngineHealth{.fuel_pressure_kpa = m.fuel_pressure_kPa,
                              .oil_pressure_kpa = m.engine_oil_pressure_kPa,
                              .coolant_c = m.coolant_temperature,
                              .transmission_c = m.transmission_temperature,
                              .transmission_pressure_kpa = m.transmission_pressure_kPa},
          c.at);
  return Reading::kApplied;
}

Reading take(Context& c, const av21::DiagnosticReport& m) {
  const auto set = [](double bit) { return bit > 0.0; };
  receive(c.state.signals.diagnostics,
          world::DriveByWireDiagnostics{
              .system_warning = set(m.sd_system_warning),
              .system_failure = set(m.sd_system_failure),
              .brake_warning = {set(m.sd_brake_warning1), set(m.sd_brake_warning2),
                                set(m.sd_brake_warning3)},
              .steer_warning = {set(m.sd_steer_warning1), set(m.sd_steer_warning2),
                                set(m.sd_steer_warning3)},
              .motec_warning = static_cast<std::uint8_t>(m.motec_warning),
              .front_brake_out_of_spec = set(m.est1_oos_front_brk),
              .rear_brake_out_of_spec = set(m.est2_oos_rear_brk),
              .low_engine_speed = set(m.est3_low_eng_speed),
              .steer_comms_lost = set(m.est4_sd_comms_loss),
              .motec_comms_lost = set(m.est5_motec_comms_loss),
              .emergency_brake = set(m.est6_sd_ebrake),
              .computer_heartbeat_lost = set(m.adlink_hb_lost),
              .race_control_lost = set(m.rc_lost)},
          c.at);
  return Reading::kApplied;
}

Reading pressure(Context& c, Corner corner, double gauge_mbar) {
  const double gauge_kpa = gauge_mbar * kKpaPerMbar;
  const Reading reading =
      accept(c, std::array<Ranged, 1>{{{gauge_kpa, c.params.tyre_pressure_kpa}}});
  if (reading != Reading::kApplied) return reading;
  auto& slot = c.state.signals.tyre_pressure_kpa;
  slot.value[corner] = gauge_kpa;
  slot.at = c.at;
  slot.received = true;
  return Reading::kApplied;
}

Reading take(Context& c, const av21::TirePressureFl& m) {
  return pressure(c, Corner::kFrontLeft, m.FL_Tire_Pressure_Gauge);
}
Reading take(Context& c, const av21::TirePressureFr& m) {
  return pressure(c, Corner::kFrontRight, m.FR_Tire_Pressure_Gauge);
}
Reading take(Context& c, const av21::TirePressureRl& m) {
  return pressure(c, Corner::kRearLeft, m.RL_Tire_Pressure_Gauge);
}
Reading take(Context& c, const av21::TirePressureRr& m) {
  return pressure(c, Corner::kRearRight, m.RR_Tire_Pressure_Gauge);
}

constexpr std::size_t kTyreParts = 4;
constexpr std::uint8_t kAllParts = (1u << kTyreParts) - 1u;
using TyrePart = std::array<double, kTyreSensors / kTyreParts>;

// A quarter of a tyre's sensors; the mean is given once all four quarters were heard.
Reading temperatures(Context& c, Corner corner, std::size_t part, const TyrePart& sensor_c) {
  for (const double t_c : sensor_c) {
    const Reading reading = accept(c, std::array<Ranged, 1>{{{t_c, c.params.tyre_temperature_c}}});
    if (reading != Reading::kApplied) return reading;
  }
  const auto tyre = static_cast<std::size_t>(corner);
  auto& sensors = c.state.tyre_sensor_c[tyre];
  std::copy(sensor_c.begin(), sensor_c.end(),
            sensors.begin() + static_cast<std::ptrdiff_t>(part * sensor_c.size()));
  auto& incoming = c.state.tyre_messages_received[tyre];
  incoming = static_cast<std::uint8_t>(incoming | (1u << part));
  if (incoming != kAllParts) return Reading::kApplied;
  double sum_c = 0.0;
  for (const double t_c : sensors) sum_c += t_c;
  auto& slot = c.state.signals.tyre_temperature_c;
  slot.value[corner] = sum_c / static_cast<double>(kTyreSensors);
  slot.at = c.at;
  slot.received = true;
  return Reading::kApplied;
}

Reading take(Context& c, const av21::TireTempFl1& m) {
  return temperatures(c, Corner::kFrontLeft, 0,
                      {m.FL_Tire_Temp_01, m.FL_Tire_Temp_02, m.FL_Tire_Temp_03, m.FL_Tire_Temp_04});
}
Reading take(Context& c, const av21::TireTempFl2& m) {
  return temperatures(c, Corner::kFrontLeft, 1,
                      {m.FL_Tire_Temp_05, m.FL_Tire_Temp_06, m.FL_Tire_Temp_07, m.FL_Tire_Temp_08});
}
Reading take(Context& c, const av21::TireTempFl3& m) {
  return temperatures(c, Corner::kFrontLeft, 2,
                      {m.FL_Tire_Temp_09, m.FL_Tire_Temp_10, m.FL_Tire_Temp_11, m.FL_Tire_Temp_12});
}
Reading take(Context& c, const av21::TireTempFl4& m) {
  return temperatures(c, Corner::kFrontLeft, 3,
                      {m.FL_Tire_Temp_13, m.FL_Tire_Temp_14, m.FL_Tire_Temp_15, m.FL_Tire_Temp_16});
}
Reading take(Context& c, const av21::TireTempFr1& m) {
  return temperatures(c, Corner::kFrontRight, 0,
                      {m.FR_Tire_Temp_01, m.FR_Tire_Temp_02, m.FR_Tire_Temp_03, m.FR_Tire_Temp_04});
}
Reading take(Context& c, const av21::TireTempFr2& m) {
  return temperatures(c, Corner::kFrontRight, 1,
                      {m.FR_Tire_Temp_05, m.FR_Tire_Temp_06, m.FR_Tire_Temp_07, m.FR_Tire_Temp_08});
}
Reading take(Context& c, const av21::TireTempFr3& m) {
  return temperatures(c, Corner::kFrontRight, 2,
                      {m.FR_Tire_Temp_09, m.FR_Tire_Temp_10, m.FR_Tire_Temp_11, m.FR_Tire_Temp_12});
}
Reading take(Context& c, const av21::TireTempFr4& m) {
  return temperatures(c, Corner::kFrontRight, 3,
                      {m.FR_Tire_Temp_13, m.FR_Tire_Temp_14, m.FR_Tire_Temp_15, m.FR_Tire_Temp_16});
}
Reading take(Context& c, const av21::TireTempRl1& m) {
  return temperatures(c, Corner::kRearLeft, 0,
                      {m.RL_Tire_Temp_01, m.RL_Tire_Temp_02, m.RL_Tire_Temp_03, m.RL_Tire_Temp_04});
}
Reading take(Context& c, const av21::TireTempRl2& m) {
  return temperatures(c, Corner::kRearLeft, 1,
                      {m.RL_Tire_Temp_05, m.RL_Tire_Temp_06, m.RL_Tire_Temp_07, m.RL_Tire_Temp_08});
}
Reading take(Context& c, const av21::TireTempRl3& m) {
  return temperatures(c, Corner::kRearLeft, 2,
                      {m.RL_Tire_Temp_09, m.RL_Tire_Temp_10, m.RL_Tire_Temp_11, m.RL_Tire_Temp_12});
}
Reading take(Context& c, const av21::TireTempRl4& m) {
  return temperatures(c, Corner::kRearLeft, 3,
                      {m.RL_Tire_Temp_13, m.RL_Tire_Temp_14, m.RL_Tire_Temp_15, m.RL_Tire_Temp_16});
}
Reading take(Context& c, const av21::TireTempRr1& m) {
  return temperatures(c, Corner::kRearRight, 0,
                      {m.RR_Tire_Temp_01, m.RR_Tire_Temp_02, m.RR_Tire_Temp_03, m.RR_Tire_Temp_04});
}
Reading take(Context& c, const av21::TireTempRr2& m) {
  return temperatures(c, Corner::kRearRight, 1,
                      {m.RR_Tire_Temp_05, m.RR_Tire_Temp_06, m.RR_Tire_Temp_07, m.RR_Tire_Temp_08});
}
Reading take(Context& c, const av21::TireTempRr3& m) {
  return temperatures(c, Corner::kRearRight, 2,
                      {m.RR_Tire_Temp_09, m.RR_Tire_Temp_10, m.RR_Tire_Temp_11, m.RR_Tire_Temp_12});
}
Reading take(Context& c, const av21::TireTempRr4& m) {
  return temperatures(c, Corner::kRearRight, 3,
                      {m.RR_Tire_Temp_13, m.RR_Tire_Temp_14, m.RR_Tire_Temp_15, m.RR_Tire_Temp_16});
}

std::uint8_t byte_of(double raw) { return static_cast<std::uint8_t>(raw); }

Reading take(Context& c, const av21::BaseToCarSummary& m) {
  FlagSource& source = c.state.mylaps;
  const std::uint8_t heartbeat = byte_of(m.base_to_car_heartbeat);
  if (!source.received || heartbeat != source.heartbeat) source.last_change = c.at;
  source.received = true;
  source.heartbeat = heartbeat;
  source.raw_track = byte_of(m.track_flag);
  source.raw_vehicle = byte_of(m.veh_flag);
  source.lap_count = byte_of(m.lap_count);
  source.track = track_meaning(world::FlagEncoding::kMyLaps, source.raw_track).flag;
  source.vehicle = vehicle_meaning(world::FlagEncoding::kMyLaps, source.raw_vehicle);
  // 0 mph is how the field says "no target": a stop is a flag.
  source.round_target_speed_mps =
      m.round_target_speed > 0.0 ? from_mph(m.round_target_speed) : kUnset;
  return Reading::kApplied;
}

Reading take(Context& c, const av21::MarelliReport1& m) {
  FlagSource& source = c.state.marelli;
  // No heartbeat in this encoding: the receiver's own bit says whether it hears the base.
  if (!source.received || m.marelli_rc_base_sync_check > 0.0) source.last_change = c.at;
  source.received = true;
  source.raw_track = byte_of(m.marelli_track_flag);
  source.raw_vehicle = byte_of(m.marelli_vehicle_flag);
  source.raw_sector = byte_of(m.marelli_sector_flag);
  const TrackMeaning meaning = track_meaning(world::FlagEncoding::kMarelli, source.raw_track);
  source.track = meaning.flag;
  source.round_target_speed_mps = meaning.round_target_speed_mps;
  source.vehicle = vehicle_meaning(world::FlagEncoding::kMarelli, source.raw_vehicle);
  return Reading::kApplied;
}

Reading take(Context& c, const av21::RestOfField& m) {
  world::Received<world::RivalReport>& rival = c.state.signals.rival;
  rival.value = {.number = byte_of(m.comp_veh_num),
                 .rank = byte_of(m.comp_rank),
                 .laps = byte_of(m.comp_laps_count),
                 .lap_distance_m = m.comp_lap_distance,
                 .speed_mps = from_kmh(m.comp_speed)};
  rival.at = c.at;
  rival.received = true;
  return Reading::kApplied;
}

template <class M>
Reading decoded(Context& c, const can::Frame& frame) {
  M message;
  CHECK(av21::decode(frame, message));  // id, length and kind were checked before
  return take(c, message);
}

struct Reader {
  std::uint32_t id;
  Reading (*read)(Context&, const can::Frame&);
};
template <class M>
constexpr Reader reader() {
  return {M::kId, &decoded<M>};
}

// Messages of the database that are not listed are watched for liveness only.
constexpr std::array kReaders{
    reader<av21::BaseToCarSummary>(),  reader<av21::MarelliReport1>(),
    reader<av21::WheelSpeedReport>(),  reader<av21::BrakePressureReport>(),
    reader<av21::AcceleratorReport>(), reader<av21::SteeringReport>(),
    reader<av21::MiscReport>(),        reader<av21::TirePressureFl>(),
    reader<av21::TirePressureFr>(),    reader<av21::TirePressureRl>(),
    reader<av21::TirePressureRr>(),    reader<av21::TireTempFl1>(),
    reader<av21::TireTempFl2>(),       reader<av21::TireTempFl3>(),
    reader<av21::TireTempFl4>(),       reader<av21::TireTempFr1>(),
    reader<av21::TireTempFr2>(),       reader<av21::TireTempFr3>(),
    reader<av21::TireTempFr4>(),       reader<av21::TireTempRl1>(),
    reader<av21::TireTempRl2>(),       reader<av21::TireTempRl3>(),
    reader<av21::TireTempRl4>(),       reader<av21::TireTempRr1>(),
    reader<av21::TireTempRr2>(),       reader<av21::TireTempRr3>(),
    reader<av21::TireTempRr4>(),       reader<av21::PtReport1>(),
    reader<av21::PtReport2>(),         reader<av21::DiagnosticReport>(),
    reader<av21::RestOfField>()};

}  // namespace

Reading apply(const InboundParams& params, InboundState& state,
              const can::ReceivedFrame& received) {
  Context context{params, state, received.at};
  for (const Reader& reader : kReaders)
    if (reader.id == received.frame.id) return reader.read(context, received.frame);
  return Reading::kApplied;
}

}  // namespace pitwall::gateway
