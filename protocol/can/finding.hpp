// Findings about the file of a CAN database: the kinds of errors, warnings and notes, worst first,
// and each case with its place.
//   out     an error refuses the file for driving; lenient parsing leaves the item out or keeps it
//           marked, and says which in `outcome`. Warnings and notes refuse nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace pitwall::can {

// The worst first: errors, then warnings, then notes.
enum class FindingKind : std::uint8_t {
  kEncoding,      // bytes that are not characters of the encoding
  kSyntax,        // a statement that cannot be read
  kMessage,       // an id that is used twice or too large, a name that is used twice
  kSignal,        // a signal outside its message, a name used twice, an impossible number
  kOverlap,       // bits used by two signals that can be present together
  kMultiplexing,  // a multiplexer that is missing, ambiguous, or part of a cycle
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
  kIndependentSignals,  // notes from here on
  kConverted,
};
inline constexpr std::size_t kFindingKinds = 20;

enum class FindingSeverity : std::uint8_t { kError, kWarning, kNote };
inline constexpr std::size_t kFindingSeverities = 3;

FindingSeverity severity_of(FindingKind kind);
const char* name_of(FindingSeverity severity);
// Name of several findings of a kind: "signals that nobody receives".
const char* plural_of(FindingKind kind);

struct Finding {
  FindingKind kind = FindingKind::kSyntax;
  std::string place, what;  // place: "file:line:column"
  std::string outcome;      // of an error: the effect in lenient parsing, "signal a is left out"
  std::string subject;  // "message.signal", a node, an attribute; empty: only the place is known
};
// Limit for each kind; further findings are only counted.
inline constexpr std::size_t kMaxFindings = 10'000;

// Example: "signal a is already defined at t.dbc:8:6; it is left out".
std::string text_of(const Finding& finding);

}  // namespace pitwall::can
