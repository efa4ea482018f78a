// JSON as text, written piece by piece: for what programs tell each other.
//   in     names and values; texts in UTF-8, whatever is none of it becomes U+FFFD
//   out    one line of JSON. A number that is no number is null
//   invariants
//          what is written here is read by JsonValue as the same value
//   cost   O(bytes)
//   source RFC 8259; well-formed UTF-8: Unicode 15, table 3-7
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace pitwall::json {

std::string quoted(std::string_view text);
std::string number(double value);  // as many digits as it takes
std::string integer(std::int64_t value);

// {"a": 1, "b": "x"}
class Object {
 public:
  Object& json(std::string_view name, std::string_view value);  // already JSON
  Object& text(std::string_view name, std::string_view value) { return json(name, quoted(value)); }
  Object& flag(std::string_view name, bool value) { return json(name, value ? "true" : "false"); }
  template <class Number>
  requires std::floating_point<Number> || std::integral<Number> Object& number(
      std::string_view name, Number value) {
    if constexpr (std::floating_point<Number>) return json(name, json::number(value));
    return json(name, integer(static_cast<std::int64_t>(value)));
  }
  std::string str() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

// [1, "x"]
class Array {
 public:
  Array& json(std::string_view value);  // already JSON
  Array& text(std::string_view value) { return json(quoted(value)); }
  template <class Number>
  requires std::floating_point<Number> || std::integral<Number> Array& number(Number value) {
    if constexpr (std::floating_point<Number>) return json(json::number(value));
    return json(integer(static_cast<std::int64_t>(value)));
  }
  std::string str() const { return "[" + text_ + "]"; }

 private:
  std::string text_;
};

}  // namespace pitwall::json
