// Report of a demo: what the run left, and for each car the packets that the base received.
//   in     the cars of the demo, after their run and their base
//   out    text lines; JSON for programs; whether the base heard every car under its own keys
//   errors Problem with the file that is missing or invalid
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hil/cli/demo/demo_cars.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::cli {

struct BaseFigures {
  std::int64_t packets = 0, lost = 0, refused = 0;
  double rate_hz = kUnset, age_p50_ms = kUnset, age_p99_ms = kUnset, silent_ms = kUnset;
};

struct StationReport {
  DemoCar car;
  std::string base_json;
  BaseFigures base;
};

struct DemoReport {
  std::string run_json;
  std::vector<StationReport> stations;  // ours first
  std::size_t dumped = 0;               // frames that candump recorded of our bus

  // True if the base received packets of every car and refused none, so that no station got those
  // of another car.
  bool are_heard() const;
};

Result<BaseFigures, Problem> read_base(const std::string& path);
Result<DemoReport, Problem> read_report(std::span<const DemoCar> cars);

std::string to_text(const DemoReport& report);
std::string to_json(const DemoReport& report);
// What to do with what this demo left; `scenario` is its file.
std::string next_steps(const DemoReport& report, const std::string& scenario);

}  // namespace pitwall::cli
