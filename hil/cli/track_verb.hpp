// Subcommand `pitwall-hil track`: imports, checks and draws a track before a car uses it.
//
//   check FILE [--json FILE]      length, closure, curvature, widths, banking, anomalies
//   import CSV --out FILE [--name N] [--smooth M] [--datum LAT,LON,H]
//                                 a track file (YAML); columns in hil/track_file/track_csv.hpp
//   picture FILE --out FILE.svg   plan view of the track
//   FILE of check and picture is a track file (*.yaml) or a CSV file, which is imported first
//   out    exit code 0: done; 2: the file was refused, with the line of the error, or wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int track_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
