// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/car_bench.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "basestation/inputs/text_command.hpp"
#include "hil/bench/contact.hpp"
#include "hil/bench/loading.hpp"
#include "hil/bench/match_run.hpp"
#include "hil/bench/signals.hpp"
#include "hil/scenario/perturbed.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

constexpr std::size_t kDetectionFrames = 64;  // of a tick; the sensors send ten at most
constexpr std::size_t kInboxFrames = 4096;    // a second of a full bus, and one tick is 10 ms

// "driving", "controlled stop, IMU: both units lost".
std::string mode_text(const safety::SupervisorOutput& chosen) {
  std::string text{telemetry::label_at(telemetry::kModes, static_cast<std::size_t>(chosen.mode))};
  if (chosen.cause != safety::Cause::kNone)
    text += std::string{", "} + safety::text_of(chosen.cause);
  return text;
}

Result<OwnDetectors, Problem> own_detectors(const scenario::Scenario& scenario, bool has_others) {
  const auto file = [&](bool is_used, const char* name) {
    return has_others && is_used ? below(scenario.folder, name) : "";
  };
  const auto read = [](const std::string& path) { return transport::read_file(path); };
  auto lidar = perception::PillarDetector::read(
      file(scenario.lidars == scenario::LidarKind::kRays, perception::kPillarNetworkFile), read);
  if (!lidar) return Unexpected{lidar.error()};
  auto camera = perception::CameraDetector::read(
      file(scenario.cameras == scenario::CameraKind::kRendered, perception::kCameraNetworkFile),
      read);
  if (!camera) return Unexpected{camera.error()};
  return OwnDetectors{*std::move(lidar), *std::move(camera)};
}

}  // namespace

Result<std::unique_ptr<CarBench>, Problem> CarBench::build(const scenario::Scenario& scenario,
                                                           const pipeline::Setup& setup,
                                                           const LockstepOptions& options,
                                                           bool has_others) {
  if (auto problem = refused_by(BenchMode::kLockstep, scenario.faults))
    return Unexpected{*std::move(problem)};
  auto rig = Rig::build(scenario, setup.track);
  if (!rig) return Unexpected{rig.error()};
  auto expectations = expectations_of(scenario);
  if (!expectations) return Unexpected{expectations.error()};
  const std::vector<std::string> names = signal_names();
  auto grader = grading::Grader::create(*expectations, names);
  if (!grader) return Unexpected{grader.error()};
  auto faults = plan_faults(scenario.faults, scenario.seed);
  if (!faults) return Unexpected{faults.error()};
  for (const scenario::OperatorText& word : scenario.operator_texts)
    if (const auto fit = inputs::parse_text_command(word.text); !fit)
      return Unexpected{fit.error()};
  if (auto problem = dust_in_rays(scenario)) return Unexpected{*std::move(problem)};
  auto detectors = own_detectors(scenario, has_others);
  if (!detectors) return Unexpected{detectors.error()};
  GuardianNode guardian{setup.params, faults->processes, options.guardian};
  return std::unique_ptr<CarBench>{new CarBench(scenario, setup, *std::move(rig),
                                                *std::move(grader), std::move(guardian), *faults,
                                                options, has_others, *std::move(detectors))};
}

