// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <optional>
#include <utility>

#include "hil/bench/car_summary.hpp"
#include "hil/bench/radio_path.hpp"
#include "hil/bench/receiver_port.hpp"
#include "hil/bench/run_record.hpp"
#include "hil/bench/signals.hpp"
#include "hil/grading/grader.hpp"
#include "protocol/transport/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::bench {
namespace {

using transport::CanSocket;

constexpr int kPriority = 60;  // below the car, which must never wait for its bench
constexpr Duration kStartLimit = seconds(15);
constexpr Duration kStopLimit = seconds(5);
constexpr Duration kSettle = milliseconds(300);  // for frames and datagrams on their way
constexpr std::size_t kReadBatch = 256;
// One wake-up per step of the rig: frames sent later than half their period would seem lost to the
// car. A system call costs 16 us in the guest, so what is slow anyway is looked at once per tick.
constexpr Duration kWake = milliseconds(1);
constexpr Duration kLook = milliseconds(10);

class Live {
 public:
  Live(const scenario::Scenario& scenario, const pipeline::Setup& setup, const LivePlan& plan,
       Rig rig, grading::Grader grader, CanSocket bus, RadioPath radio, ReceiverPort receivers)
      : scenario_(scenario),
        setup_(setup),
        plan_(plan),
        rig_(std::move(rig)),
        grader_(std::move(grader)),
        bus_(std::move(bus)),
        radio_(std::move(radio)),
        receivers_(std::move(receivers)),
        inbox_(kReadBatch) {
    late_us_.reserve(static_cast<std::size_t>(scenario.duration / kWake) + 1);
    heard_.reserve(kReadBatch);
    if (plan.log) record_.emplace(scenario, "live", plan.log);
  }

  Result<LiveResult, Problem> run() {
    if (auto problem = start_processes()) return Unexpected{*problem};
    if (auto problem = wait_for_car()) return Unexpected{*problem};
    start_ = transport::monotonic_now();
    for (Instant now = Instant{} + kWake; now - Instant{} <= scenario_.duration; now += kWake) {
      wake(now);
      step(now);
      if ((now - Instant{}).ns % kLook.ns != 0) continue;
      radio_.serve(transport::monotonic_now());
      if (const auto ended = vehicle_->poll())
        return Unexpected{Problem{plan_.vehicle.front(), "the car process ended with code " +
                                                             std::to_string(ended->shell_code())}};
    }
    return finish();
  }

 private:
  std::optional<Problem> start_processes() {
    if (plan_.candump) {
      auto candump = transport::Process::spawn(
          {.argv = {"sh", "-c", "exec candump -L -r 8388608 " + plan_.interface + " > \"$0\"",
                    plan_.folder + "/candump.log"}});
      if (!candump) return candump.error();
      candump_.emplace(*std::move(candump));
    }
    std::vector<std::string> argv = plan_.vehicle;
    for (const std::string& word :
         {std::string("--can"), plan_.interface, std::string("--gnss"),
          std::to_string(plan_.gnss_port) + "," + std::to_string(plan_.gnss_port + 1),
          std::string("--radio"), "127.0.0.1:" + std::to_string(plan_.radio.listen),
          std::string("--summary"), summary_path(), std::string("--simulation"),
          std::string("--arm")})
      argv.push_back(word);
    auto vehicle = transport::Process::spawn({.argv = argv});
    if (!vehicle) return vehicle.error();
    vehicle_.emplace(*std::move(vehicle));
    return std::nullopt;
  }

  // The car reports its state on the bus from its first tick on.
  std::optional<Problem> wait_for_car() {
    const Instant limit = transport::monotonic_now() + kStartLimit;
    while (transport::monotonic_now() < limit) {
      if (const std::size_t count = bus_.receive(inbox_)) {
        result_.traffic.bench_received += count;
        return std::nullopt;
      }
      if (vehicle_->poll()) return Problem{plan_.vehicle.front(), "the car process did not start"};
      transport::sleep_until(transport::monotonic_now() + milliseconds(2));
    }
    return Problem{plan_.vehicle.front(), "no frame of the car on " + plan_.interface};
  }

