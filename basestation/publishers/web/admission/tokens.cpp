// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/tokens.hpp"

#include <sodium.h>

#include <algorithm>
#include <charconv>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr std::size_t kTokenMin = 16, kTokenMax = 128, kNameMax = 64, kTokensMax = 256;
constexpr std::size_t kIdBytes = 16, kCodeBytes = 32;  // of BLAKE2b; as text twice as long
constexpr std::string_view kBlanks = " \t\r";

using Key = std::array<std::uint8_t, 32>;
using Code = std::array<std::uint8_t, kCodeBytes>;

std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

bool is_token(std::string_view word) {
  return word.size() >= kTokenMin && word.size() <= kTokenMax &&
         std::ranges::all_of(word, [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                  c == '-' || c == '_';
         });
}

const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

template <std::size_t kSize>
std::string hex(const std::array<std::uint8_t, kSize>& bytes) {
  std::string text(2 * kSize + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes.data(), kSize);
  text.pop_back();
  return text;
}

template <std::size_t kSize>
std::array<std::uint8_t, kSize> hash(std::string_view text, std::string_view key) {
  std::array<std::uint8_t, kSize> out{};
  crypto_generichash(out.data(), kSize, bytes_of(text), text.size(), bytes_of(key), key.size());
  return out;
}

Key key_of(std::string_view token) { return hash<32>(token, "pitwall token key"); }

std::string id_of(const Key& key) {
  std::array<std::uint8_t, kIdBytes> id{};
  constexpr std::string_view kWhat = "identifier";
  crypto_generichash(id.data(), id.size(), bytes_of(kWhat), kWhat.size(), key.data(), key.size());
  return hex(id);
}

// Of "IDENTIFIER.END".
Code code_of(std::string_view what, const Key& key) {
  Code code{};
  crypto_generichash(code.data(), code.size(), bytes_of(what), what.size(), key.data(), key.size());
  return code;
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
    const Key key = key_of(token);
    tokens.rows_.push_back({.key = key,
                            .who = {.role = role == "operator" ? Role::kOperator : Role::kViewer,
                                    .name = std::string{who},
                                    .token_id = id_of(key)}});
  }
  return tokens;
}

const Tokens::Row* Tokens::row_of(std::string_view token) const {
  if (!is_token(token)) return nullptr;
  const Key key = key_of(token);
  const Row* found = nullptr;
  for (const Row& row : rows_) {
    if (sodium_memcmp(row.key.data(), key.data(), key.size()) == 0) found = &row;
  }
  return found;
}

std::optional<Identity> Tokens::find(std::string_view token) const {
  const Row* const row = row_of(token);
  return row == nullptr ? std::nullopt : std::optional{row->who};
}

std::string Tokens::session(std::string_view token, UtcTime end) const {
  const Row* const row = row_of(token);
  if (row == nullptr) return {};
  const std::string what = row->who.token_id + "." + std::to_string(end.ns / kNanosecondsPerSecond);
  return what + "." + hex(code_of(what, row->key));
}

std::optional<Identity> Tokens::find_session(std::string_view value, UtcTime now) const {
  const std::size_t first = value.find('.'), second = value.rfind('.');
  if (first == value.npos || second <= first) return std::nullopt;
  const std::string_view id = value.substr(0, first);
  const std::string_view end = value.substr(first + 1, second - first - 1);
  const std::string_view shown = value.substr(second + 1);
  const auto row = std::ranges::find_if(rows_, [&](const Row& r) { return r.who.token_id == id; });
  if (row == rows_.end()) return std::nullopt;
  const std::string code = hex(code_of(value.substr(0, second), row->key));
  if (shown.size() != code.size() || sodium_memcmp(shown.data(), code.data(), code.size()) != 0)
    return std::nullopt;
  std::int64_t end_s = 0;
  const auto read = std::from_chars(end.data(), end.data() + end.size(), end_s);
  if (read.ec != std::errc{} || read.ptr != end.data() + end.size()) return std::nullopt;
  if (now.ns / kNanosecondsPerSecond >= end_s) return std::nullopt;
  return row->who;
}

bool Tokens::knows(std::string_view token_id) const {
  return std::ranges::any_of(rows_, [&](const Row& row) { return row.who.token_id == token_id; });
}

}  // namespace pitwall::publishers::web
