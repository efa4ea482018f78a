// Small event logs in the format of the bench, with chosen content: ten seconds along a circle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/result.hpp"
#include "hil/bench/run_record.hpp"
#include "hil/report/run_data.hpp"
#include "protocol/recording/event_log.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::report {

using Bytes = std::vector<std::uint8_t>;

struct LogOrder {
  std::string scenario = "some_run", mode = "lockstep";
  std::string faults = R"([{"kind":"steering_stuck","at_s":4,"lasts_s":2,"can_id":0,"unit":0}])";
  double duration_s = 10.0;
  bool with_car = true, with_failure = false, with_frames = true, close = true;
  double speed_mps = 31.0, error_m = 0.25;
  bool with_contact = false;  // at the end, with a slower car ahead that this one causes
};

inline grading::Verdict some_verdict(bool pass) {
  grading::Verdict v;
  v.name = "some.yaml:7:5";
  v.text = pass ? "always speed_mps > 1, from 1 s" : "never abs_cross_track_m > 2";
  v.pass = pass;
  v.margin = pass ? 30.0 : -0.75;
  if (!pass) {
    v.reason = "2.75 at 6.5 s";
    v.first_violation = at_s(6.5);
  }
  return v;
}

inline bench::TruthSample truth_at(double t_s, const LogOrder& order) {
  bench::TruthSample v{};
  const double radius_m = 100.0, angle_rad = order.speed_mps * t_s / radius_m;
  v.x_m = radius_m * std::cos(angle_rad);
  v.y_m = radius_m * std::sin(angle_rad);
  v.vx_mps = order.speed_mps;
  v.s_m = std::fmod(order.speed_mps * t_s, 200.0);
  v.cross_track_m = order.error_m;
  v.wall_gap_m = 4.0;
  v.ax_mps2 = 1.0;
  v.ay_mps2 = order.speed_mps * order.speed_mps / radius_m;
  v.tyre_fl_c = v.tyre_fr_c = v.tyre_rl_c = v.tyre_rr_c = 85.0;
  v.sys_state = 9;
  v.ct_state = 9;
  v.track_flag = 4;
  return v;
}

// Number 6 stands where this car arrives at the end; its nose is at the tail of that one.
inline bench::OtherSample other_at(const LogOrder& order) {
  const bench::TruthSample at = truth_at(order.duration_s, order);
  return {.number = 6,
          .x_m = at.x_m + 4.9,
          .y_m = at.y_m,
          .yaw_rad = 0.0,
          .vx_mps = 0.0,
          .vy_mps = 0.0,
          .s_m = at.s_m + 4.9,
          .n_m = 0.0};
}

inline bench::CarContact some_contact(const LogOrder& order) {
  const bench::TruthSample at = truth_at(order.duration_s, order);
  const bench::OtherSample other = other_at(order);
  bench::CarContact c{.at = at_s(order.duration_s), .with = "<b>slow</b>", .with_number = 6};
  c.kind = traffic::ContactKind::kStandingCar;
  c.rule = traffic::ContactRule::kStandingCar;
  c.is_caused = true;
  c.closing_mps = order.speed_mps;
  c.s_m = at.s_m;
  c.point_m = {at.x_m + 2.45, at.y_m};
  c.own = {.x_m = at.x_m, .y_m = at.y_m, .yaw_rad = 0.0, .vx_mps = order.speed_mps, .vy_mps = 0.0};
  c.other = {.x_m = other.x_m, .y_m = other.y_m, .yaw_rad = 0.0, .vx_mps = 0.0, .vy_mps = 0.0};
  c.own.n_m = -0.5, c.other.n_m = 0.25;
  for (plant::CarPose* car : {&c.own, &c.other}) car->length_m = 4.9, car->width_m = 1.9;
  return c;
}

inline Bytes log_of(const LogOrder& order) {
  Bytes file;
  recording::EventLog log({{"scenario", order.scenario},
                           {"seed", "7"},
                           {"mode", order.mode},
                           {"source", "simulation"},
                           {"database", "av21.dbc"},
                           {"revision", "V14"},
                           {"fingerprint", "0"},
                           {"bus", "v14"},
                           {"duration_s", std::to_string(order.duration_s)},
                           {"track_file", "no/such/track.yaml"},
                           {"faults", order.faults}},
                          [&file](std::span<const std::uint8_t> bytes) {
                            file.insert(file.end(), bytes.begin(), bytes.end());
                            return true;
                          });
  const auto can = log.channel<bench::CanSample>("/can");
  const auto truth = log.channel<bench::TruthSample>("/truth");
  const auto car = log.channel<bench::CarSample>("/car");
  const auto losses = log.channel<bench::LossSample>("/bus_losses");
  std::optional<recording::SampleChannel<bench::OtherSample>> others;
  if (order.with_contact) others = log.channel<bench::OtherSample>("/others");
  log.start();
  log.event(at_s(0.5), "flag", "green");
  for (int tick = 0; tick * 0.01 <= order.duration_s; ++tick) {
    const double t_s = tick * 0.01;
    log.sample(truth, at_s(t_s), truth_at(t_s, order));
    bench::CarSample car_now{};
    car_now.target_speed_mps = 30.0;
    car_now.mode = 2;
    if (order.with_car) log.sample(car, at_s(t_s), car_now);
    bench::CanSample frame{.from = 1, .id = 1300, .data = {}};
    while (frame.data.size() < 8) CHECK(frame.data.push(0xA5));
    if (order.with_frames) log.sample(can, at_s(t_s), frame);
    if (others) log.sample(*others, at_s(t_s), other_at(order));
  }
  log.sample(losses, at_s(5.0), {.id = 1300, .detector = 1, .frames = 2, .due_s = 4.9});
  if (order.with_contact)
    log.event(at_s(order.duration_s), "contact", bench::to_json(some_contact(order)));
  for (const bool pass : {true, false}) {
    if (!pass && !order.with_failure) continue;
    log.event(at_s(order.duration_s), pass ? "pass" : "fail", bench::to_json(some_verdict(pass)));
  }
  if (order.close) log.close();
  if (!order.close) log.flush();
  return file;
}

inline RunData run_of(const LogOrder& order) { return read_run(log_of(order), "events.mcap"); }

// Text of the result file of `run`.
inline std::string result_of(const RunData& run, Duration behind = {}) {
  bench::RunResult r;
  r.scenario = run.facts.scenario;
  r.mode = run.facts.mode;
  r.laps = {.finished = 1, .flying = 0};
  r.traffic = {.to_car = 1001, .from_car = 17, .lost = 0};
  for (const VerdictRow& v : run.verdicts) r.verdicts.push_back(some_verdict(v.pass));
  r.digest = run.digest;
  r.real_time.emplace().behind_max = behind;
  bench::follow(r.outcome, {.speed_mps = 0.0, .cross_track_m = -0.5, .wall_gap_m = 2.5});
  return bench::to_json(r);
}

inline std::size_t count(const std::string& text, const std::string& what) {
  std::size_t times = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++times;
  return times;
}

}  // namespace pitwall::report
