// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/finding.hpp"

namespace pitwall::can {

FindingSeverity severity_of(FindingKind kind) {
  if (kind < FindingKind::kRange) return FindingSeverity::kError;
  return kind < FindingKind::kIndependentSignals ? FindingSeverity::kWarning
                                                 : FindingSeverity::kNote;
}

const char* name_of(FindingSeverity severity) {
  constexpr std::array<const char*, kFindingSeverities> kNames{"error", "warning", "note"};
  return kNames[static_cast<std::size_t>(severity)];
}

const char* plural_of(FindingKind kind) {
  constexpr std::array<const char*, kFindingKinds> kPlurals{
      "places with bytes that are no characters",
      "statements that cannot be read",
      "messages with an id or a name that cannot be",
      "signals that cannot be",
      "signals that overlap others",
      "signals whose multiplexer is not clear",
      "messages longer than a frame",
      "signals with a range that their bits cannot hold",
      "signals with names of values that their bits cannot hold",
      "signals that are never present",
      "messages with a length that no frame has",
      "attributes that do not fit their definition",
      "references to what the file does not have",
      "definitions that are repeated",
      "statements that are no section of a DBC file",
      "files without a message",
      "nodes that are not listed in BU_",
      "signals that nobody receives",
      "lists of signals that belong to no message",
      "changes of encoding"};
  return kPlurals[static_cast<std::size_t>(kind)];
}

std::string text_of(const Finding& finding) {
  return finding.outcome.empty() ? finding.what : finding.what + "; " + finding.outcome;
}

}  // namespace pitwall::can
