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

// A check may return the message alone, for its caller to add the place.
constexpr std::string_view kReturnedText = "return \"";

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

// Of what a function returns, that which reads as a sentence: no markup, no single word.
bool is_sentence(const std::string& text) {
  return !text.empty() && std::islower(static_cast<unsigned char>(text.front())) != 0 &&
         text.find(' ') != std::string::npos;
}

template <class Use>
void for_each_place(const std::string& code, std::string_view word, const Use& use) {
  for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1))
    if (at == 0 || !is_word(code[at - 1])) use(at);
}

}  // namespace

std::vector<ErrorMessage> messages_of(const SourceFile& file) {
  std::vector<ErrorMessage> messages;
  if (!is_cpp(file) || !lies_in_product(file.path)) return messages;
  for (const std::string_view maker : kMakers) {
    for_each_place(file.code, maker, [&](std::size_t at) {
      const std::vector<std::string> arguments = arguments_at(file, at + maker.size());
      if (arguments.empty()) return;
      std::string text = texts_of(arguments.back());
      if (has_text(text)) messages.push_back({line_at(file.text, at), std::move(text)});
    });
  }
  for_each_place(file.code, kReturnedText, [&](std::size_t at) {
    const std::size_t begin = at + kReturnedText.size() - 1;
    std::string text = texts_of(file.text.substr(begin, file.code.find(';', begin) - begin));
    if (is_sentence(text)) messages.push_back({line_at(file.text, at), std::move(text), true});
  });
  std::ranges::sort(messages, {}, &ErrorMessage::line);
  return messages;
}

std::vector<Finding> check_messages(const SourceFile& file) {
  std::vector<Finding> findings;
  for (const ErrorMessage& message : messages_of(file)) {
    const bool is_bare =
        !message.is_returned && std::ranges::any_of(kBare, [&](std::string_view begin) {
          return message.text.starts_with(begin);
        });
    const bool says_more = message.text.find(' ', message.text.find(' ') + 1) != std::string::npos;
    if (is_bare && (!says_more || message.text.starts_with("one of ") ||
                    message.text.starts_with("at ") || message.text.starts_with("from ")))
      findings.push_back({file.path, message.line,
                          "\"" + message.text + "\": say \"expected " + message.text + "\""});
  }
  return findings;
}

}  // namespace pitwall::tidy
