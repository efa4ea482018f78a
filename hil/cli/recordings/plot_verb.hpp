// `pitwall-hil plot`: signals of a CAN log or a recording as an SVG file or a page, by the car's
// own database or by another one.
//   errors exit code 2 and a line: an unreadable log or database, an unknown signal or channel, a
//          part of the log that is empty, another suffix; 1: a signal that never comes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int plot_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
