// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live_car.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>

#include "basestation/inputs/text_command.hpp"
#include "hil/bench/contact.hpp"
#include "hil/bench/live/car_summary.hpp"
#include "hil/bench/live/virtual_machine.hpp"
#include "hil/bench/match_run.hpp"
#include "hil/bench/signals.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::bench {
namespace {

constexpr Duration kStartLimit = seconds(60);  // a guest is slow
constexpr std::size_t kReadBatch = 256;

}  // namespace

Result<std::unique_ptr<LiveCar>, Problem> LiveCar::open(const scenario::Scenario& scenario,
                                                        const pipeline::Setup& setup,
                                                        const LivePlan& plan, bool has_others) {
  if (auto problem = refused_by(BenchMode::kLive, scenario.faults))
    return Unexpected{*std::move(problem)};
  if (auto problem = dust_in_rays(scenario)) return Unexpected{*std::move(problem)};
  if (scenario.receivers)
    return Unexpected{Problem{
        "receivers", "allowed in lockstep only: in a live run the car file names the receivers"}};
  for (const scenario::OperatorText& word : scenario.operator_texts)
    if (const auto fit = inputs::parse_text_command(word.text); !fit)
      return Unexpected{fit.error()};
  auto faults = plan_faults(scenario.faults, scenario.seed);
  if (!faults) return Unexpected{faults.error()};
  auto rig = Rig::build(scenario, setup.track);
  if (!rig) return Unexpected{rig.error()};
  if (auto problem = unjudged_by(BenchMode::kLive, scenario))
    return Unexpected{*std::move(problem)};
  auto expectations = expectations_of(scenario);
  if (!expectations) return Unexpected{expectations.error()};
  auto grader = grading::Grader::create(*expectations, signal_names());
  if (!grader) return Unexpected{grader.error()};
  auto machine = Machine::take(faults->processes, plan.disk);
  if (!machine) return Unexpected{machine.error()};
  auto bus = transport::CanSocket::open(plan.interface);
  if (!bus) return Unexpected{bus.error()};
  std::vector<RadioPorts> ports(plan.radio.begin(),
                                plan.radio.begin() + static_cast<std::ptrdiff_t>(plan.paths));
  if (!plan.base.empty()) {
    ports[0].onward = plan.base_port;
    if (ports.size() > 1) ports[1].onward = plan.second_base_port;
  }
  auto radio = RadioPath::open(ports, RadioChannel{scenario.radio, faults->radio, scenario.seed});
  if (!radio) return Unexpected{radio.error()};
  auto monitor = CarMonitor::open(plan.report_port);
  if (!monitor) return Unexpected{monitor.error()};
  auto receivers = ReceiverPort::open(plan.receiver_ports(),
                                      ReceiverEncoder{setup.params.receivers, faults->bytes});
  if (!receivers) return Unexpected{receivers.error()};
  auto feeds = CarFeeds::open(
      plan.sensors, plan.sensors_domain, scenario, setup.track,
      [&setup](double s_m) { return line_offset_m(setup, {.s_m = s_m, .n_m = 0.0}); },
      faults->perception);
  if (!feeds) return Unexpected{feeds.error()};
  return std::unique_ptr<LiveCar>{
      new LiveCar(scenario, setup, plan, has_others,
                  {*std::move(rig), *std::move(grader), *std::move(bus), *std::move(radio),
                   *std::move(monitor), *std::move(receivers), *std::move(machine),
                   ProcessSupervisor{members_of(plan),
                                     script_of(faults->processes, Instant{} + scenario.duration)},
                   *std::move(feeds)})};
}

LiveCar::LiveCar(const scenario::Scenario& scenario, const pipeline::Setup& setup,
                 const LivePlan& plan, bool has_others, Parts parts)
    : scenario_(scenario),
      setup_(setup),
      plan_(plan),
      parts_(std::move(parts)),
      inbox_(kReadBatch) {
  received_.reserve(kReadBatch);
  if (plan.log) record_.emplace(scenario, "live", plan.log, has_others);
}

std::optional<Problem> LiveCar::start() {
  std::error_code none;  // nothing there is as it should be
  for (const char* who : {"vehicle", "guardian"})
    std::filesystem::remove(plan_.summary_of(who), none);
  // What an earlier run left there would bar this one from arming.
  if (!plan_.guardian.empty()) std::filesystem::remove("/dev/shm/" + plan_.guardian_name, none);
  if (plan_.candump) {
    // Bench time waits for car and bench and not for it: on one processor it comes before them.
    const std::string before = plan_.clock.empty() || !is_guest() ? "" : "chrt --fifo 85 ";
    auto candump = transport::Process::spawn(
        {.argv = {"sh", "-c",
                  "exec " + before + "candump -L -r 8388608 " + plan_.interface + " > \"$0\"",
                  plan_.folder + "/candump.log"}});
    if (!candump) return candump.error();
    candump_.emplace(*std::move(candump));
  }
  return parts_.processes.start();
}

