// Event log of a bench run: one MCAP file with every CAN frame, the truth, the car's estimates and
// decisions, and events as text. Its SHA-256 identifies the run.
//   channels /can          every frame with its sender
//            /truth        the plant at 100 Hz
//            /car          the car at 100 Hz: ego state, mode, command
//            /bus_losses   missing frames that the car detected
//            /others       only with other cars: each of them in truth, at 100 Hz
//            /opponents    likewise: those that the car tracks, as it has them
//            /events       flags, modes, laps, contacts (with a car: to_json(CarContact)), verdicts
//                          ("pass", "fail": to_json(Verdict))
//   metadata run: scenario, seed, mode, duration, database, bus, track file, faults (JSON list)
//   invariants
//            the same scenario, build and seed give the same bytes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "hil/bench/field.hpp"
#include "hil/bench/rig.hpp"
#include "hil/grading/grader.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/recording/event_log.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::bench {

struct CanSample {
  std::uint8_t from = 0;  // Node
  std::uint32_t id = 0;
  FixedVector<std::uint8_t, 64> data;
};
constexpr recording::CdrName cdr_name(std::type_identity<CanSample>) { return "CanFrame"; }
constexpr auto cdr_fields(std::type_identity<CanSample>) {
  return std::tuple{recording::CdrField{"from_node", &CanSample::from},
                    recording::CdrField{"id", &CanSample::id},
                    recording::CdrField{"data", &CanSample::data}};
}

struct TruthSample {
  double x_m, y_m, yaw_rad, vx_mps, vy_mps, yaw_rate_rad_per_s, s_m, n_m, bank_rad;
  double steering_motor_rad, throttle, brake_kpa, engine_rpm, friction_use, wall_gap_m;
  double cross_track_m;     // from the line that the car has to drive; NaN: not graded
  double ax_mps2, ay_mps2;  // specific force in the plane of the road: forward, left
  double tyre_fl_c, tyre_fr_c, tyre_rl_c, tyre_rr_c;
  std::uint8_t gear, sys_state, ct_state, track_flag;
};
constexpr recording::CdrName cdr_name(std::type_identity<TruthSample>) { return "BenchTruth"; }
constexpr auto cdr_fields(std::type_identity<TruthSample>) {
  using recording::CdrField;
  using T = TruthSample;
  return std::tuple{CdrField{"x_m", &T::x_m},
                    CdrField{"y_m", &T::y_m},
                    CdrField{"yaw_rad", &T::yaw_rad},
                    CdrField{"vx_mps", &T::vx_mps},
                    CdrField{"vy_mps", &T::vy_mps},
                    CdrField{"yaw_rate_rad_per_s", &T::yaw_rate_rad_per_s},
                    CdrField{"s_m", &T::s_m},
                    CdrField{"n_m", &T::n_m},
                    CdrField{"bank_rad", &T::bank_rad},
                    CdrField{"steering_motor_rad", &T::steering_motor_rad},
                    CdrField{"throttle", &T::throttle},
                    CdrField{"brake_kpa", &T::brake_kpa},
                    CdrField{"engine_rpm", &T::engine_rpm},
                    CdrField{"friction_use", &T::friction_use},
                    CdrField{"wall_gap_m", &T::wall_gap_m},
                    CdrField{"cross_track_m", &T::cross_track_m},
                    CdrField{"ax_mps2", &T::ax_mps2},
                    CdrField{"ay_mps2", &T::ay_mps2},
                    CdrField{"tyre_fl_c", &T::tyre_fl_c},
                    CdrField{"tyre_fr_c", &T::tyre_fr_c},
                    CdrField{"tyre_rl_c", &T::tyre_rl_c},
                    CdrField{"tyre_rr_c", &T::tyre_rr_c},
                    CdrField{"gear", &T::gear},
                    CdrField{"sys_state", &T::sys_state},
                    CdrField{"ct_state", &T::ct_state},
                    CdrField{"track_flag", &T::track_flag}};
}

