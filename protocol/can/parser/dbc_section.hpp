// One section of a DBC file that speaks of something that is already known: where it stands, what
// it is about, how it ends, and what is told of it.
//   in      the scanner just behind the section's first word
//   errors  findings of the draft; also of the message that the section is about
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
  // The number of a message; from here on the section is about that one.
  std::uint32_t message_key();

  // The end of the section; without a ';' the next statement or the end of the file.
  bool ends();
  void close();
  // The whole section as it is, because what it speaks of is not read.
  void keep();

  void warn(FindingKind kind, std::string what, std::string subject = "");
  void report(FindingKind kind, const std::string& where, std::string what, std::string outcome);
  // A warning for what the file does not have; none for what was left out and told before.
  void stranger(std::uint32_t key, std::string_view signal);

 private:
  DbcScanner& scan_;
  DbcDraft& draft_;
  std::size_t begin_;
  std::string_view word_;
  std::optional<std::size_t> about_;
};

}  // namespace pitwall::can
