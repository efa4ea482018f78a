// Escaping of text for HTML and XML, and formatting of numbers in a report.
//   in     any bytes: names and messages come from untrusted files
//   out    escaped(): valid UTF-8 without markup. & < > " ' become entities; a line break or a tab
//          becomes a space; characters that XML 1.0 forbids, invalid UTF-8 and characters that
//          change the direction of writing become U+FFFD
//   invariants
//          escaped() does not change text without such characters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pitwall::report {

std::string escaped(std::string_view text);

// Fixed decimals; "not known" for NaN, "unbounded" for infinity. Never "-0.0".
std::string number(double value, int decimals);
// The shortest form with up to `digits` significant digits; NaN and infinity as in number().
std::string significant(double value, int digits);

}  // namespace pitwall::report