struct CarSample {
  double x_m, y_m, yaw_rad, vx_mps, vy_mps, yaw_rate_rad_per_s, position_sigma_m;
  double target_speed_mps, cross_track_m, road_wheel_rad, throttle, brake_kpa;
  std::uint8_t gear, mode, cause, validity, ct_state;
  std::uint64_t frames_refused, gate_refusals;
};
constexpr recording::CdrName cdr_name(std::type_identity<CarSample>) { return "CarState"; }
constexpr auto cdr_fields(std::type_identity<CarSample>) {
  using recording::CdrField;
  using T = CarSample;
  return std::tuple{CdrField{"x_m", &T::x_m},
                    CdrField{"y_m", &T::y_m},
                    CdrField{"yaw_rad", &T::yaw_rad},
                    CdrField{"vx_mps", &T::vx_mps},
                    CdrField{"vy_mps", &T::vy_mps},
                    CdrField{"yaw_rate_rad_per_s", &T::yaw_rate_rad_per_s},
                    CdrField{"position_sigma_m", &T::position_sigma_m},
                    CdrField{"target_speed_mps", &T::target_speed_mps},
                    CdrField{"cross_track_m", &T::cross_track_m},
                    CdrField{"road_wheel_rad", &T::road_wheel_rad},
                    CdrField{"throttle", &T::throttle},
                    CdrField{"brake_kpa", &T::brake_kpa},
                    CdrField{"gear", &T::gear},
                    CdrField{"mode", &T::mode},
                    CdrField{"cause", &T::cause},
                    CdrField{"validity", &T::validity},
                    CdrField{"ct_state", &T::ct_state},
                    CdrField{"frames_refused", &T::frames_refused},
                    CdrField{"gate_refusals", &T::gate_refusals}};
}

CarSample car_sample(const pipeline::Outputs& out);

struct LossSample {
  std::uint32_t id;  // 0: the detector does not identify it
  std::uint8_t detector;
  std::uint32_t frames;
  double due_s;  // since the start of the run; 0: unknown
};
constexpr recording::CdrName cdr_name(std::type_identity<LossSample>) { return "BusLoss"; }
constexpr auto cdr_fields(std::type_identity<LossSample>) {
  using recording::CdrField;
  using T = LossSample;
  return std::tuple{CdrField{"id", &T::id}, CdrField{"detector", &T::detector},
                    CdrField{"frames", &T::frames}, CdrField{"due_s", &T::due_s}};
}

struct OtherSample {
  std::uint8_t number;  // as race control has it
  double x_m, y_m, yaw_rad, vx_mps, vy_mps, s_m, n_m;
};
constexpr recording::CdrName cdr_name(std::type_identity<OtherSample>) { return "OtherCar"; }
constexpr auto cdr_fields(std::type_identity<OtherSample>) {
  using recording::CdrField;
  using T = OtherSample;
  return std::tuple{CdrField{"number", &T::number}, CdrField{"x_m", &T::x_m},
                    CdrField{"y_m", &T::y_m},       CdrField{"yaw_rad", &T::yaw_rad},
                    CdrField{"vx_mps", &T::vx_mps}, CdrField{"vy_mps", &T::vy_mps},
                    CdrField{"s_m", &T::s_m},       CdrField{"n_m", &T::n_m}};
}

struct OpponentSample {
  std::uint32_t id;
  double x_m, y_m, yaw_rad, speed_mps, s_m, n_m, position_sigma_m, age_s;
};
constexpr recording::CdrName cdr_name(std::type_identity<OpponentSample>) { return "Opponent"; }
constexpr auto cdr_fields(std::type_identity<OpponentSample>) {
  using recording::CdrField;
  using T = OpponentSample;
  return std::tuple{CdrField{"id", &T::id},
                    CdrField{"x_m", &T::x_m},
                    CdrField{"y_m", &T::y_m},
                    CdrField{"yaw_rad", &T::yaw_rad},
                    CdrField{"speed_mps", &T::speed_mps},
                    CdrField{"s_m", &T::s_m},
                    CdrField{"n_m", &T::n_m},
                    CdrField{"position_sigma_m", &T::position_sigma_m},
                    CdrField{"age_s", &T::age_s}};
}

class RunRecord {
 public:
  // `mode`: "lockstep" or "live". The metadata states that this is a simulation, the CAN database
  // that the car was built with (file, revision, fingerprint) and the revision of its bus.
  RunRecord(const scenario::Scenario& scenario, std::string_view mode, recording::Sink sink,
            bool has_others = false);

  void can(Node from, const can::Frame& frame, Instant at);
  void truth(const Rig& rig, Instant at, double cross_track_m = kUnset);
  // Includes the losses that the car detected in this tick.
  void car(const pipeline::Outputs& out, Instant at);
  void loss(const world::LossReport& loss);
  // All cars of the field but this one.
  void others(const Field& field, std::size_t own, Instant at);
  void event(Instant at, std::string_view name, std::string_view text);
  void contact(const CarContact& contact);
  void verdict(Instant at, const grading::Verdict& verdict);
  // Writes the summary; after it digest() is that of the whole file.
  bool close();
  std::string digest() const;
  recording::McapCounters counters() const { return log_.counters(); }

 private:
  recording::EventLog log_;
  recording::SampleChannel<CanSample> can_;
  recording::SampleChannel<TruthSample> truth_;
  recording::SampleChannel<CarSample> car_;
  recording::SampleChannel<LossSample> losses_;
  std::optional<recording::SampleChannel<OtherSample>> others_;
  std::optional<recording::SampleChannel<OpponentSample>> opponents_;
};

}  // namespace pitwall::bench
