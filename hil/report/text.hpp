// Text that is safe inside HTML and XML, and numbers as a report writes them.
//   in     any bytes: names and messages come from files that strangers wrote
//   out    escaped(): valid UTF-8 without markup. & < > " ' become entities; a line break or a tab
//          becomes a space; what XML 1.0 forbids, what is no UTF-8 and what turns the direction of
//          writing becomes U+FFFD
//   invariants
//          escaped() of text without such characters is that text
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::report {

std::string escaped(std::string_view text);

// Fixed decimals; "not known" for NaN, "unbounded" for infinity. Never "-0.0".
std::string number(double value, int decimals);
// The shortest of up to `digits` significant digits; likewise.
std::string significant(double value, int digits);

// printf; what is longer than 512 bytes is our own mistake.
template <class... Args>
std::string printed(const char* pattern, Args... args) {
  std::array<char, 512> text{};
  const int length = std::snprintf(text.data(), text.size(), pattern, args...);
  CHECK(length >= 0 && static_cast<std::size_t>(length) < text.size());
  return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace pitwall::report
