// Vehicle state as one screen of text: whether the car (a real one or a simulation) is received or
// lost, the figures of the radio, and the fields by group. Pure function: the caller prints.
//   out    one line or more for each group: its name, the age of its sample, its fields with value
//          and unit. A field that is older than its group has its own age beside it
//   marks  ' ' fresh, '~' late, '!' stale (dimmed with ANSI); one line lists the groups that were
//          never received
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/service/car_service.hpp"
#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers {

struct ViewOptions {
  bool ansi = false;    // colours, and the cursor to the top left at the start
  bool all = false;     // also the groups of health and statistics
  bool below = false;   // below the screen of another car: the cursor stays
  std::string title{};  // first line of the screen, if not empty
  std::optional<transport::BenchPause> pause{};  // pause of bench time, if the base runs on it
};

std::string text_view(const service::CarService& car, Instant now, const ViewOptions& options);

}  // namespace pitwall::publishers
