// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/run_record.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "hil/bench/result.hpp"
#include "hil/bench/signals.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

std::string fingerprint_text() {
  return formatted("%016llx", static_cast<unsigned long long>(can::av21::kFingerprint));
}

std::string seconds_text(Duration span) { return formatted("%.6f", span.seconds()); }

// Times in seconds of the run; "lasts_s" 0: until the end. Kinds are words of the catalogue.
std::string faults_text(const std::vector<scenario::Fault>& faults) {
  json::Array out;
  for (const scenario::Fault& fault : faults)
    out.json(json::Object{}
                 .text("kind", fault.kind)
                 .number("at_s", fault.at.seconds())
                 .number("lasts_s", fault.lasts.seconds())
                 .number("can_id", fault.can_id)
                 .number("unit", fault.unit)
                 .str());
  return out.str();
}

}  // namespace

RunRecord::RunRecord(const scenario::Scenario& scenario, std::string_view mode,
                     recording::Sink sink, bool has_others)
    : log_({{"scenario", scenario.name},
            {"seed", std::to_string(scenario.seed)},
            {"mode", std::string(mode)},
            {"source", "simulation"},
            {"database", can::av21::kDatabase},
            {"revision", can::av21::kRevision},
            {"fingerprint", fingerprint_text()},
            {"bus", scenario::name_of(scenario.bus)},
            {"duration_s", seconds_text(scenario.duration)},
            {"track_file", scenario.track_file},
            {"faults", faults_text(scenario.faults)}},
           std::move(sink)),
      can_(log_.channel<CanSample>("/can")),
      truth_(log_.channel<TruthSample>("/truth")),
      car_(log_.channel<CarSample>("/car")),
      losses_(log_.channel<LossSample>("/bus_losses")) {
  if (has_others) {
    others_ = log_.channel<OtherSample>("/others");
    opponents_ = log_.channel<OpponentSample>("/opponents");
  }
  log_.start();
}

void RunRecord::can(Node from, const can::Frame& frame, Instant at) {
  CanSample sample{.from = static_cast<std::uint8_t>(from), .id = frame.id, .data = {}};
  for (const std::uint8_t byte : frame.payload()) CHECK(sample.data.push(byte));
  log_.sample(can_, at, sample);
}

void RunRecord::truth(const Rig& rig, Instant at, double cross_track_m) {
  using enum world::Corner;
  const plant::Truth& t = rig.truth();
  const auto tyre_c = [&t](world::Corner c) { return t.tyre_c[static_cast<std::size_t>(c)]; };
  const plant::Road& r = rig.road();
  log_.sample(truth_, at,
              TruthSample{.x_m = t.x_m,
                          .y_m = t.y_m,
                          .yaw_rad = t.yaw_rad,
                          .vx_mps = t.vx_mps,
                          .vy_mps = t.vy_mps,
                          .yaw_rate_rad_per_s = t.yaw_rate_rad_per_s,
                          .s_m = r.s_m,
                          .n_m = r.n_m,
                          .bank_rad = t.bank_rad,
                          .steering_motor_rad = t.steering_motor_rad,
                          .throttle = t.throttle_fraction,
                          .brake_kpa = t.brake_front_kpa,
                          .engine_rpm = t.engine_rpm,
                          .friction_use = t.friction_use,
                          .wall_gap_m = wall_gap_m(rig),
                          .cross_track_m = cross_track_m,
                          .ax_mps2 = t.specific_force_mps2[0],
                          .ay_mps2 = t.specific_force_mps2[1],
                          .tyre_fl_c = tyre_c(kFrontLeft),
                          .tyre_fr_c = tyre_c(kFrontRight),
                          .tyre_rl_c = tyre_c(kRearLeft),
                          .tyre_rr_c = tyre_c(kRearRight),
                          .gear = t.gear,
                          .sys_state = static_cast<std::uint8_t>(rig.system_state()),
                          .ct_state = static_cast<std::uint8_t>(rig.ct_state()),
                          .track_flag = static_cast<std::uint8_t>(rig.flags().track)});
}

CarSample car_sample(const pipeline::Outputs& out) {
  return {.x_m = out.ego.x_m,
          .y_m = out.ego.y_m,
          .yaw_rad = out.ego.yaw_rad,
          .vx_mps = out.ego.vx_mps,
          .vy_mps = out.ego.vy_mps,
          .yaw_rate_rad_per_s = out.ego.yaw_rate_rad_per_s,
          .position_sigma_m = out.ego.position_sigma_m,
          .target_speed_mps = out.tracking.target_speed_mps,
          .cross_track_m = out.tracking.cross_track_m,
          .road_wheel_rad = out.chosen.command.road_wheel_rad,
          .throttle = out.chosen.command.throttle_fraction,
          .brake_kpa = out.chosen.command.brake_kpa,
          .gear = out.chosen.command.gear,
          .mode = static_cast<std::uint8_t>(out.chosen.mode),
          .cause = static_cast<std::uint8_t>(out.chosen.cause),
          .validity = static_cast<std::uint8_t>(out.ego.validity),
          .ct_state = static_cast<std::uint8_t>(out.ct_state),
          .frames_refused = out.received.bus.refused.total(),
          .gate_refusals = out.passed.refused_total};
}

void RunRecord::car(const pipeline::Outputs& out, Instant at) {
  log_.sample(car_, at, car_sample(out));
  for (const world::LossReport& noticed : out.received.bus.losses) loss(noticed);
  if (!opponents_) return;
  for (const world::Opponent& car : out.opponents.cars)
    log_.sample(*opponents_, at,
                OpponentSample{.id = car.id,
                               .x_m = car.x_m,
                               .y_m = car.y_m,
                               .yaw_rad = car.yaw_rad,
                               .speed_mps = car.speed_mps,
                               .s_m = car.s_m,
                               .n_m = car.n_m,
                               .position_sigma_m = position_sigma_m(car),
                               .age_s = (out.opponents.at - car.measured_at).seconds()});
}

void RunRecord::others(const Field& field, std::size_t own, Instant at) {
  if (!others_) return;
  for (const std::size_t i : field.in_order()) {
    if (i == own) continue;
    const plant::CarPose& pose = field.car(i).pose;
    log_.sample(*others_, at,
                OtherSample{.number = field.number(i),
                            .x_m = pose.x_m,
                            .y_m = pose.y_m,
                            .yaw_rad = pose.yaw_rad,
                            .vx_mps = pose.vx_mps,
                            .vy_mps = pose.vy_mps,
                            .s_m = pose.s_m,
                            .n_m = pose.n_m});
  }
}

void RunRecord::loss(const world::LossReport& loss) {
  log_.sample(losses_, loss.noticed,
              LossSample{.id = loss.id,
                         .detector = static_cast<std::uint8_t>(loss.detector),
                         .frames = loss.frames,
                         .due_s = loss.due.seconds()});
}

void RunRecord::event(Instant at, std::string_view name, std::string_view text) {
  log_.event(at, name, text);
}

void RunRecord::contact(const CarContact& contact) {
  event(contact.at, "contact", to_json(contact));
}

void RunRecord::verdict(Instant at, const grading::Verdict& verdict) {
  event(at, verdict.pass ? "pass" : "fail", to_json(verdict));
}

bool RunRecord::close() { return log_.close(); }

std::string RunRecord::digest() const { return bits::to_hex(log_.digest()); }

}  // namespace pitwall::bench
