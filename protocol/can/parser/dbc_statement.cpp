// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_statement.hpp"

#include <algorithm>
#include <array>

namespace pitwall::can {
namespace {

constexpr std::array<std::string_view, 15> kRead{
    "VERSION", "NS_",         "BS_",  "BU_", "BO_",          "SG_",         "VAL_TABLE_", "BA_DEF_",
    "CM_",     "BA_DEF_DEF_", "VAL_", "BA_", "SIG_VALTYPE_", "SG_MUL_VAL_", "BO_TX_BU_"};
// Of the format, but of no use here.
constexpr std::array<std::string_view, 18> kUnused{"EV_",
                                                   "ENVVAR_DATA_",
                                                   "EV_DATA_",
                                                   "SIG_GROUP_",
                                                   "SGTYPE_",
                                                   "SGTYPE_VAL_",
                                                   "SIG_TYPE_REF",
                                                   "SIG_TYPE_REF_",
                                                   "SIGTYPE_VALTYPE_",
                                                   "BA_DEF_REL_",
                                                   "BA_REL_",
                                                   "BA_DEF_DEF_REL_",
                                                   "BA_DEF_SGTYPE_",
                                                   "BA_SGTYPE_",
                                                   "BU_SG_REL_",
                                                   "BU_EV_REL_",
                                                   "BU_BO_REL_",
                                                   "CAT_"};

template <std::size_t N>
bool is_in(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

// What follows the first word in its line.
class RestOfLine {
 public:
  explicit RestOfLine(std::string_view text) : text_(text.substr(0, text.find_first_of("\r\n"))) {
    skip_space();
  }

  char next() const { return text_.empty() ? '\0' : text_[0]; }
  std::string_view word() {
    const std::string_view found = first_word(text_);
    text_.remove_prefix(found.size());
    skip_space();
    return found;
  }

 private:
  void skip_space() { text_.remove_prefix(std::min(text_.find_first_not_of(" \t"), text_.size())); }

  std::string_view text_;
};

bool is_number(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), is_digit);
}

bool is_name(std::string_view word) { return !word.empty() && !is_digit(word[0]); }

bool is_message(RestOfLine rest) {
  return is_number(rest.word()) && is_name(rest.word()) && rest.next() == ':';
}

bool reads_like(std::string_view word, RestOfLine rest) {
  const char next = rest.next();
  if (word == "NS_" || word == "BS_" || word == "BU_") return next == ':';
  if (word == "VERSION" || word == "BA_" || word == "BA_DEF_DEF_") return next == '"';
  if (word == "BO_") return is_message(rest);
  if (word == "SG_" || word == "EV_") {
    if (!is_name(rest.word())) return false;
    if (rest.next() != ':') (void)rest.word();  // the mark of a multiplexer
    return rest.next() == ':';
  }
  if (word == "CM_" || word == "BA_DEF_") {
    const std::string_view owner = rest.word();
    return next == '"' || owner == "BU_" || owner == "BO_" || owner == "SG_" || owner == "EV_";
  }
  return next != '\0';
}

}  // namespace

std::string_view first_word(std::string_view text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_word_character);
  return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

bool is_unused_section(std::string_view word) { return is_in(kUnused, word); }

bool is_section(std::string_view word) { return is_in(kRead, word) || is_unused_section(word); }

bool begins_statement(std::string_view text) {
  const std::string_view word = first_word(text);
  return is_section(word) && reads_like(word, RestOfLine{text.substr(word.size())});
}

bool reads_like_message(std::string_view text) {
  return is_message(RestOfLine{text.substr(first_word(text).size())});
}

bool holds_statement(std::string_view text, std::size_t size) {
  const std::string_view within = text.substr(0, size);
  for (std::size_t at = within.find_first_of("\r\n"); at < size;
       at = within.find_first_of("\r\n", at)) {
    at = within.find_first_not_of(" \t\r\n", at);
    if (at >= size) return false;
    if (begins_statement(text.substr(at))) return true;
  }
  return false;
}

}  // namespace pitwall::can
