// Several recordings as one, on one time base: a car's black box and its rival's, the segments of
// one run, a bus log beside a bag.
//   in     recordings, each with a label and with what its stamps are moved by; their order is
//          their rank
//   out    one recording in total order (stamp, source, sequence): sources stand in the order of
//          the recordings, so the rank decides between equal stamps, then the source, then the
//          order of the file
//   invariants
//          no record is lost or made; records of one recording keep their order. The same inputs
//          give the same output, and merging in steps gives the same as merging at once
//          a source of the same label, name, kind and type as an earlier one goes on in it: so the
//          segments of one run become one recording
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
  std::string label{};  // "car7": its sources are "car7:/can/in"; empty: they keep their names
  Duration offset{};    // added to every stamp
};

Result<Recording, Problem> merge(std::vector<MergeInput> inputs);

}  // namespace pitwall::traffic
