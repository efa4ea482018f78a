// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/range_reader.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pitwall::parameters {
namespace {

struct Params {
  double share = 0.0, speed_mps = 0.0;
  Duration wait{};
};
constexpr auto kNumbers = std::to_array<world::NamedRange<Params>>({
    {"share", &Params::share, 0.0, 1.0},
    {"speed_mps", &Params::speed_mps, -5.0, 5.0},
});
constexpr auto kTimes = std::to_array<world::NamedTime<Params>>({
    {"wait_s", &Params::wait, 0.5, 2.0},
});

// The error, or "" where the text can be read.
std::string read(const std::string& text, Params& params) {
  const auto document = yaml::load_text(text, "p.yaml");
  if (!document) return to_string(document.error());
  const auto done = yaml::read(*document, [&](yaml::StrictMap& map) {
    read_ranges(map, kNumbers, params);
    read_ranges(map, kTimes, params);
    return true;
  });
  return done ? "" : to_string(done.error());
}

TEST(RangeReader, EachRowIsReadToItsMemberUpToTheEndsOfItsRange) {
  Params params;
  EXPECT_EQ(read("share: 1\nspeed_mps: -5.0\nwait_s: 0.5\n", params), "");
  EXPECT_EQ(params.share, 1.0);
  EXPECT_EQ(params.speed_mps, -5.0);
  EXPECT_EQ(params.wait, milliseconds(500));
}

TEST(RangeReader, WhatIsMissingOrOutsideIsNamedWithItsLine) {
  Params params;
  EXPECT_NE(read("share: 0.5\nspeed_mps: 5.1\nwait_s: 1\n", params).find("p.yaml:2:"),
            std::string::npos);
  EXPECT_NE(read("share: 0.5\nspeed_mps: 5\nwait_s: 2.1\n", params).find("wait_s"),
            std::string::npos);
  EXPECT_NE(read("share: 0.5\nwait_s: 2\n", params).find("speed_mps"), std::string::npos);
}

TEST(RangeReader, WhatMayBeLeftOutStaysAsItIs) {
  Params params{.share = 0.25, .speed_mps = 1.0};
  const auto given = [&](const std::string& text) {
    const auto document = yaml::load_text(text, "p.yaml");
    const auto done = yaml::read(*document, [&](yaml::StrictMap& map) {
      read_given_ranges(map, kNumbers, params);
      return true;
    });
    return done ? "" : to_string(done.error());
  };
  EXPECT_EQ(given("speed_mps: 3\n"), "");
  EXPECT_EQ(params.share, 0.25);
  EXPECT_EQ(params.speed_mps, 3.0);
  EXPECT_NE(given("share: 1.5\n").find("p.yaml:1:"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::parameters
