// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/car_summary.hpp"

#include <limits>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::bench {
namespace {

CarSummary::Counts counts_of(yaml::StrictMap map) {
  CarSummary::Counts counts;
  for (const std::string& name : map.keys())
    counts.emplace_back(name, map.integer(name, 0, std::numeric_limits<std::int64_t>::max()));
  return counts;
}

}  // namespace

Result<CarSummary, Problem> read_car_summary(const std::string& path) {
  const auto document = yaml::load_file(path);  // JSON is YAML
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, [](yaml::StrictMap& map) {
    const auto count = [&map](const char* key) {
      return static_cast<std::uint64_t>(
          map.integer(key, 0, std::numeric_limits<std::int64_t>::max()));
    };
    CarSummary car;
    car.ticks = count("ticks");
    car.missed_deadlines = count("missed_deadlines");
    car.frames_received = count("frames_received");
    car.frames_sent = count("frames_sent");
    car.frames_refused = count("frames_refused");
    car.tx_drops = count("tx_drops");
    car.rx_dropped = count("rx_dropped");
    car.gate_refusals = count("gate_refusals");
    car.refused_by_kind = counts_of(map.map("refused_by_kind"));
    car.gate_verdicts = counts_of(map.map("gate_verdicts"));
    car.step_p50_us = map.number("step_p50_us", 0.0, 1e9);
    car.step_p99_us = map.number("step_p99_us", 0.0, 1e9);
    car.step_max_us = map.number("step_max_us", 0.0, 1e9);
    return car;
  });
}

}  // namespace pitwall::bench
