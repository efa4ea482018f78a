// SPDX-License-Identifier: Apache-2.0
#include "hil/report/series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

Line noise(std::size_t points, unsigned seed) {
  std::mt19937 random(seed);
  Line line;
  for (std::size_t i = 0; i < points; ++i)
    line.push_back({0.01 * static_cast<double>(i), static_cast<double>(random() % 10'000)});
  return line;
}

TEST(Thinned, KeepsEveryPeakOfEveryBucketAndTheOrder) {
  constexpr std::size_t kBuckets = 50;
  const Line line = noise(20'000, 1);
  const Line thin = thinned(line, 0.0, 200.0, kBuckets);
  EXPECT_LE(thin.size(), 4 * kBuckets);
  EXPECT_TRUE(std::ranges::is_sorted(thin, {}, &Point::x));
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    const auto inside = [bucket](const Point& p) {
      return std::floor(p.x * 0.25) == static_cast<double>(bucket);
    };
    const auto extremes = [&](const Line& of) {
      double least = 1e9, greatest = -1e9;
      for (const Point& p : of)
        if (inside(p)) least = std::min(least, p.y), greatest = std::max(greatest, p.y);
      return std::pair{least, greatest};
    };
    EXPECT_EQ(extremes(thin), extremes(line)) << bucket;
  }
}

TEST(Thinned, KeepsAGap) {
  Line line = noise(1000, 2);
  for (std::size_t i = 400; i < 600; ++i) line[i].y = kUnset;
  const Line thin = thinned(line, 0.0, 10.0, 10);
  EXPECT_EQ(std::ranges::count_if(thin, [](const Point& p) { return std::isnan(p.y); }), 1);
  for (const Point& p : thin) EXPECT_TRUE(std::isnan(p.y) || p.x < 4.0 || p.x >= 6.0) << p.x;
}

TEST(Thinned, FewPointsStayAsTheyAre) {
  const Line line{{0.0, 1.0}, {1.0, 2.0}, {2.0, 3.0}};
  EXPECT_EQ(thinned(line, 0.0, 2.0, 100).size(), 3u);
  EXPECT_TRUE(thinned({}, 0.0, 2.0, 100).empty());
}

TEST(LineOf, ASilenceIsAGap) {
  std::vector<At<int>> rows{{0.0, 1}, {0.01, 2}, {0.5, 3}};
  const Line line = line_of(rows, [](int v) { return v; });
  ASSERT_EQ(line.size(), 4u);
  EXPECT_TRUE(std::isnan(line[2].y));
}

TEST(BusLoad, AllBitsAreInIt) {
  std::vector<At<BusFrame>> frames;
  double bits = 0.0;
  for (int i = 0; i < 5000; ++i) {
    frames.push_back({0.002 * i, {1, 100, static_cast<std::uint16_t>(100 + i % 30)}});
    bits += 100 + i % 30;
  }
  for (const double end_s : {10.0, 10.1, 600.0}) {
    const Line load = bus_load(frames, end_s, 0.25);
    EXPECT_LE(load.size(), 1200u);
    double sum = 0.0, begin_s = 0.0;
    for (const Point& p : load) {
      const double width_s = 2.0 * (p.x - begin_s);
      sum += p.y * kBitRate * width_s;
      begin_s += width_s;
    }
    EXPECT_NEAR(sum, bits, 1e-6 * bits);
    EXPECT_NEAR(begin_s, end_s, 1e-9);
  }
  EXPECT_TRUE(bus_load({}, 10.0, 0.25).empty());
}

TEST(Intervals, AreThoseOfOneSenderAndOneId) {
  std::vector<At<BusFrame>> frames;
  for (int i = 0; i < 100; ++i) {
    frames.push_back({0.005 * i, {1, 1300, 100}});
    if (i % 10 == 0) frames.push_back({0.005 * i + 0.001, {0, 0x7FFF, 100}});
  }
  const auto all = intervals_of(frames);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].id, 0x7FFFu);
  EXPECT_TRUE(all[0].name.empty()) << "not in the database";
  EXPECT_NEAR(all[0].quantile_s(0.5), 0.05, 1e-12);
  EXPECT_EQ(all[1].name, "wheel_speed_report");
  EXPECT_EQ(all[1].nominal_s, 0.005);
  EXPECT_EQ(all[1].frames, 100u);
  EXPECT_EQ(all[1].sorted_s.size(), 99u);
}

TEST(Histogram, LosesNothing) {
  const std::vector<double> values{-5.0, 0.0, 0.1, 0.99, 1.0, 7.0};
  const auto counts = histogram(values, 0.0, 1.0, 10);
  EXPECT_EQ(counts.front(), 2u);
  EXPECT_EQ(counts[1], 1u);
  EXPECT_EQ(counts.back(), 3u);
}

TEST(SpansOf, MeetWithoutAGap) {
  const RunData run = run_of({});
  const auto spans = spans_of(run.truth, [](const auto& v) { return v.x_m > 0.0 ? 1 : 0; });
  ASSERT_GT(spans.size(), 1u);
  EXPECT_EQ(spans.front().from_s, 0.0);
  EXPECT_EQ(spans.back().to_s, 10.0);
  for (std::size_t i = 1; i < spans.size(); ++i) {
    EXPECT_EQ(spans[i].from_s, spans[i - 1].to_s);
    EXPECT_NE(spans[i].value, spans[i - 1].value);
  }
}

}  // namespace
}  // namespace pitwall::report
