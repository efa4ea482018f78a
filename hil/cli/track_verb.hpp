// `pitwall-hil track`: any team's track, read, checked and looked at before a car meets it.
//
//   check FILE [--json FILE]      length, closure, curvature, widths, banking, what is odd
//   import CSV --out FILE [--name N] [--smooth M] [--datum LAT,LON,H]
//                                 a track file (YAML); columns in hil/track_file/track_csv.hpp
//   picture FILE --out FILE.svg   the track from above
//   FILE of check and picture is a track file (*.yaml) or a CSV, which is imported first
//   out    exit code 0: done; 2: the file was refused with its line, or wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int track_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
