// Two revisions of one CAN database: what changed between them, in words, worst first.
//   in      two databases as the parser gives them
//   out     one line for each difference; none where both mean the same. Looked at: ids, names,
//           lengths, signals with all that decides their bits and values, multiplexing, ranges,
//           periods, senders, names of values, units, comments. Not looked at: receivers, other
//           attributes, the order of the file
//   rule    messages belong together by id, else by name; signals by name, else by equal bits
//   cost    n log n
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/can/database.hpp"

namespace pitwall::can {

// The worst first.
enum class Change : std::uint8_t {
  kIdReused,      // the same id is another message
  kSignalReread,  // other bits, scale, sign, order, multiplexing: other values from the same frame
  kMessageGone,   //
  kMessageMoved,  // to another id
  kMessageNew,    //
  kFrame,         // another length, or CAN FD
  kSignalGone,    //
  kSignalNew,     //
  kRange,         // what an encoder saturates at
  kTiming,        // period, senders
  kValueNames,    //
  kUnit,          //
  kName,          // another word for the same bits
  kComment,       //
};

enum class Severity : std::uint8_t {
  kMisread,  // one reads wrong values from the other's frames without noticing
  kMissing,  // something is only there for one of them
  kMeaning,  // the same values, with other limits, timing or words
};
Severity severity_of(Change change);
const char* name_of(Severity severity);

struct Difference {
  Change change = Change::kComment;
  std::string text;  // "steering_report (1303): ..."
};

std::vector<Difference> differences(const Database& one, const Database& other);

}  // namespace pitwall::can