CarBench::CarBench(const scenario::Scenario& scenario, const pipeline::Setup& setup, Rig rig,
                   grading::Grader grader, GuardianNode guardian, const FaultPlan& faults,
                   const LockstepOptions& options, bool has_others, OwnDetectors detectors)
    : scenario_(scenario),
      setup_(setup),
      rig_(std::move(rig)),
      grader_(std::move(grader)),
      guardian_(std::move(guardian)),
      base_(scenario, setup, faults),
      bus_faults_(faults.bus),
      clock_faults_(faults.clock),
      module_faults_(faults.modules),
      perception_faults_(faults.perception),
      encoder_(setup.params.receivers, faults.bytes),
      decoder_(setup.params.receivers),
      guardian_decoder_(setup.params.receivers),
      options_(options),
      bus_({.ports = kNodes, .bit_rate = 500'000, .seed = scenario.seed}),
      car_(std::make_unique<pipeline::Car>()),
      stepped_at_(Instant{} - setup.params.rates.tick) {
  inbox_.reserve(kInboxFrames);
  received_.reserve(kInboxFrames);
  if (options.log) record_.emplace(scenario, "lockstep", options.log, has_others);
  if (!has_others) return;
  detection_sensors_ = plant::detection_sensors_of(scenario_);
  own_ = std::move(detectors);
  if (has_rays(scenario_.lidars))
    detection_sensors_ = without(detection_sensors_, world::DetectionSource::kLidar);
  if (scenario_.cameras == scenario::CameraKind::kRendered)
    detection_sensors_ = without(detection_sensors_, world::DetectionSource::kCamera);
  detection_ = sensors::make_detections(detection_sensors_, scenario_.seed, Instant{});
  detections_.reserve(kDetectionFrames);
}

bool CarBench::is_over(Instant now) {
  const bool over = options_.over && options_.over(view(now));
  if (!over && !has_contact(result_.outcome)) return false;
  if (record_ && has_contact(result_.outcome))
    record_->event(now, "contact", to_text(result_.outcome));
  return true;
}

void CarBench::show_others(Field& field, std::size_t own, Instant at) {
  rig_.show_rival(field.rival_of(own));
  const std::span<const plant::CarPose> others = field.others_of(own);
  arrivals_.clear();
  faults::apply_perception_faults(perception_faults_, at, detection_sensors_, detection_);
  sensors::step_detections(detection_sensors_, detection_,
                           {.ours = field.car(own).pose, .others = others}, at, arrivals_);
  if (has_rays(scenario_.lidars)) {
    if (!lidars_)
      lidars_.emplace(setup_.track, others.size(), scenario_.seed, std::move(own_.lidar));
    lidars_->step(rig_.truth(), others, out_ ? out_->ego : world::EgoState{},
                  faults::lidar_fault(perception_faults_, at), at, arrivals_);
  }
  if (scenario_.cameras == scenario::CameraKind::kRendered) {
    if (!cameras_)
      cameras_.emplace(setup_.track, others.size(), scenario_.seed, *std::move(own_.camera));
    cameras_->step(rig_.truth(), others, faults::camera_fault(perception_faults_, at), at,
                   arrivals_);
  }
  for (const world::DetectionFrame& frame : arrivals_) {
    if (detections_.size() < kDetectionFrames)
      detections_.push_back(frame);
    else
      ++result_.detections_lost;
  }
  const bool tick = (at - Instant{}).ns % setup_.params.rates.tick.ns == 0;
  if (record_ && tick) record_->others(field, own, at);
}

void CarBench::note_others(std::size_t cars, const std::optional<CarContact>& contact) {
  result_.other_cars = cars;
  result_.car_contact = contact;
  if (record_ && contact) record_->contact(*contact);
}

void CarBench::note_attempt(Instant now, const std::string& sentence) {
  if (record_) record_->event(now, "attempt", sentence);
}

void CarBench::step_computer(Instant now) {
  if (guardian_.car_restarts(now)) {
    *car_ = {};
    inbox_.clear();
    result_.detections_lost += detections_.size();
    detections_.clear();
    decoder_ = ReceiverDecoder{setup_.params.receivers};
    base_.restart_car();
    stepped_at_ = now - setup_.params.rates.tick;
  }
  const bool killed = options_.car_is_dead && options_.car_is_dead();
  if (!killed && guardian_.car_runs(now))
    step_car(now);
  else if (out_)
    out_->seen = {};
  judge(*out_, now);
  note_changes(*out_, now);
  if (options_.follow) options_.follow(view(now));
  out_->chosen.mode_changed = false;
  if (options_.watch) options_.watch(*out_, rig_, now);
  if (options_.break_rig) options_.break_rig(rig_, now);
}

RunView CarBench::view(Instant now) const {
  return {.now = now,
          .rig = rig_,
          .mode = static_cast<double>(out_->chosen.mode),
          .grader = grader_,
          .result = result_};
}

void CarBench::step_car(Instant now) {
  pipeline::Inputs in{.now = now,
                      .dt = now - stepped_at_,
                      .can = inbox_,
                      .sensors = decoder_.samples(),
                      .detections = detections_,
                      .requests = {.arm = guardian_.armed_from_the_start()},
                      .gnss_byte_at = decoder_.byte_at(),
                      .link = link_of_car(bus_),
                      .guardian = guardian_.view(now)};
  base_.receive(in);
  hang_planner(now);
  out_ = options_.step(setup_, *car_, in);
  const auto reported = base_.publish(*car_, in, *out_, decoder_.traffic());
  if (reported && options_.watch_telemetry) options_.watch_telemetry(*reported, now);
  stepped_at_ = now;
  if (out_->bus_guard.restart_now) restart_controller(now);
  decoder_.clear();
  detections_.clear();
  result_.traffic.car_received += inbox_.size();
  inbox_.clear();
  guardian_.publish(setup_, *car_, *out_, now);
  for (const can::Frame& frame : out_->passed.frames)
    if (bus_.offer(static_cast<std::uint8_t>(Node::kCar), frame, now)) ++result_.traffic.from_car;
}

void CarBench::hang_planner(Instant now) {
  const bool hangs = std::ranges::any_of(module_faults_, [now](const faults::BenchFault& fault) {
    return fault.kind == faults::BenchFaultKind::kPlannerHangs && faults::active(fault, now);
  });
  if (hangs) car_->plan.at = now;
}

void CarBench::restart_controller(Instant now) {
  bus_.restart(static_cast<std::uint8_t>(Node::kCar), now);
  bus_faults_.car_restarts_controller(now);
}

void CarBench::step_guardian(Instant at) {
  if (!guardian_.present() || (at - Instant{}).ns % guardian::kTick.ns != 0) return;
  for (const can::Frame& frame : guardian_.step(guardian_decoder_.samples(), at))
    bus_.offer(static_cast<std::uint8_t>(Node::kGuardian), frame, at);
  guardian_decoder_.clear();
  const guardian::Mode mode = guardian_.status().mode;
  const bool acts = mode != guardian::Mode::kIdle && mode != guardian::Mode::kWatching;
  if (guardian_.mode_changed() && acts && record_)
    record_->event(at, "guardian",
                   std::string(guardian::text_of(guardian_.status().mode)) + " (" +
                       guardian::text_of(guardian_.status().cause) + ")");
  if (options_.watch_guardian) options_.watch_guardian(guardian_, at);
}

void CarBench::hear_receivers(Instant at) {
  if (!rig_.has_samples()) return;
  encoder_.encode(clock_faults_.apply(rig_.take_samples(), at), at,
                  [&](std::uint8_t unit, std::span<const std::uint8_t> bytes) {
                    decoder_.receive(unit, bytes, at);
                    if (guardian_.present()) guardian_decoder_.receive(unit, bytes, at);
                  });
}

void CarBench::step_rig(Instant at) {
  rig_.step(received_, at);
  received_.clear();
  for (const Outgoing& outgoing : rig_.take_frames())
    if (bus_.offer(static_cast<std::uint8_t>(outgoing.from), outgoing.frame, at))
      ++result_.traffic.to_car;
  bus_faults_.act_on(bus_, at);
  for (const can_bus::Delivery& delivery : bus_.advance(at)) deliver(delivery);
  base_.advance(at);
  hear_receivers(at);
  step_guardian(at);
}

void CarBench::deliver(const can_bus::Delivery& delivery) {
  const auto from = static_cast<Node>(delivery.from);
  const auto to = static_cast<Node>(delivery.to);
  if (to == Node::kCar && inbox_.size() < kInboxFrames) inbox_.push_back(delivery.received);
  if (to == Node::kGuardian) guardian_.receive(delivery.received);
  if (to == Node::kDriveByWire && received_.size() < kInboxFrames) {
    received_.push_back(delivery.received);
    if (from == Node::kCar) ++result_.traffic.bench_received;
  }
  const bool computer = from == Node::kCar || from == Node::kGuardian;
  const bool once = computer ? to == Node::kDriveByWire : to == Node::kCar;
  if (record_ && once) record_->can(from, delivery.received.frame, delivery.received.at);
}

void CarBench::judge(const pipeline::Outputs& out, Instant now) {
  const CarReport report{.mode = static_cast<double>(out.chosen.mode),
                         .gate_refusals = static_cast<double>(out.passed.refused_total),
                         .bus_refusals = static_cast<double>(out.received.bus.refused.total()),
                         .x_m = out.ego.x_m,
                         .y_m = out.ego.y_m,
                         .yaw_rad = out.ego.yaw_rad,
                         .identity = static_cast<double>(out.received.bus.identity.verdict),
                         .differing_id = static_cast<double>(out.received.bus.identity.id),
                         .cause = static_cast<double>(out.chosen.cause),
                         .operator_limit_mps = out.speed_limit_mps,
                         .seen = out.seen};
  const double offset_m = line_offset_m(setup_, place_of(rig_));
  const double off_m = path_deviation_.off_path_m(rig_.truth(), cross_track_m(rig_, offset_m),
                                                  report.mode, report.silent, now);
  grader_.observe(now, observe({.rig = rig_,
                                .car = report,
                                .line_offset_m = offset_m,
                                .frames_lost = frames_lost(),
                                .radio_gap = base_.channel().silence(now).value_or(Duration{}),
                                .radio_gap_max = base_.channel().longest_silence(now),
                                .radio_limit = radio_limit_of(setup_.params),
                                .off_path_m = off_m}));
  grading::add(result_.cross_track, rig_.truth().speed_mps, cross_track_m(rig_, offset_m),
               rig_.laps().finished);
  result_.speed_max_mps = std::max(result_.speed_max_mps, rig_.truth().speed_mps);
  follow(result_.outcome, vehicle_place(rig_, offset_m, now));
  result_.gate_refusals = out.passed.refused_total;
  result_.bus_refusals = out.received.bus.refused.total();
  result_.bus_losses = out.received.bus.frames_lost;
  judge_identity(out);
  if (!record_) return;
  record_->truth(rig_, now, cross_track_m(rig_, offset_m));
  record_->car(out, now);
}

void CarBench::judge_identity(const pipeline::Outputs& out) {
  const world::BusIdentity& identity = out.received.bus.identity;
  const bool changed = identity.verdict != identity_.verdict || identity.id != identity_.id ||
                       identity.difference != identity_.difference;
  identity_ = identity;
  const bool wrong = identity.verdict == world::IdentityVerdict::kWrong;
  if (changed) result_.refused_to_arm = wrong ? gateway::sentence(identity) : std::string{};
  identity_changed_ = changed;
}

void CarBench::note_changes(const pipeline::Outputs& out, Instant now) {
  if (!record_) return;
  if (rig_.flags().track != flag_) {
    flag_ = rig_.flags().track;
    record_->event(now, "flag", scenario::name_of(flag_));
  }
  if (identity_changed_) record_->event(now, "identity", gateway::sentence(identity_));
  if (out.chosen.mode_changed) record_->event(now, "mode", mode_text(out.chosen));
  if (rig_.laps().finished != laps_) {
    laps_ = rig_.laps().finished;
    record_->event(now, "lap", std::to_string(laps_));
  }
}

RunResult CarBench::finish() {
  result_.scenario = scenario_.name;
  result_.mode = "lockstep";
  result_.simulated_s = length_.seconds();
  result_.verdicts = grader_.finish();
  judge_contact(scenario_, result_);
  if (result_.match) judge_match(*scenario_.match, result_);
  result_.laps = rig_.laps();
  for (const std::string& refusal : base_.refusals())
    result_.remarks.push_back("the operator was refused: " + refusal);
  result_.detections_lost += detection_.overflows;
  if (lidars_) {
    result_.sweeps_on_map = lidars_->counts().on_map;
    result_.sweeps_by_cloth = lidars_->counts().by_cloth;
    result_.detections_lost += lidars_->counts().no_room;
  }
  if (cameras_) {
    result_.images = cameras_->counts().images;
    result_.detections_lost += cameras_->counts().no_room;
  }
  result_.traffic.lost = frames_lost();
  result_.traffic.bus_load = bus_.load();
  if (record_) {
    for (const grading::Verdict& verdict : result_.verdicts)
      record_->verdict(Instant{} + length_, verdict);
    record_->close();
    result_.digest = record_->digest();
  }
  return result_;
}

}  // namespace pitwall::bench
