// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/message_rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace pitwall::tidy {
namespace {

// What makes an error: the last argument is the message.
constexpr std::array<std::string_view, 6> kMakers{"Problem{", "Problem(", "fail(",
                                                  "refuse(",  "refusal(", "problem("};

// How a bare description of what should have been begins.
constexpr std::array<std::string_view, 8> kBare{"a ",       "an ",   "one of ", "at least ",
                                                "at most ", "from ", "0 to ",   "1 to "};

bool lies_in_product(const std::string& path) {
  return std::ranges::any_of(std::array{"protocol", "vehicle", "basestation", "hil"},
                             [&](const char* top) { return lies_in(path, top); });
}

std::size_t line_at(const std::string& text, std::size_t at) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// The arguments from `begin` to the bracket that closes them, split at the commas of their level.
// Brackets are looked for in the code, where the inside of a text is blank.
std::vector<std::string> arguments_at(const SourceFile& file, std::size_t begin) {
  std::vector<std::string> arguments(1);
  int depth = 0;
  for (std::size_t at = begin; at < file.code.size(); ++at) {
    const char c = file.code[at];
    if (c == '(' || c == '{' || c == '[') ++depth;
    if ((c == ')' || c == '}' || c == ']') && --depth < 0) return arguments;
    if (c == ',' && depth == 0) {
      arguments.emplace_back();
    } else {
      arguments.back() += file.text[at];
    }
  }
  return {};
}

// The texts of an expression; "..." for what is not written out between them.
std::string texts_of(const std::string& expression) {
  std::string out;
  bool is_gap = false;
  for (std::size_t at = 0; at < expression.size(); ++at) {
    if (expression[at] != '"') {
      is_gap = is_gap || std::isalnum(static_cast<unsigned char>(expression[at])) != 0;
      continue;
    }
    const std::size_t first = ++at;
    while (at < expression.size() && expression[at] != '"') at += expression[at] == '\\' ? 2U : 1U;
    if (is_gap && !out.empty()) out += "...";
    if (is_gap && out.empty()) out = "...";
    out += expression.substr(first, at - first);
    is_gap = false;
  }
  if (is_gap && !out.empty()) out += "...";
  return out;
}

bool has_text(const std::string& message) {
  return message.find_first_not_of(". ") != std::string::npos;
}

}  // namespace

std::vector<ErrorMessage> messages_of(const SourceFile& file) {
  std::vector<ErrorMessage> messages;
  if (!is_cpp(file) || !lies_in_product(file.path)) return messages;
  for (const std::string_view maker : kMakers) {
    for (std::size_t at = file.code.find(maker); at != std::string::npos;
         at = file.code.find(maker, at + 1)) {
      if (at > 0 && is_word(file.code[at - 1])) continue;
      const std::vector<std::string> arguments = arguments_at(file, at + maker.size());
      if (arguments.empty()) continue;
      std::string text = texts_of(arguments.size() > 1 ? arguments[1] : arguments[0]);
      if (has_text(text)) messages.push_back({line_at(file.text, at), std::move(text)});
    }
  }
  std::ranges::sort(messages, {}, &ErrorMessage::line);
  return messages;
}

std::vector<Finding> check_messages(const SourceFile& file) {
  std::vector<Finding> findings;
  for (const ErrorMessage& message : messages_of(file)) {
    const bool is_bare = std::ranges::any_of(
        kBare, [&](std::string_view begin) { return message.text.starts_with(begin); });
    const bool says_more = message.text.find(' ', message.text.find(' ') + 1) != std::string::npos;
    if (is_bare && (!says_more || message.text.starts_with("one of ") ||
                    message.text.starts_with("at ") || message.text.starts_with("from ")))
      findings.push_back({file.path, message.line,
                          "\"" + message.text + "\": say \"expected " + message.text + "\""});
  }
  return findings;
}

}  // namespace pitwall::tidy
