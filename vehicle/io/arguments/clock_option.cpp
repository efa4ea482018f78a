// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/clock_option.hpp"

#include <CLI/CLI.hpp>

#include "protocol/transport/clock.hpp"

namespace pitwall::io {

void add_clock(CLI::App& app, std::string& clock) {
  app.add_option("--clock", clock,
                 "wall, or the file in which a bench keeps time; that only with --simulation")
      ->capture_default_str();
}

void check_clock(const std::string& clock, bool simulation) {
  if (clock == transport::kWallClock || simulation) return;
  throw CLI::ValidationError("--clock", "the time of a bench is for a --simulation only");
}

}  // namespace pitwall::io
