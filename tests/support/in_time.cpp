// SPDX-License-Identifier: Apache-2.0
#include "tests/support/in_time.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tests/support/only_late.hpp"

namespace pitwall::testing {
namespace {

constexpr const char* kMark = "late by the wall clock";

struct Failures {
  int of_time = 0, others = 0;
};

Failures& failures() {
  static Failures all;
  return all;
}

// The program's own exit code stands where anything else failed.
void end_as_late() {
  if (failures().others > 0 || failures().of_time == 0) return;
  std::fflush(nullptr);
  std::_Exit(kOnlyLate);
}

class Listener : public ::testing::EmptyTestEventListener {
  void OnTestPartResult(const ::testing::TestPartResult& part) override {
    if (!part.failed()) return;
    const bool is_late = std::string_view(part.message()).find(kMark) != std::string_view::npos;
    ++(is_late ? failures().of_time : failures().others);
  }
};

const bool kListens = [] {
  ::testing::UnitTest::GetInstance()->listeners().Append(new Listener);  // owned there
  return std::atexit(end_as_late) == 0;
}();

}  // namespace

::testing::AssertionResult in_time(bool holds) {
  if (holds && kListens) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << kMark;
}

::testing::AssertionResult in_time(Duration took, Duration limit) {
  return in_time(took <= limit) << ": " << took.seconds() * 1e3 << " ms of "
                                << limit.seconds() * 1e3;
}

}  // namespace pitwall::testing
