// One car of a lockstep run with all that belongs to it alone: its computer (a full stack), CAN
// bus, rig, receivers, guardian, radio and base station, and the judging of its run. The owner of
// the clock calls, for every tick, step_computer() and then step_rig() once per kRigStep.
//   in     scenario and Setup of this car, LockstepOptions; time
//   out    the true state in rig(); RunResult at the end
//   errors build(): Problem of the scenario or of an unknown signal; later only counters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hil/bench/lockstep/bus_faults.hpp"
#include "hil/bench/lockstep/clock_faults.hpp"
#include "hil/bench/lockstep/guardian_node.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/lockstep/rendered_cameras.hpp"
#include "hil/bench/lockstep/swept_lidars.hpp"
#include "hil/bench/lockstep/virtual_station.hpp"
#include "hil/bench/path_deviation.hpp"
#include "hil/bench/receiver_codec.hpp"
#include "hil/bench/run_record.hpp"
#include "hil/can_bus/memory_bus.hpp"

namespace pitwall::bench {

// The car's own detectors, behind what the bench renders.
struct OwnDetectors {
  std::optional<perception::PillarDetector> lidar;
  std::optional<perception::CameraDetector> camera;
};

class CarBench {
 public:
  // Keeps references to its arguments.
  static Result<std::unique_ptr<CarBench>, Problem> build(const scenario::Scenario& scenario,
                                                          const pipeline::Setup& setup,
                                                          const LockstepOptions& options,
                                                          bool has_others);
  // Not copyable: its parts hold references to each other.
  CarBench(const CarBench&) = delete;
  CarBench& operator=(const CarBench&) = delete;

  // A tick of the computer. What waits for a process that is stopped waits on; one that was killed
  // begins anew.
  void step_computer(Instant now);
  void step_rig(Instant at);
  // To be asked at the end of every tick: the car is in a wall, or the options end the run.
  bool is_over(Instant now);
  // The run ends before the time of the scenario.
  void end(Instant now) { length_ = now - Instant{}; }

  // What its sensors see of the others and what race control's timing says of the nearest one;
  // after every step of the field.
  void show_others(Field& field, std::size_t own, Instant at);
  void call_race_control(const race::Call& call) { rig_.call_race_control(call); }
  void note_attempt(Instant now, const std::string& sentence);
  // Of the match of the run, before its end.
  void note_match(const race::MatchSheet& sheet) { result_.match = sheet; }
  // Of the field of the run, before its end.
  void note_others(std::size_t cars, const std::optional<CarContact>& contact);

  const Rig& rig() const { return rig_; }
  // Whether its planner declines the attempt that it has to make.
  bool declines() const {
    return car_->plan.output.next.pass.attempt == planning::AttemptChoice::kDeclined;
  }
  RunResult finish();

 private:
  CarBench(const scenario::Scenario& scenario, const pipeline::Setup& setup, Rig rig,
           grading::Grader grader, GuardianNode guardian, const FaultPlan& faults,
           const LockstepOptions& options, bool has_others, OwnDetectors detectors);
  RunView view(Instant now) const;
  void step_car(Instant now);
  void hang_planner(Instant now);
  void restart_controller(Instant now);
  void step_guardian(Instant at);
  void hear_receivers(Instant at);
  void deliver(const can_bus::Delivery& delivery);
  void judge(const pipeline::Outputs& out, Instant now);
  void judge_identity(const pipeline::Outputs& out);
  void note_changes(const pipeline::Outputs& out, Instant now);
  std::uint64_t frames_lost() const { return bus_.counters().lost + rig_.overflows(); }

  const scenario::Scenario& scenario_;
  const pipeline::Setup& setup_;
  Rig rig_;
  grading::Grader grader_;
  GuardianNode guardian_;
  VirtualStation base_;
  BusFaults bus_faults_;
  ClockFaults clock_faults_;
  std::vector<faults::BenchFault> module_faults_, perception_faults_;
  ReceiverEncoder encoder_;
  ReceiverDecoder decoder_, guardian_decoder_;
  const LockstepOptions& options_;
  can_bus::MemoryBus bus_;
  std::unique_ptr<pipeline::Car> car_;
  std::vector<can::ReceivedFrame> inbox_, received_;
  std::optional<pipeline::Outputs> out_;  // of the car's last tick
  Instant stepped_at_;
  std::optional<RunRecord> record_;
  RunResult result_;
  Duration length_ = scenario_.duration;
  PathDeviation path_deviation_{setup_};
  world::TrackFlag flag_ = world::TrackFlag::kNone;
  std::uint32_t laps_ = 0;
  world::BusIdentity identity_;  // as the car saw it last
  bool identity_changed_ = false;
  sensors::DetectionSensors detection_sensors_;  // none for a car that is alone
  sensors::DetectionState detection_;
  OwnDetectors own_;                        // of lidars_ and cameras_, until they are made
  std::optional<SweptLidars> lidars_;       // in place of the modelled ones
  std::optional<RenderedCameras> cameras_;  // likewise
  sensors::Arrivals arrivals_;
  std::vector<world::DetectionFrame> detections_;  // since the last tick
};

}  // namespace pitwall::bench
