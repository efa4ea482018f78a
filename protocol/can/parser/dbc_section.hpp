// Common part of the parsers of DBC sections that refer to an item defined elsewhere: the place of
// the section, its subject, its end, and its findings.
//   in      the scanner after the first word of the section
//   errors  findings of the draft; also of the message that is the subject of the section
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/can/parser/dbc_draft.hpp"
#include "protocol/can/parser/dbc_scanner.hpp"

namespace pitwall::can {

class DbcSection {
 public:
  DbcSection(DbcScanner& scan, DbcDraft& draft)
      : scan_(scan), draft_(draft), begin_(scan.here()), word_(scan.word()) {}

  std::string_view word() const { return word_; }
  std::string place() { return scan_.place_of(begin_); }
  // Reads the number of a message, which becomes the subject of the section.
  std::uint32_t message_key();

  // True at the end of the section. Without a ';' it ends at the next statement or the end of file.
  bool ends();
  void close();
  // Keeps the whole section as text, because its content is not used.
  void keep();

  void warn(FindingKind kind, std::string what, std::string subject = "");
  void report(FindingKind kind, const std::string& where, std::string what, std::string outcome);
  // Warns about a reference to a missing item, unless that item was left out with a finding.
  void warn_unknown_reference(std::uint32_t key, std::string_view signal);

 private:
  DbcScanner& scan_;
  DbcDraft& draft_;
  std::size_t begin_;
  std::string_view word_;
  std::optional<std::size_t> about_;
};

}  // namespace pitwall::can
