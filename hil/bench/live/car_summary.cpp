// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/car_summary.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "protocol/can/frame.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::bench {
namespace {

constexpr std::int64_t kMostCounted = std::numeric_limits<std::int64_t>::max();
constexpr double kMostOfAFigure = 1e12;

CarSummary::Counts counts_of(yaml::StrictMap map) {
  CarSummary::Counts counts;
  for (const std::string& name : map.keys())
    counts.emplace_back(name, map.integer(name, 0, std::numeric_limits<std::int64_t>::max()));
  return counts;
}

std::uint64_t count_of(yaml::StrictMap& map, const char* key) {
  return static_cast<std::uint64_t>(map.integer(key, 0, std::numeric_limits<std::int64_t>::max()));
}

Instant instant_of(yaml::StrictMap& map, const char* key) {
  return {map.integer(key, 0, std::numeric_limits<std::int64_t>::max())};
}

std::uint32_t id_of(yaml::StrictMap& map) {
  return static_cast<std::uint32_t>(map.integer("id", 0, can::kMaxExtendedId));
}

CarMessage message_of(yaml::StrictMap map) {
  return {.id = id_of(map),
          .liveness = map.text("liveness"),
          .debt = count_of(map, "debt"),
          .lost = count_of(map, "lost"),
          .bad = count_of(map, "bad"),
          .late = count_of(map, "late"),
          .mean_interval = microseconds(map.integer("mean_interval_us", 0, 1'000'000'000)),
          .last = instant_of(map, "last_ns")};
}

world::LossDetector detector_of(yaml::StrictMap& map) {
  using enum world::LossDetector;
  const std::string by = map.text("by");
  if (by == "counter") return kCounter;
  if (by == "period") return kPeriod;
  if (by == "socket_queue") return kSocketQueue;
  if (by == "interface") return kInterface;
  map.fail("by", "expected one of: counter, period, socket_queue, interface");
}

world::LossReport loss_of(yaml::StrictMap map) {
  return {.id = id_of(map),
          .detector = detector_of(map),
          .frames = static_cast<std::uint32_t>(
              map.integer("frames", 0, std::numeric_limits<std::uint32_t>::max())),
          .due = instant_of(map, "due_ns"),
          .noticed = instant_of(map, "noticed_ns")};
}

void read_radio(yaml::StrictMap map, CarSummary& car) {
  for (const std::string& name : map.keys()) {
    if (name == "refused") {
      car.radio_refused = counts_of(map.map(name));
    } else if (name == "commands") {
      car.radio_commands = counts_of(map.map(name));
    } else if (name == "paths") {
      for (yaml::StrictMap& path : map.maps(name)) car.radio_paths.push_back(counts_of(path));
    } else {
      car.radio.emplace_back(name, count_of(map, name.c_str()));
    }
  }
}

CarReceiver receiver_of(yaml::StrictMap map) {
  CarReceiver receiver{.link = map.text("link"), .kind = map.text("kind"), .counts = {}};
  for (const std::string& name : map.keys()) {
    if (name == "link" || name == "kind") continue;
    const CarSummary::Counts refused =
        name == "refused" ? counts_of(map.map(name))
                          : CarSummary::Counts{{name, map.integer(name, 0, kMostCounted)}};
    receiver.counts.insert(receiver.counts.end(), refused.begin(), refused.end());
  }
  return receiver;
}

// Rates and latencies are of the end of the drive, when nothing comes any more: not kept.
CarSensor sensor_of(yaml::StrictMap& map) {
  CarSensor sensor{.name = map.text("name"), .counts = {}};
  for (const std::string& name : map.keys()) {
    if (name == "name") continue;
    if (name.ends_with("_hz") || name.ends_with("_ms")) {
      map.number(name, 0.0, kMostOfAFigure);
    } else {
      sensor.counts.emplace_back(name, count_of(map, name.c_str()));
    }
  }
  return sensor;
}

void read_tracking(yaml::StrictMap map, CarSummary& car) {
  for (const std::string& name : map.keys()) {
    if (name != "cars") {
      car.tracking.emplace_back(name, count_of(map, name.c_str()));
      continue;
    }
    for (yaml::StrictMap& row : map.maps(name)) {
      const auto figure = [&row](const char* key) {
        return row.number(key, -kMostOfAFigure, kMostOfAFigure);
      };
      car.opponents.push_back(
          {.x_m = figure("x_m"), .y_m = figure("y_m"), .speed_mps = figure("speed_mps")});
      for (const char* other : {"id", "position_sigma_m", "unmeasured_s"}) figure(other);
    }
  }
}

}  // namespace

Result<CarSummary, Problem> read_car_summary(const std::string& path) {
  const auto document = yaml::load_file(path);  // JSON is YAML
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, [](yaml::StrictMap& map) {
    const auto count = [&map](const char* key) { return count_of(map, key); };
    CarSummary car;
    car.ticks = count("ticks");
    car.missed_deadlines = count("missed_deadlines");
    car.frames_received = count("frames_received");
    car.frames_sent = count("frames_sent");
    car.frames_refused = count("frames_refused");
    car.tx_drops = count("tx_drops");
    car.rx_dropped = count("rx_dropped");
    car.gate_refusals = count("gate_refusals");
    car.missed_shifts = count("missed_shifts");
    car.frames_applied = count("frames_applied");
    car.frames_lost = count("frames_lost");
    car.loss_reports = count("loss_reports");
    yaml::StrictMap identity = map.map("identity");
    car.database = identity.text("database");
    car.identity = identity.text("verdict");
    car.identity_sentence = identity.text("sentence");
    yaml::StrictMap link = map.map("link");
    car.controller = link.text("controller");
    for (const std::string& name : link.keys())
      if (name != "controller") car.link.emplace_back(name, count_of(link, name.c_str()));
    for (yaml::StrictMap& row : map.maps("messages")) car.messages.push_back(message_of(row));
    for (yaml::StrictMap& row : map.maps("losses")) car.losses.push_back(loss_of(row));
    read_radio(map.map("radio"), car);
    for (yaml::StrictMap& row : map.maps("receivers")) car.receivers.push_back(receiver_of(row));
    car.recorder = counts_of(map.map("recorder"));
    for (yaml::StrictMap& row : map.maps("sensors")) car.sensors.push_back(sensor_of(row));
    read_tracking(map.map("tracking"), car);
    car.refused_by_kind = counts_of(map.map("refused_by_kind"));
    car.gate_verdicts = counts_of(map.map("gate_verdicts"));
    car.step_p50_us = map.number("step_p50_us", 0.0, 1e9);
    car.step_p99_us = map.number("step_p99_us", 0.0, 1e9);
    car.step_max_us = map.number("step_max_us", 0.0, 1e9);
    car.tick_late_p50_us = map.number("tick_late_p50_us", 0.0, 1e9);
    car.tick_late_p99_us = map.number("tick_late_p99_us", 0.0, 1e9);
    return car;
  });
}

std::uint64_t detections_received(const CarSummary& car) {
  std::uint64_t sum = 0;
  for (const CarSensor& sensor : car.sensors) {
    const auto is = [](const char* name) {
      return [name](const auto& count) { return count.first == name; };
    };
    if (std::ranges::none_of(sensor.counts, is("bad_detections"))) continue;  // detects no cars
    for (const char* name :
         {"samples", "refused", "in_future", "too_old", "foreign_frames", "too_many"}) {
      const auto found = std::ranges::find_if(sensor.counts, is(name));
      if (found != sensor.counts.end()) sum += found->second;
    }
  }
  return sum;
}

std::uint64_t frames_that_never_came(const CarSummary& car, Instant until) {
  std::map<std::uint32_t, std::uint64_t> missing;
  for (const world::LossReport& loss : car.losses)
    if (loss.id != 0 && loss.due <= until) missing[loss.id] += loss.frames;
  for (const CarMessage& message : car.messages)
    if (const auto found = missing.find(message.id); found != missing.end())
      found->second -= std::min(found->second, message.late);
  std::uint64_t sum = 0;
  for (const auto& [id, frames] : missing) sum += frames;
  return sum;
}

}  // namespace pitwall::bench
