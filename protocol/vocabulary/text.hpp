// Formatting of numbers and text, the same in every message, table and file.
//   errors arguments that do not match the pattern do not compile
//   cost   allocates; not for the 100 Hz path
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pitwall {

// Like printf, of any length.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* pattern, ...);

// The shortest decimal form that reads back as the same number; "nan", "inf".
std::string shortest(double value);

// "0x1f"
std::string hex(std::uint64_t value);

// The text without blanks, tabs and line ends at its start and end.
std::string_view trimmed(std::string_view text);

}  // namespace pitwall
