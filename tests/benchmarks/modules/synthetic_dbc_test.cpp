// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/synthetic_dbc.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/can/dbc_parser.hpp"

namespace pitwall::benchmarks {
namespace {

TEST(SyntheticDbc, IsReadableAsLargeAsAskedAndAlwaysTheSame) {
  const std::string text = synthetic_dbc(800'000);
  EXPECT_GE(text.size(), 800'000U);
  EXPECT_LT(text.size(), 810'000U);
  EXPECT_EQ(text, synthetic_dbc(800'000));
  const auto d = can::parse_dbc(text, "synthetic.dbc");
  ASSERT_TRUE(d) << to_string(d.error());
  for (const can::Finding& f : d->findings) {
    EXPECT_EQ(can::severity_of(f.kind), can::FindingSeverity::kNote) << f.place << " " << f.what;
  }
}

TEST(SyntheticDbc, HasTheVarietyOfARealFile) {
  const auto d = can::parse_dbc(synthetic_dbc(800'000), "synthetic.dbc");
  ASSERT_TRUE(d);
  const auto messages = [&](auto is) {
    return std::count_if(d->messages.begin(), d->messages.end(), is);
  };
  const auto some_signal = [&](auto is) {
    return messages(
        [&](const can::Message& m) { return std::any_of(m.signals.begin(), m.signals.end(), is); });
  };
  EXPECT_GT(messages([](const can::Message& m) { return m.extended; }), 100);
  EXPECT_GT(messages([](const can::Message& m) { return !m.extended; }), 100);
  EXPECT_GT(messages([](const can::Message& m) { return m.deepest > 0; }), 50);
  EXPECT_GT(messages([](const can::Message& m) { return m.period > Duration{}; }), 500);
  using can::Signal;
  EXPECT_GT(some_signal([](const Signal& s) { return s.layout.number == can::Number::kFloat32; }),
            50);
  EXPECT_GT(
      some_signal([](const Signal& s) { return s.layout.order == can::ByteOrder::kMotorola; }), 50);
  EXPECT_GT(some_signal([](const Signal& s) { return !s.values.empty() && !s.comment.empty(); }),
            50);
  EXPECT_GT(some_signal([](const Signal& s) { return !s.attributes.empty(); }), 50);
}

}  // namespace
}  // namespace pitwall::benchmarks
