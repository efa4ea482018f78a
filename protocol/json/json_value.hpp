// Reader of small JSON documents: the result of a run, the text of an event, a console message.
//   in     one JSON document; its name, for messages
//   out    a value. A lookup by key returns the member, or a neutral value if there is none: empty
//          text, NaN, false, no items. So a reader accepts documents of a newer writer
//   errors Problem with the byte of the syntax error; nesting deeper than 32 levels is refused
//   cost   O(bytes)
//   source RFC 8259
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::json {

class JsonValue {
 public:
  using Items = std::vector<JsonValue>;
  using Members = std::vector<std::pair<std::string, JsonValue>>;  // in the order of the text

  static Result<JsonValue, Problem> parse(std::string_view text, const std::string& name);

  // Member of an object, the first one of that name; null if missing or for other values.
  const JsonValue* find(std::string_view key) const;
  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  bool is_object() const { return std::holds_alternative<Members>(value_); }
  bool is_list() const { return std::holds_alternative<Items>(value_); }

  std::string text(std::string_view key) const;
  double number(std::string_view key) const;  // NaN if missing or null
  bool flag(std::string_view key) const;
  const Items& items(std::string_view key) const;

  // Content of the value itself.
  const Items& items() const;
  double number() const;
  std::string text() const;

 private:
  friend class JsonParser;
  std::variant<std::monostate, bool, double, std::string, Items, Members> value_;
};

}  // namespace pitwall::json
