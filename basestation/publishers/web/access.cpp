// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/access.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace pitwall::publishers::web {
namespace {

constexpr std::size_t kTokenMin = 16, kTokenMax = 128, kNameMax = 64, kTokensMax = 256;
constexpr std::string_view kBlanks = " \t\r";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

bool is_token(std::string_view word) {
  return word.size() >= kTokenMin && word.size() <= kTokenMax &&
         std::ranges::all_of(
             word, [](char c) { return is_digit(c) || is_letter(c) || c == '-' || c == '_'; });
}

bool same_secret(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    difference |= static_cast<unsigned>(a[i] ^ other);
  }
  return difference == 0;
}

std::string lower(std::string_view text) {
  std::string out{text};
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// "name:80" or "[::1]:80" without the port.
std::string name_of(std::string_view host) {
  const std::size_t end = host.starts_with('[') ? host.find(']') : host.find(':');
  const bool bracket = host.starts_with('[') && end != std::string_view::npos;
  return lower(host.substr(0, bracket ? end + 1 : end));
}

bool is_address(std::string_view name) {
  if (name.starts_with('[')) return name.ends_with(']');
  return !name.empty() && std::ranges::all_of(name, [](char c) { return is_digit(c) || c == '.'; });
}

bool own_host(const AccessRules& rules, std::string_view host) {
  const std::string name = name_of(host);
  return is_address(name) || name == "localhost" ||
         std::ranges::any_of(rules.names, [&](const auto& own) { return lower(own) == name; });
}

// A page that was loaded from this machine: from a file, or from a server that listens here.
bool is_local_page(std::string_view origin) {
  if (origin == "file://") return true;
  constexpr std::array<std::string_view, 2> kSchemes{"http://", "https://"};
  for (const std::string_view scheme : kSchemes) {
    if (!origin.starts_with(scheme)) continue;
    const std::string name = name_of(origin.substr(scheme.size()));
    return name == "localhost" || name == "[::1]" || (is_address(name) && name.starts_with("127."));
  }
  return false;
}

bool admits_origin(const AccessRules& rules, const Visitor& visitor) {
  const std::string origin = lower(visitor.origin);
  return origin.empty() || origin == "http://" + lower(visitor.host) ||
         (rules.local_pages && is_local_page(origin)) ||
         std::ranges::any_of(rules.origins, [&](const auto& own) { return lower(own) == origin; });
}

}  // namespace

Result<Tokens, Problem> Tokens::parse(std::string_view text, const std::string& name) {
  Tokens tokens;
  for (int line = 1; !text.empty(); ++line) {
    std::string_view rest = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), rest.size() + 1));
    const auto wrong = [&](const char* what) {
      return Unexpected{Problem{name + ":" + std::to_string(line), what}};
    };
    rest = trimmed(rest);
    if (rest.empty() || rest.starts_with('#')) continue;
    const std::string_view role = take_word(rest), token = take_word(rest);
    const std::string_view who = trimmed(rest);
    if (role != "viewer" && role != "operator") return wrong("a role: viewer or operator");
    if (!is_token(token)) return wrong("a token of 16 to 128 letters, digits, - or _");
    if (who.empty() || who.size() > kNameMax) return wrong("a name of at most 64 bytes");
    if (tokens.find(token)) return wrong("this token was given before");
    if (tokens.rows_.size() >= kTokensMax) return wrong("more than 256 tokens");
    tokens.rows_.push_back(
        {std::string{token},
         {.role = role == "operator" ? Role::kOperator : Role::kViewer, .name = std::string{who}}});
  }
  return tokens;
}

std::optional<Identity> Tokens::find(std::string_view token) const {
  std::optional<Identity> found;
  for (const Row& row : rows_) {
    if (same_secret(row.token, token)) found = row.who;
  }
  return found;
}

std::string_view text_of(Refused refused) {
  switch (refused) {
    case Refused::kHost:
      return "this base is not called so: use its address, or start it with --web-name";
    case Refused::kOrigin:
      return "a page of another origin may not speak to this base";
    case Refused::kToken:
      return "this base takes a token, and this is none of its own";
  }
  return "?";
}

Result<Identity, Refused> admit(const AccessRules& rules, const Visitor& visitor) {
  if (!own_host(rules, visitor.host)) return Unexpected{Refused::kHost};
  if (!admits_origin(rules, visitor)) return Unexpected{Refused::kOrigin};
  if (visitor.token.empty() && rules.default_role)
    return Identity{.role = *rules.default_role, .name = {}};
  auto who = rules.tokens.find(visitor.token);
  if (!who) return Unexpected{Refused::kToken};
  return *std::move(who);
}

}  // namespace pitwall::publishers::web
