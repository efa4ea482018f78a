// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_section.hpp"

#include <limits>
#include <utility>

namespace pitwall::can {

std::uint32_t DbcSection::message_key() {
  const auto key =
      static_cast<std::uint32_t>(scan_.integer(0, std::numeric_limits<std::uint32_t>::max()));
  about_ = draft_.message(key);
  return key;
}

bool DbcSection::ends() {
  if (scan_.take(';')) return true;
  if (!scan_.at_end() && !scan_.at_statement()) return false;
  report(FindingKind::kSyntax, scan_.place(), "expected ';'", "it is read as if it were there");
  return true;
}

void DbcSection::close() {
  if (!ends()) scan_.expect(';');
}

void DbcSection::keep() {
  scan_.rewind(begin_);
  (void)scan_.statement();
  const std::string_view text = scan_.since(begin_);
  if (!text.ends_with(';')) {
    report(FindingKind::kSyntax, scan_.place(), "expected ';'", "it is read as if it were there");
  }
  draft_.database.unused.push_back({std::string{word_}, scan_.utf8(text), place(), true});
}

void DbcSection::warn(FindingKind kind, std::string what, std::string subject) {
  draft_.find({kind, place(), std::move(what), "", std::move(subject)});
}

void DbcSection::report(FindingKind kind, const std::string& where, std::string what,
                        std::string outcome) {
  Finding f{kind, where, std::move(what), std::move(outcome), ""};
  if (!about_) return draft_.find(std::move(f));
  draft_.flaw(draft_.database.messages[*about_], std::move(f));
}

void DbcSection::warn_unknown_reference(std::uint32_t key, std::string_view signal) {
  if (key == kIndependentSignals || draft_.is_left_out(key, std::string{signal})) return;
  const auto at = draft_.message(key);
  const std::string id = std::to_string(key & ~kExtendedBit);
  if (!at) {
    return warn(FindingKind::kReference,
                std::string{word_} + " of message " + id + ", which the file does not have", id);
  }
  const std::string& name = draft_.database.messages[*at].name;
  warn(FindingKind::kReference,
       std::string{word_} + ": message " + name + " has no signal " + std::string{signal},
       name + "." + std::string{signal});
}

}  // namespace pitwall::can
