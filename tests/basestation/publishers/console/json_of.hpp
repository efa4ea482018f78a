// Parser of a JSON text of the console service; a parse error fails the test.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "protocol/json/json_value.hpp"

namespace pitwall::publishers::console {

inline json::JsonValue json_of(const std::string& text) {
  const auto value = json::JsonValue::parse(text, "text");
  EXPECT_TRUE(value) << text;
  return value ? *value : json::JsonValue{};
}

}  // namespace pitwall::publishers::console
