// SPDX-License-Identifier: Apache-2.0
#include "protocol/json/json_value.hpp"

#include <charconv>
#include <cstdint>
#include <optional>

namespace pitwall::json {

constexpr int kDepthMax = 32;

// Every read_ function leaves `at_` behind what it read; false: at_ is where it is no JSON.
class JsonParser {
 public:
  explicit JsonParser(std::string_view text) : text_(text) {}

  bool read_document(JsonValue& value) {
    if (!read_value(value, 0)) return false;
    skip_space();
    return at_ == text_.size();
  }
  std::size_t at() const { return at_; }

 private:
  void skip_space() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != text_.npos) ++at_;
  }
  bool take(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  bool next_is(char c) {
    skip_space();
    return take({&c, 1});
  }

  bool read_value(JsonValue& value, int depth) {
    skip_space();
    if (depth > kDepthMax || at_ >= text_.size()) return false;
    switch (text_[at_]) {
      case '{':
        return read_members(value.value_.emplace<JsonValue::Members>(), depth);
      case '[':
        return read_items(value.value_.emplace<JsonValue::Items>(), depth);
      case '"':
        return read_string(value.value_.emplace<std::string>());
      case 't':
        value.value_ = true;
        return take("true");
      case 'f':
        value.value_ = false;
        return take("false");
      case 'n':
        return take("null");
      default:
        return read_number(value.value_.emplace<double>());
    }
  }

  bool read_members(JsonValue::Members& members, int depth) {
    ++at_;
    if (next_is('}')) return true;
    do {
      skip_space();
      auto& [key, value] = members.emplace_back();
      if (!read_string(key) || !next_is(':') || !read_value(value, depth + 1)) return false;
    } while (next_is(','));
    return next_is('}');
  }

  bool read_items(JsonValue::Items& items, int depth) {
    ++at_;
    if (next_is(']')) return true;
    do {
      if (!read_value(items.emplace_back(), depth + 1)) return false;
    } while (next_is(','));
    return next_is(']');
  }

  bool read_number(double& number) {
    // from_chars also takes "inf" and "nan", which are no JSON.
    const char lead = text_[at_];
    if (lead != '-' && (lead < '0' || lead > '9')) return false;
    if (lead == '-' && (at_ + 1 >= text_.size() || text_[at_ + 1] > '9')) return false;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (error != std::errc{}) return false;
    at_ = static_cast<std::size_t>(end - text_.data());
    return true;
  }

  bool read_string(std::string& out) {
    if (!take("\"")) return false;
    while (at_ < text_.size() && text_[at_] != '"') {
      const char c = text_[at_];
      if (static_cast<unsigned char>(c) < 0x20) return false;
      if (c == '\\') {
        if (!read_escape(out)) return false;
      } else {
        out += c;
        ++at_;
      }
    }
    return take("\"");
  }

  bool read_escape(std::string& out) {
    constexpr std::string_view kLetters = "\"\\/bfnrt", kMeaning = "\"\\/\b\f\n\r\t";
    if (at_ + 1 >= text_.size()) return false;
    if (text_[at_ + 1] == 'u') return read_code(out);
    const std::size_t which = kLetters.find(text_[at_ + 1]);
    if (which == std::string_view::npos) return false;
    out += kMeaning[which];
    at_ += 2;
    return true;
  }

  std::optional<std::uint32_t> read_unit() {
    constexpr std::size_t kBytes = 6;  // \uXXXX
    if (!text_.substr(at_).starts_with("\\u") || text_.size() - at_ < kBytes) return std::nullopt;
    std::uint32_t unit = 0;
    const char* begin = text_.data() + at_ + 2;
    const auto [end, error] = std::from_chars(begin, begin + 4, unit, 16);
    if (error != std::errc{} || end != begin + 4) return std::nullopt;
    at_ += kBytes;
    return unit;
  }

  bool read_code(std::string& out) {
    const auto high = read_unit();
    if (!high) return false;
    std::uint32_t code = *high;
    if (code >= 0xD800 && code <= 0xDBFF) {
      const auto low = read_unit();
      if (!low || *low < 0xDC00 || *low > 0xDFFF) return false;
      code = 0x10000 + ((code - 0xD800) << 10U) + (*low - 0xDC00);
    }
    append(out, code);
    return true;
  }

  static void append(std::string& out, std::uint32_t code) {
    const auto put = [&out](std::uint32_t byte) { out += static_cast<char>(byte); };
    if (code < 0x80) return put(code);
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr std::uint32_t kLeads[]{0, 0xC0, 0xE0, 0xF0};
    put(kLeads[more] | (code >> (6 * more)));
    for (int i = more - 1; i >= 0; --i) put(0x80 | ((code >> (6 * i)) & 0x3F));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

Result<JsonValue, Problem> JsonValue::parse(std::string_view text, const std::string& name) {
  JsonValue value;
  JsonParser parser{text};
  if (parser.read_document(value)) return value;
  return Unexpected{Problem{name + ":byte " + std::to_string(parser.at()), "is not JSON"}};
}

const JsonValue* JsonValue::find(std::string_view key) const {
  const auto* members = std::get_if<Members>(&value_);
  if (members == nullptr) return nullptr;
  for (const auto& [name, value] : *members)
    if (name == key) return &value;
  return nullptr;
}

std::string JsonValue::text(std::string_view key) const {
  const JsonValue* found = find(key);
  return found != nullptr ? found->text() : std::string{};
}

double JsonValue::number(std::string_view key) const {
  const JsonValue* found = find(key);
  return found != nullptr ? found->number() : kUnset;
}

bool JsonValue::flag(std::string_view key) const {
  const JsonValue* found = find(key);
  const auto* flag = found != nullptr ? std::get_if<bool>(&found->value_) : nullptr;
  return flag != nullptr && *flag;
}

const JsonValue::Items& JsonValue::items(std::string_view key) const {
  static const JsonValue kNone;
  const JsonValue* found = find(key);
  return found != nullptr ? found->items() : kNone.items();
}

const JsonValue::Items& JsonValue::items() const {
  static const Items kNone;
  const auto* items = std::get_if<Items>(&value_);
  return items != nullptr ? *items : kNone;
}

std::string JsonValue::text() const {
  const auto* text = std::get_if<std::string>(&value_);
  return text != nullptr ? *text : std::string{};
}

double JsonValue::number() const {
  const auto* number = std::get_if<double>(&value_);
  return number != nullptr ? *number : kUnset;
}

}  // namespace pitwall::json
