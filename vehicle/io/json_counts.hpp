// "name": value pairs of one JSON object, for the summaries that the car's process leaves behind.
//   in     names and texts without quotes, backslashes or control characters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pitwall::io {

class JsonCounts {
 public:
  void add(const std::string& name, std::uint64_t value) { put(name, std::to_string(value)); }
  void add_text(const std::string& name, const std::string& value) {
    put(name, "\"" + value + "\"");
  }
  // An object or a list, written already.
  void add_json(const std::string& name, const std::string& value) { put(name, value); }

  std::string object() const { return "{" + text_ + "}"; }
  const std::string& pairs() const { return text_; }

 private:
  void put(const std::string& name, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + ("\"" + name + "\": ") + value;
  }

  std::string text_;
};

}  // namespace pitwall::io
