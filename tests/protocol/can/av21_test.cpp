// SPDX-License-Identifier: Apache-2.0
// The generated code of the car's bus against the run-time plans of the same file.
#include "protocol/can/av21.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "protocol/can/decode.hpp"
#include "tests/protocol/can/dbc_files.hpp"
#include "tests/protocol/can/oracle_payloads.hpp"

namespace pitwall::can {
namespace {

constexpr std::uint64_t kPayloads = 100'000;
// A long run takes so many for each payload that it asks of the slow canmatrix.
constexpr std::uint64_t kFaster = 100;

std::uint64_t payloads() { return std::max(kPayloads, kFaster * oracle_payloads(0)); }

// Calls fn with a value of every generated struct.
template <class Fn>
void for_every_message(Fn fn) {
  std::apply([&](auto... message) { (fn(message), ...); }, av21::AllMessages{});
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <class X>
void expect_equal_decoding(const Message& m, Random& noise) {
  std::vector<double> values(m.signals.size());
  for (std::uint64_t i = 0, count = payloads(); i < count; ++i) {
    const Frame f = random_frame(m, noise);
    X x;
    ASSERT_TRUE(av21::decode(f, x));
    ASSERT_TRUE(decode(m, f, values));
    for (std::size_t k = 0; k < values.size(); ++k) {
      ASSERT_TRUE(same_bits(x.*X::kFields[k], values[k])) << m.name << "." << m.signals[k].name;
    }
  }
}

template <class X>
void expect_equal_encoding(const Message& m, Random& noise) {
  std::vector<double> values(m.signals.size());
  for (std::uint64_t i = 0, count = payloads(); i < count; ++i) {
    X x;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const SignalPlan& p = m.signals[k].plan;
      const double span = std::abs(p.scale) * std::ldexp(1.0, p.length);
      const double unit = static_cast<double>(noise.below(1U << 20U)) / (1U << 20U);
      values[k] = x.*X::kFields[k] = p.offset + (3.0 * unit - 1.5) * span;
    }
    Frame a, b;
    EncodeCounters ca, cb;
    ASSERT_TRUE(av21::encode(x, a, ca));
    ASSERT_TRUE(encode(m, values, b, cb));
    ASSERT_EQ(a, b) << m.name;
    ASSERT_EQ(ca, cb) << m.name;
  }
}

TEST(Av21, GeneratedCodeEqualsTheRunTimePlans) {
  const Database d = load(kOwnDbc);
  std::size_t messages = 0;
  for_every_message([&](auto x) {
    using X = decltype(x);
    const Message* const m = d.find(X::kId);
    ASSERT_NE(m, nullptr);
    ASSERT_EQ(m->name, X::kName);
    ASSERT_EQ(m->length, X::kLength);
    ASSERT_EQ(m->signals.size(), X::kFields.size());
    Random noise{X::kId};
    expect_equal_decoding<X>(*m, noise);
    expect_equal_encoding<X>(*m, noise);
    ++messages;
  });
  EXPECT_EQ(messages, d.messages.size());
  EXPECT_EQ(av21::kFingerprint, fingerprint(d));
}

TEST(Av21, AForgottenFieldIsRefused) {
  for_every_message([](auto empty) {
    using X = decltype(empty);
    for (std::size_t forgotten = 0; forgotten < X::kFields.size(); ++forgotten) {
      X x;
      for (std::size_t k = 0; k < X::kFields.size(); ++k) {
        if (k != forgotten) x.*X::kFields[k] = 0.0;
      }
      Frame f{.id = 5, .length = 1, .data = {9}};
      const Frame before = f;
      EncodeCounters counters;
      EXPECT_FALSE(av21::encode(x, f, counters)) << X::kName;
      EXPECT_EQ(f, before);
      EXPECT_EQ(counters.not_finite, 1U);
    }
  });
}

TEST(Av21, OnlyTheExactFrameIsDecoded) {
  for_every_message([](auto x) {
    using X = decltype(x);
    Frame good{.id = X::kId, .length = X::kLength, .data = {}};
    EXPECT_TRUE(av21::decode(good, x));
    std::vector<Frame> bad(6, good);
    ++bad[0].id;
    bad[1].extended = true;
    bad[2].remote = true;
    bad[3].fd = true;
    ++bad[4].length;
    --bad[5].length;
    for (const Frame& f : bad) {
      X untouched;
      EXPECT_FALSE(av21::decode(f, untouched)) << X::kName;
      for (const auto field : X::kFields) EXPECT_TRUE(std::isnan(untouched.*field));
    }
  });
}

TEST(Av21, SteeringNeverFlipsItsSign) {
  for (int deg = -2000; deg <= 2000; ++deg) {
    av21::SteeringCmd command;
    command.steering_motor_ang_cmd = deg;
    command.steering_motor_cmd_counter = 1;
    Frame f;
    EncodeCounters counters;
    ASSERT_TRUE(av21::encode(command, f, counters));
    av21::SteeringCmd seen;
    ASSERT_TRUE(av21::decode(f, seen));
    EXPECT_EQ(seen.steering_motor_ang_cmd, std::clamp<double>(deg, -512.0, 511.5));
    EXPECT_EQ(counters.saturated, deg < -512 || deg > 511 ? 1U : 0U);
  }
}

TEST(Av21, TablesAgreeWithTheStructs) {
  std::size_t i = 0;
  for_every_message([&](auto x) {
    using X = decltype(x);
    EXPECT_EQ(av21::kMessages[i].id, X::kId);
    EXPECT_EQ(av21::kMessages[i].length, X::kLength);
    EXPECT_STREQ(av21::kMessages[i].name, X::kName);
    ++i;
  });
  EXPECT_EQ(i, av21::kMessages.size());
  for (std::size_t k = 1; k < i; ++k) EXPECT_LT(av21::kMessages[k - 1].id, av21::kMessages[k].id);
  const Database d = load(kOwnDbc);
  for (const SlewRow& s : av21::kSlews) {
    ASSERT_NE(d.find(s.id), nullptr);
    EXPECT_NE(d.find(s.id)->find(s.signal), nullptr) << s.signal;
    EXPECT_GT(s.max_per_s, 0.0);
  }
}

}  // namespace
}  // namespace pitwall::can
