// Generator of the C++ header of one CAN database: a struct per message, decode, encode and the
// tables of messages and slew limits. It uses the same plans as the run-time decoder.
//   in      a database, its manifest, the name of the namespace below pitwall::can
//   out     C++ text
//   errors  a contradiction between the two; features that the generated code does not support
//           (multiplexing, 29-bit ids); names that are not C++ identifiers
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/can/database.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can {

Result<std::string, Problem> header_text(const Database& database, const Manifest& manifest,
                                         const std::string& name_space);

// Example: base_to_car_summary -> BaseToCarSummary, Tire_Temp_FL_1 -> TireTempFl1.
std::string struct_name(std::string_view message_name);

}  // namespace pitwall::can
