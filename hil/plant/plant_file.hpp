// Plant file (hil/config/plants/*.yaml): every number with where it comes from and how far it may
// be off.
//
//   schema: 1
//   name: av21
//   base: av21          # optional: what is left out is the built-in AV-21's; else all is needed
//   structure: compliant_brush   # optional, else double_track: the equations; decides which
//                                # sections there are (Entry::only_of)
//   chassis:
//     mass_kg: {value: 790, source: "autonoma-awsim asset", spread: 40}
//   drivetrain:
//     gear: {value: [2.9167, ...], source: "...", spread: [0, ...]}     # a list: as many each
//
//   in     text of the file, its name for messages
//   out    Params; spreads, plus and minus in the unit of the value, 0 where none is said
//   errors Problem with file:line:column: an unknown, missing or repeated key, a number out of
//          range or not finite, a source that says nothing, a spread that leaves the range, a list
//          out of order, entries that contradict each other anywhere within their spreads
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
  plant::Params spread;  // of each entry, in the place of its value
};

Result<PlantFile, Problem> read_plant(const std::string& text, const std::string& name);

// One of the cars that the file allows: each entry even over value - spread to value + spread, a
// list moved as a whole. One seed, one car; an entry's draw does not depend on the other entries.
plant::Params drawn(const PlantFile& file, std::uint64_t seed);

}  // namespace pitwall::plant
