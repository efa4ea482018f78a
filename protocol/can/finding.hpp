// What is wrong or odd in the file of a CAN database: the kinds, worst first, and each case with
// its place.
//   out     an error refuses the file where a car is driven; a lenient reading leaves out what is
//           bad or keeps it marked, and says so in `outcome`. Warnings and notes refuse nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace pitwall::can {

// The worst first: errors, then warnings, then notes.
enum class FindingKind : std::uint8_t {
  kEncoding,      // bytes that are no characters of the encoding
  kSyntax,        // a statement that cannot be read
  kMessage,       // an id that is taken or too large, a name that is taken
  kSignal,        // a signal outside its message, a name that is taken, a number that cannot be
  kOverlap,       // bits claimed twice by signals that can be present together
  kMultiplexing,  // a multiplexer that is not there, that could be several, or that forms a circle
  kTooLong,       // more bytes than a frame has
  kRange,         // warnings from here on
  kValueNames,
  kNeverPresent,
  kFrameLength,
  kAttribute,
  kReference,
  kRepeated,
  kUnknownSection,
  kNoMessage,
  kNode,
  kUnreceived,
  kParked,  // notes from here on
  kConverted,
};
inline constexpr std::size_t kFindingKinds = 20;

enum class FindingSeverity : std::uint8_t { kError, kWarning, kNote };
inline constexpr std::size_t kFindingSeverities = 3;

FindingSeverity severity_of(FindingKind kind);
const char* name_of(FindingSeverity severity);
// What several of a kind are called: "signals that nobody receives".
const char* plural_of(FindingKind kind);

struct Finding {
  FindingKind kind = FindingKind::kSyntax;
  std::string place, what;  // place: "file:line:column"
  std::string outcome;  // of an error: what a lenient reading made of it, "signal a is left out"
  std::string subject;  // "message.signal", a node, an attribute; empty: only the place tells
};
// Of each kind; what is beyond is only counted.
inline constexpr std::size_t kMaxFindings = 10'000;

// "signal a is already defined at t.dbc:8:6; it is left out"
std::string text_of(const Finding& finding);

}  // namespace pitwall::can
