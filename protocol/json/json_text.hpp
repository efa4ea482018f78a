// Writer of JSON text, piece by piece.
//   in     names and values; texts in UTF-8, in which U+FFFD replaces invalid bytes
//   out    one line of JSON. A number that is not finite becomes null
//   invariants
//          JsonValue reads the same values back
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
std::string number(double value);  // as many digits as needed
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
