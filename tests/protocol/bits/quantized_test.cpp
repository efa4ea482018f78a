// SPDX-License-Identifier: Apache-2.0
#include "protocol/bits/quantized.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace pitwall::bits {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

static_assert(Quantized{0.0, 100.0, 0.5}.bits() == 8);  // 201 steps and "no value"
static_assert(Quantized{0.0, 254.0, 1.0}.bits() == 8);  // 255 steps and "no value"
static_assert(Quantized{0.0, 255.0, 1.0}.bits() == 9);
static_assert(Quantized{0.0, 1.0, 1.0}.bits() == 2);

const std::array<Quantized, 6> kKinds{{{0.0, 100.0, 0.5},
                                       {-512.0, 511.5, 0.5},
                                       {-3.2, 3.2, 0.001},
                                       {0.0, 1e5, 1e-4},
                                       {-100.0, 6453.5, 0.1},
                                       {1.0, 2.0, 0.3}}};

TEST(Quantized, EveryStepComesBack) {
  for (const Quantized& q : kKinds) {
    const std::uint64_t stride = q.count() / 5000 + 1;
    for (std::uint64_t step = 0; step < q.count(); step += stride) {
      EXPECT_EQ(q.encode(q.decode(step)).step, step);
      EXPECT_FALSE(q.encode(q.decode(step)).saturated);
    }
  }
}

TEST(Quantized, ErrorIsAtMostHalfAStepAndOrderIsKept) {
  for (const Quantized& q : kKinds) {
    const double top = q.decode(q.count() - 1);
    std::uint64_t before = 0;
    for (int i = 0; i <= 10'000; ++i) {
      const double v = q.min() + (top - q.min()) * i / 10'000.0;
      const Encoded e = q.encode(v);
      EXPECT_LE(std::abs(q.decode(e.step) - v), q.resolution() * (0.5 + 1e-6)) << v;
      EXPECT_GE(e.step, before);
      before = e.step;
    }
  }
}

TEST(Quantized, OutsideIsHeldAndSaidSo) {
  for (const Quantized& q : kKinds) {
    for (const double v : {kInfinity, 1e300, q.max() + 1.0}) {
      EXPECT_EQ(q.encode(v).step, q.count() - 1);
      EXPECT_TRUE(q.encode(v).saturated);
    }
    for (const double v : {-kInfinity, -1e300, q.min() - 1.0}) {
      EXPECT_EQ(q.encode(v).step, 0U);
      EXPECT_TRUE(q.encode(v).saturated);
    }
  }
}

TEST(Quantized, NoValueStaysNoValue) {
  for (const Quantized& q : kKinds) {
    EXPECT_EQ(q.encode(kUnset).step, q.no_value());
    EXPECT_LT(q.no_value() >> (q.bits() - 1), 2U);
    for (std::uint64_t step = q.count(); step <= q.no_value() && step < q.count() + 100; ++step) {
      EXPECT_TRUE(std::isnan(q.decode(step)));
    }
    EXPECT_TRUE(std::isnan(q.decode(q.no_value())));
  }
}

}  // namespace
}  // namespace pitwall::bits