  void wake(Instant now) {
    const Instant deadline = start_ + (now - Instant{});
    Instant at = transport::monotonic_now();
    if (at < deadline) {
      transport::sleep_until(deadline);
      at = transport::monotonic_now();
      late_us_.push_back(static_cast<float>((at - deadline).ns) * 1e-3F);
    } else if (at - deadline >= kWake) {
      ++timing_.caught_up_wakes;
    }
  }

  void step(Instant now) {
    read_bus();
    for (Instant at = now - kWake + kRigStep; at <= now; at += kRigStep) {
      rig_.step(heard_, at);
      heard_.clear();
      collect_frames(at);
    }
    write_bus();
    receivers_.send(rig_.take_samples());
    if ((now - Instant{}).ns % setup_.params.rates.tick.ns == 0) judge(now);
  }

  void read_bus() {
    const std::size_t count = bus_.receive(inbox_);
    result_.traffic.bench_received += count;
    for (std::size_t i = 0; i < count; ++i) {
      can::ReceivedFrame received = inbox_[i];
      received.at = Instant{} + (received.at - start_);
      heard_.push_back(received);
      if (record_) record_->can(Node::kCar, received.frame, std::max(received.at, Instant{}));
    }
  }

  // A socket does not hear what it sends, but race control and the drive-by-wire, which share this
  // one, do hear each other on a bus.
  void collect_frames(Instant at) {
    for (const Outgoing& outgoing : rig_.take_frames()) {
      frames_.push_back(outgoing.frame);
      if (outgoing.from == Node::kRaceControl) heard_.push_back({outgoing.frame, at});
      if (record_) record_->can(outgoing.from, outgoing.frame, at);
    }
  }

  void write_bus() {
    const std::size_t taken = bus_.send(frames_);
    result_.traffic.to_car += taken;
    not_taken_ += frames_.size() - taken;
    frames_.clear();
  }

  void judge(Instant now) {
    const double offset_m = setup_.params.planning.line.offset_m;
    grader_.observe(now, observe({.rig = rig_,
                                  .car = radio_.report(),
                                  .line_offset_m = offset_m,
                                  .frames_lost = not_taken_ + bus_.counters().rx_dropped_queue}));
    grading::add(result_.cross_track, rig_.truth().speed_mps, cross_track_m(rig_, offset_m));
    result_.speed_max_mps = std::max(result_.speed_max_mps, rig_.truth().speed_mps);
    if (record_) record_->truth(rig_, now);
  }

  void settle(Duration span) {
    const Instant until = transport::monotonic_now() + span;
    while (transport::monotonic_now() < until) {
      read_bus();
      heard_.clear();
      radio_.serve(transport::monotonic_now());
      transport::sleep_until(transport::monotonic_now() + milliseconds(2));
    }
  }

  Result<LiveResult, Problem> finish() {
    settle(kSettle);
    vehicle_->kill(SIGTERM);
    const Instant limit = transport::monotonic_now() + kStopLimit;
    while (transport::monotonic_now() < limit && !vehicle_->poll()) settle(milliseconds(10));
    if (!vehicle_->poll())
      return Unexpected{Problem{plan_.vehicle.front(), "the car process did not stop"}};
    settle(kSettle);
    bus_.poll_drops();
    stop_candump();
    const auto summary = read_car_summary(summary_path());
    if (!summary) return Unexpected{summary.error()};
    fill(*summary);
    return LiveResult{result_, timing_, radio_.counters()};
  }

  void stop_candump() {
    if (!candump_) return;
    candump_->kill(SIGTERM);
    candump_->wait();
  }