std::optional<Problem> LiveCar::wait_for_frame(const std::function<void()>& idle) {
  const Instant limit = transport::monotonic_now() + kStartLimit;
  while (transport::monotonic_now() < limit) {
    if (const std::size_t count = parts_.bus.receive(inbox_)) {
      result_.traffic.bench_received += count;
      return std::nullopt;
    }
    if (auto problem = parts_.processes.missing()) return problem;
    idle();
  }
  return Problem{plan_.interface, "no frame of the car has arrived"};
}

// What is looked at once per tick.
std::optional<Problem> LiveCar::look(Instant now) {
  parts_.monitor.read(transport::monotonic_now());
  parts_.radio.channel().place(parts_.rig.road().s_m);
  send_operator_texts(now);
  if (auto problem = parts_.machine.advance(now)) return problem;
  publish_done();
  return parts_.processes.missing();
}

void LiveCar::send_operator_texts(Instant now) {
  const auto& texts = scenario_.operator_texts;
  for (; next_text_ < texts.size() && Instant{} + texts[next_text_].at <= now; ++next_text_)
    commands_.send(texts[next_text_].text);
}

void LiveCar::publish_done() {
  for (const std::vector<CompletedAction>* list :
       {&parts_.processes.done(), &parts_.machine.done()}) {
    std::size_t& next = list == &parts_.processes.done() ? actions_published_ : steps_published_;
    for (; next < list->size(); ++next) {
      result_.done.push_back((*list)[next]);
      if (record_) record_->event(result_.done.back().at, "fault", result_.done.back().what);
    }
  }
}

void LiveCar::step(Instant now) {
  read_bus();
  for (Instant at = now - kWake + kRigStep; at <= now; at += kRigStep) {
    parts_.rig.step(received_, at);
    received_.clear();
    collect_frames(at);
  }
  write_bus();
  if (parts_.rig.has_samples()) parts_.receivers.send(parts_.rig.take_samples(), now);
  if ((now - Instant{}).ns % setup_.params.rates.tick.ns == 0) judge(now);
}

void LiveCar::read_bus() {
  const std::size_t count = parts_.bus.receive(inbox_);
  result_.traffic.bench_received += count;
  for (std::size_t i = 0; i < count; ++i) {
    can::ReceivedFrame received = inbox_[i];
    received.at = Instant{} + (received.at - started_);
    received_.push_back(received);
    if (record_) record_->can(Node::kCar, received.frame, std::max(received.at, Instant{}));
  }
}

// A socket does not hear what it sends, but race control and the drive-by-wire, which share this
// one, do hear each other on a bus.
void LiveCar::collect_frames(Instant at) {
  for (const Outgoing& outgoing : parts_.rig.take_frames()) {
    frames_.push_back(outgoing.frame);
    if (outgoing.from == Node::kRaceControl) received_.push_back({outgoing.frame, at});
    if (record_) record_->can(outgoing.from, outgoing.frame, at);
  }
}

void LiveCar::write_bus() {
  const std::size_t taken = parts_.bus.send(frames_);
  result_.traffic.to_car += taken;
  not_taken_ += frames_.size() - taken;
  frames_.clear();
}

void LiveCar::judge(Instant now) {
  const double offset_m = line_offset_m(setup_, place_of(parts_.rig));
  const RadioChannel& channel = parts_.radio.channel();
  const CarReport& car = parts_.monitor.report();
  const double off_m = path_deviation_.off_path_m(
      parts_.rig.truth(), cross_track_m(parts_.rig, offset_m), car.mode, car.silent, now);
  parts_.grader.observe(now,
                        observe({.rig = parts_.rig,
                                 .car = car,
                                 .line_offset_m = offset_m,
                                 .frames_lost = not_taken_ + parts_.bus.counters().rx_dropped_queue,
                                 .radio_gap = channel.silence(now).value_or(Duration{}),
                                 .radio_gap_max = channel.longest_silence(now),
                                 .radio_limit = radio_limit_of(setup_.params),
                                 .off_path_m = off_m}));
  grading::add(result_.cross_track, parts_.rig.truth().speed_mps,
               cross_track_m(parts_.rig, offset_m), parts_.rig.laps().finished);
  result_.speed_max_mps = std::max(result_.speed_max_mps, parts_.rig.truth().speed_mps);
  follow(result_.outcome, vehicle_place(parts_.rig, offset_m, now));
  if (record_) record_->truth(parts_.rig, now, cross_track_m(parts_.rig, offset_m));
  if (plan_.follow) plan_.follow({now, parts_.rig, car.mode, parts_.grader, result_});
}

std::optional<Problem> LiveCar::act(Instant now) { return parts_.processes.advance(now); }

void LiveCar::serve_radio(Instant now) { parts_.radio.serve(now); }

void LiveCar::show_others(Field& field, std::size_t own, Instant at) {
  parts_.rig.show_rival(field.rival_of(own));
  parts_.feeds.show(parts_.rig.truth(), parts_.rig.road().s_m,
                    {field.car(own).pose, field.others_of(own)}, at, started_);
  const bool tick = (at - Instant{}).ns % setup_.params.rates.tick.ns == 0;
  if (record_ && tick) record_->others(field, own, at);
}

