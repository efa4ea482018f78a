// Text that is safe inside HTML and XML, and numbers as a report writes them.
//   in     any bytes: names and messages come from files that strangers wrote
//   out    escaped(): valid UTF-8 without markup. & < > " ' become entities; a line break or a tab
//          becomes a space; what XML 1.0 forbids, what is no UTF-8 and what turns the direction of
//          writing becomes U+FFFD
//   invariants
//          escaped() of text without such characters is that text
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pitwall::report {

std::string escaped(std::string_view text);

// Fixed decimals; "not known" for NaN, "unbounded" for infinity. Never "-0.0".
std::string number(double value, int decimals);
// The shortest of up to `digits` significant digits; likewise.
std::string significant(double value, int digits);

}  // namespace pitwall::report
