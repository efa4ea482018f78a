// The vehicle state as one screen of text: who is heard (a real car or a simulation) or lost, the
// radio's figures, and the fields by group. A function of its arguments: the caller prints.
//   out    one line or more for each group: its name, the age of its sample, its fields with value
//          and unit. A field that is older than its group says its own age
//   marks  ' ' fresh, '~' late, '!' stale (dimmed with ANSI), groups that were never heard are
//          named in one line
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/service/car_service.hpp"
#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers {

struct ViewOptions {
  bool ansi = false;    // colours, and the cursor home at the start
  bool all = false;     // also the groups of health and statistics
  bool below = false;   // under another car's: the cursor stays where it is
  std::string title{};  // a line of its own above all, where there is one
  std::optional<transport::BenchPause> pause{};  // of the bench whose time it is
};

std::string text_view(const service::CarService& car, Instant now, const ViewOptions& options);

}  // namespace pitwall::publishers
