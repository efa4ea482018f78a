// Subcommand `pitwall-hil plot`: plots signals of a CAN log or a recording as an SVG file or an
// HTML page, decoded with the car's own database or another one.
//   errors exit code 2 and a line: an unreadable log or database, an unknown signal or channel, an
//          empty part of the log, an unknown suffix; 1: a signal without any value
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int plot_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
