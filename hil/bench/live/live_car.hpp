// One car of a live run with all that belongs to it alone: its processes, bus, receivers' ports,
// radio path, rig, local report, and the judging of its run. The owner of the clock calls step() in
// every wake-up, and the others as often as they say.
//   in     scenario, Setup and LivePlan of this car; time
//   out    the true state in rig(); LiveResult at the end
//   errors open(): Problem of the scenario, of the bus or of a port, before anything is started;
//          later Problem of a process that cannot be started or ended by itself
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/live/car_monitor.hpp"
#include "hil/bench/live/car_summary.hpp"
#include "hil/bench/live/live.hpp"
#include "hil/bench/live/machine.hpp"
#include "hil/bench/live/operator_line.hpp"
#include "hil/bench/live/publishers/car_feeds.hpp"
#include "hil/bench/live/receiver_port.hpp"
#include "hil/bench/path_deviation.hpp"
#include "hil/bench/run_record.hpp"
#include "hil/grading/grader.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::bench {

class LiveCar {
 public:
  // One wake-up per step of the rig: frames sent later than half their period would seem lost to
  // the car. A system call costs 16 us in the guest, so what is slow anyway is looked at per tick.
  static constexpr Duration kWake = milliseconds(1);

  // Keeps references to its arguments.
  static Result<std::unique_ptr<LiveCar>, Problem> open(const scenario::Scenario& scenario,
                                                        const pipeline::Setup& setup,
                                                        const LivePlan& plan, bool has_others);
  LiveCar(const LiveCar&) = delete;
  LiveCar& operator=(const LiveCar&) = delete;

  std::optional<Problem> start();  // the processes
  // The car reports its state on the bus from its first tick on.
  std::optional<Problem> wait_for_frame(const std::function<void()>& idle);
  void begin(Instant started) { started_ = started; }
  void step(Instant now);
  std::optional<Problem> act(Instant now);  // the actions of the scenario that are due
  void serve_radio(Instant now);
  std::optional<Problem> look(Instant now);  // once per tick
  bool is_over() const { return has_contact(result_.outcome); }
  void end(Instant now) { length_ = now - Instant{}; }
  // Takes what is on its way; after the last step.
  void settle();
  std::optional<Problem> stop_processes(const std::function<void()>& idle);
  LiveResult finish(const RealTime& time, double wall_s);

  // What race control's timing says of the nearest other car, and what our sensors see of all.
  void show_others(Field& field, std::size_t own, Instant at);
  void note_others(std::size_t cars, const std::optional<CarContact>& contact);
  const Rig& rig() const { return parts_.rig; }
  // For a match, as a car of the lockstep bench has them.
  bool declines() const { return parts_.monitor.report().declines; }
  void call_race_control(const race::Call& call) { parts_.rig.call_race_control(call); }
  void note_attempt(Instant now, const std::string& sentence);
  void note_match(const race::MatchSheet& sheet) { result_.match = sheet; }

 private:
  // Everything that a run is made of, opened before anything is started.
  struct Parts {
    Rig rig;
    grading::Grader grader;
    transport::CanSocket bus;
    RadioPath radio;
    CarMonitor monitor;
    ReceiverPort receivers;
    Machine machine;
    ProcessSupervisor processes;
    CarFeeds feeds;
  };

  LiveCar(const scenario::Scenario& scenario, const pipeline::Setup& setup, const LivePlan& plan,
          bool has_others, Parts parts);
  void send_operator_texts(Instant now);
  void publish_done();
  void read_bus();
  void collect_frames(Instant at);
  void write_bus();
  void judge(Instant now);
  void stop_candump();
  void fill();
  void compare_counts(const CarSummary& car);
  void record_car(const CarSummary& car);
  void close_record();
  // Of a car that ended as told. Of one that was killed there is none, of one that we did not start
  // we do not know where it is; one that cannot be read is told.
  std::optional<CarSummary> summary();
  std::uint64_t lost_here() const { return not_taken_ + parts_.bus.counters().rx_dropped_queue; }
  void add_car(const CarSummary& car);

  const scenario::Scenario& scenario_;
  const pipeline::Setup& setup_;
  const LivePlan& plan_;
  Parts parts_;
  std::optional<transport::Process> candump_;
  std::optional<RunRecord> record_;
  Duration length_ = scenario_.duration;  // less where a contact ended the run
  std::vector<can::ReceivedFrame> inbox_, received_;
  std::vector<can::Frame> frames_;
  Instant started_{};  // of the bench, at scenario time 0
  std::uint64_t not_taken_ = 0;
  std::size_t next_text_ = 0;  // of the operator's
  OperatorLine commands_{plan_.command_socket()};
  std::size_t actions_published_ = 0, steps_published_ = 0;  // of processes, of the machine
  RunResult result_;
  PathDeviation path_deviation_{setup_};
};

}  // namespace pitwall::bench
