// Comparison of two revisions of one CAN database: the changes as sentences, worst first.
//   in      two databases from the parser
//   out     one line per difference; empty if both mean the same. Compared: ids, names, lengths,
//           signals with everything that defines their bits and values, multiplexing, ranges,
//           periods, senders, names of values, units, comments. Not compared: receivers, other
//           attributes, the order of the file
//   rule    messages are matched by id, else by name; signals by name, else by equal bits
//   cost    n log n
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/can/database.hpp"

namespace pitwall::can {

// Kinds of change, the worst first.
enum class Change : std::uint8_t {
  kIdReused,      // another message has the same id
  kSignalReread,  // other bits, scale, sign, order, multiplexing: other values from the same frame
  kMessageGone,   //
  kMessageMoved,  // to another id
  kMessageNew,    //
  kFrame,         // another length, or CAN FD
  kSignalGone,    //
  kSignalNew,     //
  kRange,         // limits at which an encoder saturates
  kTiming,        // period, senders
  kValueNames,    //
  kUnit,          //
  kName,          // another name for the same bits
  kComment,       //
};

enum class Severity : std::uint8_t {
  kMisread,  // one side reads wrong values from the other's frames without noticing
  kMissing,  // only one side has the item
  kMeaning,  // the same values, with other limits, timing or names
};
Severity severity_of(Change change);
const char* name_of(Severity severity);

struct Difference {
  Change change = Change::kComment;
  std::string text;  // "steering_report (1303): ..."
};

std::vector<Difference> differences(const Database& one, const Database& other);

}  // namespace pitwall::can
