// Simulated world around the car's computer: plant, drive-by-wire, race control, sensors, timing,
// faults. The owner of the clock advances it by one plant step at a time: the lockstep bench in
// virtual time, the live bench in real time. Plant and road include the perturbations of the
// scenario; the map of the car does not.
//   in     frames that the car's computer sent, now (a whole number of kRigStep since the start)
//   out    frames for the bus, sensor samples, truth
//   errors build(): Problem with the place in the scenario; later only counters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hil/bench/fault_plan.hpp"
#include "hil/faults/delay_queue.hpp"
#include "hil/nodes/can_variant.hpp"
#include "hil/nodes/lap_timer.hpp"
#include "hil/nodes/race_control.hpp"
#include "hil/nodes/raptor.hpp"
#include "hil/plant/plant.hpp"
#include "hil/plant/road_surface.hpp"
#include "hil/scenario/scenario.hpp"
#include "hil/sensors/sensors.hpp"
#include "hil/sensors/wheel_speeds.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

inline constexpr Duration kRigStep = milliseconds(1);

// kStranger: an unknown node that sends only during a fault.
enum class Node : std::uint8_t { kCar, kDriveByWire, kRaceControl, kGuardian, kStranger };
inline constexpr std::uint8_t kNodes = 5;

struct Outgoing {
  Node from = Node::kDriveByWire;
  can::Frame frame;
};
inline constexpr std::size_t kMaxOutgoing = 128;

struct Laps {
  std::uint32_t finished = 0, flying = 0;
  double best_flying_mean_mps = 0.0;  // 0 before the first flying lap
  double best_flying_s = kUnset;
  double last_s = kUnset;
};

class Rig {
 public:
  static Result<Rig, Problem> build(const scenario::Scenario& scenario,
                                    const world::TrackMap& track);

  void step(std::span<const can::ReceivedFrame> from_car, Instant now);
  // Adds a fault of the models to those of the scenario.
  void add_fault(const faults::BenchFault& fault) { plan_.models.push_back(fault); }

  // A call of the judge, in place of what race control's script says.
  void call_race_control(const race::Call& call) { race::call(race_, call); }

  // What race control's timing says of another car, from now on.
  void show_rival(const std::optional<race::Rival>& rival) { rival_ = rival; }

  // Frames that the nodes sent since the last call; valid until the next step.
  std::span<const Outgoing> take_frames();
  // Samples of the sensors since the last call.
  bool has_samples() const {
    return !(samples_.imu.empty() && samples_.positions.empty() && samples_.velocities.empty() &&
             samples_.headings.empty() && samples_.attitudes.empty() && samples_.receivers.empty());
  }
  world::SensorInput take_samples();

  const plant::Truth& truth() const { return truth_; }
  const plant::Road& road() const { return road_; }
  double length_m() const { return plant_params_.chassis.length_m; }
  double width_m() const { return plant_params_.chassis.width_m; }
  const Laps& laps() const { return laps_; }
  const race::Flags& flags() const { return race_.flags; }
  double round_target_speed_mph() const { return race_.round_target_speed_mph; }
  world::SysState system_state() const { return raptor_.system; }
  world::CtState ct_state() const { return raptor_.ct_state; }
  std::uint64_t overflows() const { return overflows_; }              // lost to full queues
  std::uint64_t actuator_frames() const { return actuator_frames_; }  // 1400-1403 on the bus

 private:
  Rig(const world::TrackMap& track, FaultPlan plan, can_variant::CanVariant variant)
      : track_(track), plan_(std::move(plan)), variant_(std::move(variant)) {}
  // The received frames in the encoding of the drive-by-wire model.
  std::span<const can::ReceivedFrame> understood(std::span<const can::ReceivedFrame> received);
  void apply_model_faults(Instant now);
  void apply_model_fault(const faults::BenchFault& fault, Instant now);
  void step_plant();
  plant::Surface true_road() const;  // under the car, with perturbations and faults
  void encode_frames(Node from, const can::Frame& frame,
                     Instant now);  // in the encoding of the variant
  void send(Node from, const can::Frame& frame, Instant now);
  void release_delayed(Instant now);
  void time_laps(Instant now);
  drive_by_wire::Feedback feedback() const;

  world::TrackMap track_;
  FaultPlan plan_;
  can_variant::CanVariant variant_;
  std::vector<can::ReceivedFrame> understood_;
  faults::FrameFaultState frame_faults_;
  std::array<faults::DelayQueue, kNodes> delayed_;  // by sender
  scenario::Perturbations perturb_;
  plant::Params plant_params_;
  plant::State plant_;
  plant::Surface surface_;
  plant::Truth truth_;
  plant::Road road_;           // from the map
  plant::RoadSurface ground_;  // the true road
  drive_by_wire::Params raptor_params_;
  drive_by_wire::State raptor_;
  drive_by_wire::Demand demand_;
  race::Script script_;
  race::State race_;
  std::optional<race::Rival> rival_;
  race::LapTimerParams timer_params_;
  race::LapTimerState timer_;
  Laps laps_;
  sensors::Params sensor_params_;
  sensors::State sensors_;
  sensors::WheelParams wheel_params_;
  sensors::WheelState wheels_;
  plant::Wheels wheel_speed_mps_{};  // measured
  world::SensorInput samples_;
  FixedVector<Outgoing, kMaxOutgoing> outgoing_;
  bool outgoing_taken_ = false;  // cleared by the next step
  bool bus_silent_ = false, computer_silent_ = false, engine_stalled_ = false;
  bool wheel_speeds_lost_ = false;
  std::array<bool, faults::kBrakeCircuits> brake_lost_{};  // front, rear
  double grip_ = 1.0;
  std::optional<double> held_tyre_c_;
  std::uint64_t overflows_ = 0, actuator_frames_ = 0;
};

}  // namespace pitwall::bench
