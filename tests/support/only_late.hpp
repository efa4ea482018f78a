// Exit code of a test program in which only bounds on wall-clock time failed: try again later.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::testing {

inline constexpr int kOnlyLate = 75;  // EX_TEMPFAIL of sysexits.h

}  // namespace pitwall::testing