void LiveCar::note_others(std::size_t cars, const std::optional<CarContact>& contact) {
  result_.other_cars = cars;
  result_.car_contact = contact;
  if (record_ && contact) record_->contact(*contact);
}

void LiveCar::note_attempt(Instant now, const std::string& sentence) {
  if (record_) record_->event(now, "attempt", sentence);
}

void LiveCar::settle() {
  read_bus();
  received_.clear();
  const Instant now = transport::monotonic_now();
  parts_.radio.serve(std::max(Instant{} + length_, Instant{} + (now - started_)));
  parts_.monitor.read(now);
}

std::optional<Problem> LiveCar::stop_processes(const std::function<void()>& idle) {
  return parts_.processes.finish(ProcessSupervisor::kStopLimit, idle);
}

LiveResult LiveCar::finish(const RealTime& time, double wall_s) {
  parts_.bus.poll_drops();
  stop_candump();
  publish_done();
  result_.real_time = time;
  result_.wall_s = wall_s;
  fill();
  if (const auto car = summary()) add_car(*car);
  close_record();
  return {result_, parts_.radio.counters(), parts_.monitor.packets()};
}

// Of a car that ended as told. Of one that was killed there is none, of one that we did not start
// we do not know where it is; one that cannot be read is told.
std::optional<CarSummary> LiveCar::summary() {
  if (plan_.attached()) return std::nullopt;
  auto read = read_car_summary(plan_.summary_of("vehicle"));
  if (read && parts_.processes.ended_well(Role::kCar)) return *std::move(read);
  if (!parts_.processes.was_killed(Role::kCar) || parts_.processes.ended_well(Role::kCar))
    result_.remarks.push_back("the car left no summary" +
                              (read ? std::string() : ": " + to_string(read.error())));
  return std::nullopt;
}

void LiveCar::stop_candump() {
  if (!candump_) return;
  candump_->kill(SIGTERM);
  candump_->wait();
}

void LiveCar::fill() {
  result_.scenario = scenario_.name;
  result_.mode = "live";
  result_.simulated_s = length_.seconds();
  result_.verdicts = parts_.grader.finish();
  judge_contact(scenario_, result_);
  if (result_.match) judge_match(*scenario_.match, result_);
  result_.laps = parts_.rig.laps();
  result_.traffic.from_car = result_.traffic.bench_received;
  result_.traffic.lost = lost_here();
  parts_.feeds.add_to(result_);
  const CarReport& last = parts_.monitor.report();
  if (std::isfinite(last.gate_refusals))
    result_.gate_refusals = static_cast<std::uint64_t>(last.gate_refusals);
  if (std::isfinite(last.bus_refusals))
    result_.bus_refusals = static_cast<std::uint64_t>(last.bus_refusals);
}

void LiveCar::add_car(const CarSummary& car) {
  RealTime& time = *result_.real_time;
  time.step_p50_us = car.step_p50_us;
  time.step_p99_us = car.step_p99_us;
  time.step_max_us = car.step_max_us;
  time.ticks = car.ticks;
  time.missed_deadlines = car.missed_deadlines;
  time.is_slowed = parts_.processes.acts_on(Role::kCar);
  result_.gate_refusals = car.gate_refusals;
  result_.bus_refusals = car.frames_refused;
  if (car.identity == "wrong") result_.refused_to_arm = car.identity_sentence;
  // Not those of the silence after the bench's last frame, which the car counts too.
  result_.bus_losses = frames_that_never_came(car, started_ + length_);
  // One that was started again knows nothing of its first life.
  if (!parts_.processes.was_killed(Role::kCar)) compare_counts(car);
  record_car(car);
}

void LiveCar::compare_counts(const CarSummary& car) {
  const auto missing = [](std::uint64_t sent, std::uint64_t received) {
    return sent > received ? sent - received : 0;
  };
  result_.traffic.from_car = car.frames_sent;
  result_.traffic.car_received = car.frames_received;
  result_.traffic.lost = missing(result_.traffic.to_car, car.frames_received) +
                         missing(car.frames_sent, result_.traffic.bench_received) + not_taken_ +
                         car.tx_drops;
  if (parts_.feeds.detections)
    result_.detections_lost += missing(parts_.feeds.detections->sent(), detections_received(car));
}

void LiveCar::record_car(const CarSummary& car) {
  if (!record_) return;
  record_->event(Instant{} + length_, "identity", car.identity_sentence);
  for (world::LossReport loss : car.losses) {
    loss.noticed = Instant{} + (loss.noticed - started_);
    if (loss.due != Instant{}) loss.due = Instant{} + (loss.due - started_);
    record_->loss(loss);
  }
}

void LiveCar::close_record() {
  if (!record_) return;
  for (const grading::Verdict& verdict : result_.verdicts)
    record_->verdict(Instant{} + length_, verdict);
  if (!record_->close())
    result_.remarks.push_back("the event log has no end: its disk took no more, and at least " +
                              std::to_string(record_->counters().refused_sink) +
                              " messages were lost");
  result_.digest = record_->digest();
}

}  // namespace pitwall::bench