  void fill(const CarSummary& car) {
    result_.scenario = scenario_.name;
    result_.mode = "live";
    result_.simulated_s = result_.wall_s = scenario_.duration.seconds();
    result_.verdicts = grader_.finish();
    result_.laps = rig_.laps();
    result_.traffic.from_car = car.frames_sent;
    result_.traffic.car_received = car.frames_received;
    const auto missing = [](std::uint64_t sent, std::uint64_t received) {
      return sent > received ? sent - received : 0;
    };
    result_.traffic.lost = missing(result_.traffic.to_car, car.frames_received) +
                           missing(car.frames_sent, result_.traffic.bench_received) + not_taken_ +
                           car.tx_drops;
    result_.gate_refusals = car.gate_refusals;
    result_.bus_refusals = car.frames_refused;
    // Not those of the silence after the bench's last frame, which the car counts too.
    for (const world::LossReport& loss : car.losses)
      if (loss.id != 0 && loss.due <= start_ + scenario_.duration)
        result_.bus_losses += loss.frames;
    if (car.identity == "wrong") result_.refused_to_arm = car.identity_sentence;
    fill_timing();
    if (!record_) return;
    record_->event(Instant{} + scenario_.duration, "identity", car.identity_sentence);
    for (world::LossReport loss : car.losses) {
      loss.noticed = Instant{} + (loss.noticed - start_);
      if (loss.due != Instant{}) loss.due = Instant{} + (loss.due - start_);
      record_->loss(loss);
    }
    for (const grading::Verdict& verdict : result_.verdicts)
      record_->event(Instant{} + scenario_.duration, verdict.pass ? "pass" : "fail", verdict.text);
    record_->close();
    result_.digest = record_->digest();
  }

  void fill_timing() {
    if (late_us_.empty()) return;
    std::sort(late_us_.begin(), late_us_.end());
    const auto quantile = [this](double q) {
      return static_cast<double>(
          late_us_[static_cast<std::size_t>(q * static_cast<double>(late_us_.size() - 1))]);
    };
    timing_.wake_late_p50_us = quantile(0.5);
    timing_.wake_late_p99_us = quantile(0.99);
    timing_.wake_late_max_us = quantile(1.0);
  }

  std::string summary_path() const { return plan_.folder + "/vehicle.json"; }

  const scenario::Scenario& scenario_;
  const pipeline::Setup& setup_;
  const LivePlan& plan_;
  Rig rig_;
  grading::Grader grader_;
  CanSocket bus_;
  RadioPath radio_;
  ReceiverPort receivers_;
  std::optional<transport::Process> vehicle_, candump_;
  std::optional<RunRecord> record_;
  Instant start_{};
  std::vector<can::ReceivedFrame> inbox_, heard_;
  std::vector<can::Frame> frames_;
  std::vector<float> late_us_;
  std::uint64_t not_taken_ = 0;
  RunResult result_;
  LiveTiming timing_;
};

}  // namespace

Result<LiveResult, Problem> run_live(const scenario::Scenario& scenario,
                                     const pipeline::Setup& setup, const LivePlan& plan) {
  auto rig = Rig::build(scenario, setup.track);
  if (!rig) return Unexpected{rig.error()};
  auto expectations = expectations_of(scenario);
  if (!expectations) return Unexpected{expectations.error()};
  auto grader = grading::Grader::create(*expectations, signal_names());
  if (!grader) return Unexpected{grader.error()};
  auto bus = CanSocket::open(plan.interface);
  if (!bus) return Unexpected{bus.error()};
  auto radio = RadioPath::open(plan.radio);
  if (!radio) return Unexpected{radio.error()};
  auto receivers = ReceiverPort::open(plan.gnss_port);
  if (!receivers) return Unexpected{receivers.error()};
  transport::request_realtime(kPriority);
  return Live{scenario,
              setup,
              plan,
              *std::move(rig),
              *std::move(grader),
              *std::move(bus),
              *std::move(radio),
              *std::move(receivers)}
      .run();
}

}  // namespace pitwall::bench
