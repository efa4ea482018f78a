// Plant file (hil/config/plants/*.yaml): every number with its source and its uncertainty.
//
//   schema: 1
//   name: av21
//   base: av21          # optional: omitted values are those of the built-in AV-21; else all needed
//   structure: compliant_brush   # optional, default double_track: the equations; decides which
//                                # sections exist (Entry::only_of)
//   chassis:
//     mass_kg: {value: 790, source: "autonoma-awsim asset", spread: 40}
//   drivetrain:
//     gear: {value: [2.9167, ...], source: "...", spread: [0, ...]}     # lists of equal length
//
//   in     text of the file, its name for messages
//   out    Params; spreads, plus and minus in the unit of the value, 0 if not given
//   errors Problem with file:line:column: an unknown, missing or repeated key, a number out of
//          range or not finite, an empty source, a spread that leaves the range, a list out of
//          order, entries that contradict each other anywhere within their spreads
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "hil/plant/params.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::plant {

struct PlantFile {
  std::string name;
  plant::Params params;
  plant::Params spread;  // spread of each entry, in the member of its value
};

Result<PlantFile, Problem> read_plant(const std::string& text, const std::string& name);

// Randomly drawn car within the file's spreads: each entry uniform over value - spread to value +
// spread, a list moved as a whole. One seed gives one car; the draw of an entry does not depend on
// the other entries.
plant::Params drawn(const PlantFile& file, std::uint64_t seed);

}  // namespace pitwall::plant
