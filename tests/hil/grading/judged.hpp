// Expectations of the signals x and y in the tests of their judges, and runs that they judge.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hil/grading/grader.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {

inline const std::vector<std::string> kNames{"x", "y"};

inline Expectation expect(Kind kind, Condition condition) {
  Expectation e;
  e.kind = kind;
  e.condition = std::move(condition);
  return e;
}

inline Grader grader_of(const Expectation& e) {
  auto grader = Grader::create({e}, kNames);
  EXPECT_TRUE(grader.has_value());
  return *std::move(grader);
}

// y > 0.5 asks for x > 0.5.
inline Expectation reaction(Duration limit) {
  Expectation e = expect(Kind::kAfter, {"x", Op::kGreater, 0.5});
  e.trigger = {"y", Op::kGreater, 0.5};
  e.limit = limit;
  return e;
}

// x is 1 after a fault at 5 s.
inline Expectation detection(Duration limit) {
  Expectation e = expect(Kind::kDetects, {"x", Op::kEqual, 1.0});
  e.from = at_s(5.0);
  e.to = at_s(5.0) + limit;
  e.limit = limit;
  return e;
}

using Signal = std::function<double(double)>;

// 100 Hz for `time_s` seconds.
inline Verdict judge(
    const Expectation& e, const Signal& x, double time_s = 10.0,
    const Signal& y = [](double) { return 0.0; }) {
  Grader grader = grader_of(e);
  for (int i = 0; i * 0.01 <= time_s + 1e-9; ++i) {
    const double values[] = {x(i * 0.01), y(i * 0.01)};
    grader.observe(Instant{} + milliseconds(10) * i, values);
  }
  return grader.finish().at(0);
}

}  // namespace pitwall::grading
