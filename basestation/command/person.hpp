// Operator or viewer at a console of the base station.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::command {

struct Person {
  telemetry::HolderId console = 0;  // 1 .. 254; 0: nobody
  std::string name;

  bool operator==(const Person&) const = default;
};

}  // namespace pitwall::command
