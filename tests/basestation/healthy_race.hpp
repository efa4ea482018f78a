// Fixture of the alarm evaluator with a healthy car under a green flag: all values known, tyres
// warm, tank filled, on a straight. Each test then changes one thing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>

#include "basestation/alarms/evaluator.hpp"
#include "tests/basestation/known_state.hpp"
#include "tests/basestation/oval_course.hpp"

namespace pitwall {

struct HealthyRace {
  static constexpr Duration kPacket = milliseconds(20);
  KnownState reported;
  alarms::Evaluator evaluator;
  state::LinkFigures link{.received = {}, .down_loss = 0.0, .up_loss = 0.0, .round_trip_ms = 20.0};
  Instant now = kStart;
  bool packets = true;
  std::function<bool(telemetry::Group)> comes = [](telemetry::Group) { return true; };

  static alarms::EvaluatorConfig with_track(alarms::EvaluatorConfig config = {}) {
    config.course = Oval{}.course();
    return config;
  }
  explicit HealthyRace(alarms::EvaluatorConfig config = with_track())
      : evaluator(std::move(config)) {
    using telemetry::field;
    constexpr std::array kHealthy{std::pair{field("mode.mode"), 2.0},
                                  std::pair{field("mode.stop_latch"), 0.0},
                                  std::pair{field("flags.track"), 4.0},
                                  std::pair{field("flags.vehicle"), 0.0},
                                  std::pair{field("flags.track_acted_on"), 4.0},
                                  std::pair{field("flags.vehicle_acted_on"), 0.0},
                                  std::pair{field("flags.conflict"), 0.0},
                                  std::pair{field("ego.x"), -290.0},
                                  std::pair{field("ego.y"), 0.0},
                                  std::pair{field("ego.yaw"), 0.0},
                                  std::pair{field("ego.vx"), 50.0},
                                  std::pair{field("ego.validity"), 1.0},
                                  std::pair{field("ego.position_sigma"), 0.05},
                                  std::pair{field("track.station"), 20.0},
                                  std::pair{field("track.offset"), 0.0},
                                  std::pair{field("track.lap"), 3.0},
                                  std::pair{field("track.target_speed"), 50.0},
                                  std::pair{field("planner.operator_limit"), 50.0},
                                  std::pair{field("wheels.front_left"), 50.0},
                                  std::pair{field("wheels.front_right"), 50.0},
                                  std::pair{field("wheels.rear_left"), 50.5},
                                  std::pair{field("wheels.rear_right"), 50.5},
                                  std::pair{field("tyres.temperature_front_left"), 85.0},
                                  std::pair{field("tyres.temperature_front_right"), 85.0},
                                  std::pair{field("tyres.temperature_rear_left"), 85.0},
                                  std::pair{field("tyres.temperature_rear_right"), 85.0},
                                  std::pair{field("engine.running"), 1.0},
                                  std::pair{field("engine.oil_pressure"), 500.0},
                                  std::pair{field("fuel.level"), 40.0},
                                  std::pair{field("gnss0.status"), 0.0},
                                  std::pair{field("gnss0.sigma"), 0.02},
                                  std::pair{field("gnss0.satellites"), 14.0},
                                  std::pair{field("gnss0.differential_age"), 1.0},
                                  std::pair{field("gnss0.speed"), 50.0},
                                  std::pair{field("gnss1.status"), 0.0},
                                  std::pair{field("gnss1.sigma"), 0.02},
                                  std::pair{field("gnss1.satellites"), 14.0},
                                  std::pair{field("gnss1.differential_age"), 1.0},
                                  std::pair{field("gnss1.speed"), 50.0}};
    for (const auto& [index, value] : kHealthy) set(index, value);
  }

  // Sets the value of a field from the next packet on.
  void set(telemetry::FieldIndex index, double value) {
    reported.snapshot.values[index] = value;
    known_.add(telemetry::kFields[index].group);
  }
  void tyres(double celsius) {
    using telemetry::field;
    for (const auto index :
         {field("tyres.temperature_front_left"), field("tyres.temperature_front_right"),
          field("tyres.temperature_rear_left"), field("tyres.temperature_rear_right")}) {
      set(index, celsius);
    }
  }
  // Sends packets every 20 ms, and advances the evaluator `polls` times per packet.
  void run(Duration length, int polls = 1) {
    for (const Instant end = now + length; now < end;) {
      for (int i = 1; i < polls; ++i)
        evaluator.advance(reported.vehicle, now + kPacket * i / polls);
      now += kPacket;
      evaluator.advance(reported.vehicle, now);
      if (packets) packet();
    }
    evaluator.advance(reported.vehicle, now);
  }
  bool alarm(std::string_view key) const {
    const alarms::State state = evaluator.alarms().state(*alarms::find_alarm(key));
    return state == alarms::State::kUnack || state == alarms::State::kAcked;
  }
  bool ever(std::string_view key) const {
    for (const alarms::AlarmEvent& event : evaluator.alarms().history())
      if (event.key == key) return true;
    return false;
  }

 private:
  void packet() {
    telemetry::GroupSet groups;
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      if (!known_.has(row.group) || !comes(row.group)) continue;
      reported.snapshot.at(row.group) = now - milliseconds(10);
      groups.add(row.group);
    }
    reported.vehicle.update(reported.snapshot, groups);
    link.received = now;
    evaluator.link(link);
  }

  telemetry::GroupSet known_;
};

}  // namespace pitwall
