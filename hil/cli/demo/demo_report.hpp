// Report of a demo, car by car: verdicts of the bench, packets that the base received, frames that
// candump recorded.
//   in     the folder of a car as its run left it, the exit code of its run
//   out    text lines; JSON for programs; whether all passed
//   errors Problem with the file that is missing or invalid
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "hil/cli/demo/demo_cars.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::cli {

struct BaseFigures {
  std::int64_t packets = 0, lost = 0, refused = 0;
  double rate_hz = kUnset, age_p50_ms = kUnset, age_p99_ms = kUnset;
};

struct CarReport {
  DemoCar car;
  int run_code = 0;
  std::string run_json, base_json;
  BaseFigures base;
  std::size_t dumped = 0;  // frames

  // True if the run passed, the base received this car and, with SocketCAN, candump recorded
  // frames.
  bool held() const {
    return run_code == 0 && base.packets > 0 && (dumped > 0 || car.bus == DemoBus::kSocket);
  }
};

Result<BaseFigures, Problem> read_base(const std::string& path);
Result<CarReport, Problem> read_report(const DemoCar& car, int run_code);

std::string to_text(const CarReport& report);
std::string to_json(const CarReport& report);

// True if the base received packets of every car and refused none, so that no station got packets
// of another car.
bool are_apart(std::span<const CarReport> reports);
std::string apart_text(std::span<const CarReport> reports);

}  // namespace pitwall::cli
