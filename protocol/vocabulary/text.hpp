// Text of numbers, the same in every message, table and file.
//   errors a pattern and arguments that do not fit do not compile
//   cost   allocates: nothing of the 100 Hz path calls it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pitwall {

// As printf, of any length.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* pattern, ...);

// The fewest digits that read back as the same number; "nan", "inf".
std::string shortest(double value);

// "0x1f"
std::string hex(std::uint64_t value);

// Without blanks, tabs and line ends at either end.
std::string_view trimmed(std::string_view text);

}  // namespace pitwall
