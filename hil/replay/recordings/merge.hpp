// Merge of several recordings into one on a common time base: for example of two cars, of the
// segments of one run, or of a bus log and a bag.
//   in     recordings, each with a label and a time offset; their order in the list is their rank
//   out    one recording in total order (stamp, source, sequence). Sources stand in the order of
//          the recordings, so the rank decides between equal stamps, then the source, then the
//          order of the file
//   invariants
//          no record is lost or added; records of one recording keep their order. The same inputs
//          give the same output, and merging in steps gives the same as merging at once
//          sources with equal label, name, kind and type become one source, so the segments of one
//          run become one recording
//   errors Problem for an offset beyond kLongestOffset
//   cost   O(n log n) comparisons; bytes are moved, not copied
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/replay/recordings/recording.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

inline constexpr Duration kLongestOffset = seconds(2'000'000'000);  // 63 years

struct MergeInput {
  Recording recording;
  std::string label{};  // prefix of the sources: "car7" gives "car7:/can/in"; empty: no prefix
  Duration offset{};    // added to every stamp
};

Result<Recording, Problem> merge(std::vector<MergeInput> inputs);

}  // namespace pitwall::traffic
