// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/step.hpp"

#include <cmath>

namespace pitwall::pipeline {
namespace {

using safety::Follow;
using world::Mode;

constexpr Duration kGuardianEcho = milliseconds(50);  // its last frames are on their way

// Curvilinear place of the car and the road there, for the next tick's localization.
world::Curvilinear place_of(const Setup& setup, Car& car, const world::EgoState& ego) {
  if (!std::isfinite(ego.x_m) || !std::isfinite(ego.y_m)) return {};
  const auto hint =
      std::isfinite(car.station_m) ? std::optional<double>{car.station_m} : std::nullopt;
  const world::Curvilinear place = setup.track.project(ego.x_m, ego.y_m, hint);
  car.station_m = place.s_m;
  const world::RoadPoint road = setup.track.road(place.s_m, place.n_m);
  car.bank_rad = road.bank_rad;
  car.surroundings = {.road = {.x_m = ego.x_m,
                               .y_m = ego.y_m,
                               .height_m = road.height_m,
                               .bank_rad = road.bank_rad,
                               .climb_rad = road.climb_rad,
                               .direction_rad = setup.track.at(place.s_m).yaw_rad},
                      .at = ego.at,
                      .learned = car.learned};
  return place;
}

world::Opponents track_opponents(const Setup& setup, Car& car, const world::EgoState& ego,
                                 const Inputs& in) {
  return tracking::step(setup.params.tracking, car.tracking,
                        {.frames = in.detections,
                         .ego = ego,
                         .track = &setup.track,
                         .use = car.orders.use,
                         .now = in.now})
      .opponents;
}

planning::Followed followed(const Car& car) {
  switch (car.follow) {
    case Follow::kNone:
      return planning::Followed::kNothing;
    case Follow::kDrive:
      return car.supervisor.mode == Mode::kCoast ? planning::Followed::kCoast
                                                 : planning::Followed::kDrive;
    case Follow::kStop:
      break;
  }
  return car.supervisor.mode == Mode::kEmergencyStop ? planning::Followed::kEmergency
                                                     : planning::Followed::kStop;
}

void plan_when_due(const Setup& setup, Car& car, const Outputs& out, const Inputs& in) {
  Plan& plan = car.plan;
  // Half a tick before: ticks come microseconds early or late, and one that comes early is no
  // reason to plan a whole tick later.
  const Rates& rates = setup.params.rates;
  if (plan.ever && in.now - plan.at < rates.planning - rates.tick / 2) return;
  world::Trajectory stop = plan.output.stop;
  const steering::Params& p = setup.params.control.steering;
  const steering::AngleBudget angles{.limits = setup.angles,
                                     .car = p.bicycle,
                                     .learning = p.learning,
                                     .learned = car.learned,
                                     .share = setup.params.planning.steer_share,
                                     .stray_m_rad_per_s2 = stray_m_rad_per_s2(p)};
  plan.output =
      planning::step(setup.params.planning, setup.line, setup.track, plan.output.next,
                     {.ego = out.ego,
                      .race_control = out.race_control,
                      .operator_speed_limit_mps = out.speed_limit_mps,
                      .followed = followed(car),
                      .fuel = car.fuel.left(setup.params.fuel).state,
                      .tyre_c = world::coldest_c(out.received.signals.tyre_temperature_c, in.now),
                      .steering = &angles,
                      .other_lines = setup.other_lines,
                      .pit = setup.pit ? &*setup.pit : nullptr,
                      .cars = &out.opponents},
                     in.now);
  const bool good = !plan.output.drive.points.empty() && !plan.output.stop.points.empty();
  // Who stops without localization has no other path than the last one.
  if (plan.output.stop.points.empty()) plan.output.stop = stop;
  plan.made_with = out.race_control;
  plan.at = in.now;
  if (good) plan.good_at = in.now;
  plan.ever = true;
}

safety::SupervisorOutput supervise(const Setup& setup, Car& car, const Outputs& out,
                                   const Inputs& in) {
  const bool usable =
      car.follow == Follow::kStop || out.steered.lateral.verdict == control::LateralVerdict::kGood;
  return safety::supervise(setup.params.supervisor, car.supervisor,
                           {.signals = out.received.signals,
                            .bus = out.received.bus,
                            .race_control = out.race_control,
                            .ego = out.ego,
                            .watchdog = out.watchdog,
                            .stop = car.plan.output.stop,
                            .control = out.steered.command,
                            .control_ok = usable,
                            .drive_available = !car.plan.output.drive.points.empty(),
                            .own_id_seen = out.received.own_id_seen || in.guardian.stopped,
                            .bus_failed = out.bus_guard.failed,
                            .gate_refused = car.gate_refused,
                            .operator_requests = out.requests,
                            .last_run_armed = in.last_run_armed,
                            .radio = out.radio,
                            .sensors = &in.sensors,
                            .computer = in.computer,
                            .learned = car.learned},
                           in.now);
}

// By the speed that the gate will judge by, less a step of the field.
double angle_max_rad(const Setup& setup, const Outputs& out, Instant now) {
  const double step_rad = from_deg(1.0) / setup.params.outbound.steering_ratio;
  const double speed_mps = safety::wheel_speed_mps(out.received.signals, now, safety::kWheelAgeMax);
  return steering::angle_max_rad(setup.angles, speed_mps) - step_rad;
}

// What is learned is that of the own line; a trajectory that merges is beside it.
control::LinePlace line_place(const Setup& setup, const Plan& plan) {
  if (plan.output.next.merge.length_m > 0.0 || plan.output.next.line != 0) return {};
  return {plan.output.line_s_m, setup.line.length_m};
}

// The stop's own follower drives in a stop. What the car's steering needs is learned while it is
// driven, and known when it stops.
void drive(const Setup& setup, Car& car, const Inputs& in, Outputs& out) {
  const steering::Params& p = setup.params.supervisor.safe_stop.steering;
  const world::EgoState& ego = out.ego;
  if (car.supervisor.last_known)
    follow_command(p.learning, car.learned, car.supervisor.last.road_wheel_rad, in.dt);
  if (car.follow == Follow::kStop) return;
  if (car.follow == Follow::kDrive && control::is_usable(ego))
    learn(p.learning, p.bicycle, car.learned,
          {ego.vx_mps, ego.yaw_rate_rad_per_s, car.bank_rad, ego.vy_mps}, in.dt);
  const world::VehicleSignals& signals = out.received.signals;
  out.steered =
      control::step(setup.params.control, setup.gains, car.control,
                    {.ego = ego,
                     .trajectory = car.plan.output.drive,
                     .learned = car.learned,
                     .line = line_place(setup, car.plan),
                     .angle_max_rad = angle_max_rad(setup, out, in.now),
                     .gearbox = control::gear_report(signals.powertrain, in.now),
                     .tyre_c = world::coldest_c(signals.tyre_temperature_c, in.now),
                     .climb_rad = car.surroundings.road.climb_rad,
                     .drives = car.follow == Follow::kDrive,
                     .applied = car.supervisor.last_known ? &car.supervisor.last : nullptr},
                    in.now, in.dt);
  car.control = out.steered.next;
  out.tracking = {out.steered.lateral.cross_track_m, out.steered.lateral.heading_error_rad,
                  out.steered.target_speed_mps};
}

// A stop by feedback knows where it is on its path.
Tracking tracking_of(const Car& car, const Tracking& driven) {
  const safety::SafeStopState& stop = car.supervisor.safe_stop;
  if (!stop.active || !stop.located) return driven;
  return {stop.following.lateral_m, stop.following.heading_rad, stop.following.speed_mps};
}

world::CtState handshake(const Setup& setup, Car& car, const Outputs& out, const Inputs& in) {
  return gateway::handshake(setup.params.handshake, car.handshake,
                            {.sys = out.received.signals.misc.value.sys_state,
                             .track = out.race_control.track,
                             .vehicle = out.race_control.vehicle,
                             .mode = out.chosen.mode,
                             .speed_mps = out.chosen.speed_mps,
                             .operator_shutdown = false,
                             .operator_emergency = out.requests.emergency_stop,
                             .engine_off = out.chosen.engine_off},
                            in.now);
}

// The guardian's frames bear the car's ids; its last command is where the car goes on.
void apply_guardian(Car& car, const GuardianView& guardian, Instant now) {
  car.inbound.guardian_control = {.from = guardian.drove_from,
                                  .until = guardian.drove_until + kGuardianEcho};
  if (guardian.drove_from == guardian.drove_until) car.inbound.guardian_control = {};
  if (!guardian.drives || car.supervisor.mode == Mode::kDisarmed) return;
  car.supervisor.last = guardian.command;
  car.supervisor.last_known = true;
  car.supervisor.last_chosen = now;
  car.outbound.brake_counter = static_cast<std::uint8_t>(guardian.counters.brake + 1);
  car.outbound.throttle_counter = static_cast<std::uint8_t>(guardian.counters.throttle + 1);
  car.outbound.steering_counter = static_cast<std::uint8_t>(guardian.counters.steering + 1);
  car.outbound.report_counter =
      static_cast<std::uint8_t>((guardian.counters.report + 1) % gateway::kReportCounterEnd);
}

// Inputs of the operator, before anything is decided. The limit of the link-loss policy is that of
// the tick before: the watchdog judges after planning.
void apply_operator(const Setup& setup, Car& car, const Inputs& in, Outputs& out) {
  out.requests = execute(car.orders,
                         {.switches = in.requests,
                          .operator_inputs = in.operator_inputs,
                          .commands = in.commands,
                          .may_arm = in.may_arm,
                          .mode = car.supervisor.mode,
                          .stands = car.supervisor.standing,
                          .now = in.now},
                         out.answers);
  car.fuel.enter(car.orders.fuel_entered_l);
  out.race_control = acted_on(out.received.race_control, car.orders.flag,
                              setup.params.planning.line.speed_max_mps);
  // The lowest; fmin takes NaN as no limit.
  out.speed_limit_mps =
      std::fmin(std::fmin(in.operator_speed_limit_mps, car.orders.speed_limit_mps),
                car.link_loss.speed_limit_mps);
}

void follow_fuel(Car& car, const gateway::InboundOutput& received) {
  const auto& engine = received.signals.powertrain;
  if (!engine.received) return;
  car.fuel.receive_engine({.speed_rpm = engine.value.engine_speed_rpm,
                           .throttle = engine.value.throttle_fraction,
                           .running = engine.value.engine_running},
                          engine.at, received.race_control.lap_count);
}

void encode_commands(const Setup& setup, Car& car, const Inputs& in, Outputs& out) {
  const CarParams& p = setup.params;
  const auto encoded = gateway::encode(p.outbound, car.outbound,
                                       {.command = out.chosen.command,
                                        .actuate = out.chosen.actuate,
                                        .ct_state = out.ct_state,
                                        .acted_on = car.plan.made_with,
                                        .ego = out.ego},
                                       in.now);
  out.passed = safety::gate(p.gate, car.gate,
                            {.mode = out.chosen.mode,
                             .armed = out.chosen.actuate,
                             .speed_mps = out.chosen.speed_mps,
                             .command_at = out.chosen.command.at,
                             .now = in.now,
                             .engine_off = out.chosen.engine_off},
                            encoded.frames.span());
  car.gate_refused = out.passed.refused_now;
}

}  // namespace

Outputs step(const Setup& setup, Car& car, const Inputs& in) {
  const CarParams& p = setup.params;
  Outputs out;
  apply_guardian(car, in.guardian, in.now);
  gateway::store_command(car.inbound, car.supervisor.last,
                         car.supervisor.last_known && car.supervisor.mode != Mode::kDisarmed,
                         in.now);
  out.received = gateway::decode(p.inbound, car.inbound, in.can, in.now);
  const bool armed = car.supervisor.mode != Mode::kDisarmed;
  out.received.bus.identity = gateway::identify(p.identity, car.identity, in.can, armed, in.now);
  gateway::observe_link(car.inbound, out.received.bus, in.link, in.now);

  apply_operator(setup, car, in, out);
  follow_fuel(car, out.received);
  const auto located =
      localization::step(p.localization, setup.datum, car.localization, in.sensors,
                         out.received.signals, car.surroundings, car.orders.use, in.now);
  out.ego = located.ego;
  out.located = located.verdicts;
  out.estimate = located.estimate;
  out.in_use = located.in_use;
  out.place = place_of(setup, car, out.ego);
  out.opponents = track_opponents(setup, car, out.ego, in);

  plan_when_due(setup, car, out, in);
  drive(setup, car, in, out);

  out.watchdog = safety::watch(p.watchdog, car.watchdog,
                               {.sensors = in.sensors,
                                .signals = out.received.signals,
                                .race_control = out.received.race_control,
                                .gnss_byte_at = in.gnss_byte_at,
                                .planner_at = car.plan.good_at,
                                .radio_at = in.radio_at,
                                .use = car.orders.use},
                               in.now);
  out.radio = safety::apply_link_loss_policy(p.radio.link_loss, car.link_loss,
                                             out.watchdog[safety::Stream::kRadio],
                                             in.operator_inputs.joystick, in.now);
  const bool resettable = car.bus_guard.failed || in.guardian.stopped;
  out.bus_guard =
      safety::guard(p.bus_guard, car.bus_guard, out.received.bus.link, out.requests.reset, in.now);
  const Mode before = car.supervisor.mode;
  out.chosen = supervise(setup, car, out, in);
  conclude(car.orders, before, out.chosen, resettable, in.now, out.answers);
  car.follow = out.chosen.follow;
  out.tracking = tracking_of(car, out.tracking);
  out.ct_state = handshake(setup, car, out, in);

  out.quiet = in.guardian.drives;
  car.gate_refused = false;
  if (!out.quiet) encode_commands(setup, car, in, out);
  out.seen = findings_of(out, located.seen);
  ++car.ticks;
  return out;
}

world::MonitorSet findings_of(const Outputs& out, world::MonitorSet by_localization) {
  world::MonitorSet all = by_localization;
  all.add(out.received.seen);
  all.add(out.watchdog.seen);
  all.add(out.bus_guard.seen);
  all.add(out.chosen.seen);
  return all;
}

}  // namespace pitwall::pipeline
