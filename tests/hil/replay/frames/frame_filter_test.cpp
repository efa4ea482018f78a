// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/frame_filter.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

std::vector<std::uint32_t> taken_of(FrameFilter& filter, const std::vector<std::uint32_t>& ids) {
  std::vector<std::uint32_t> taken;
  for (const std::uint32_t id : ids) {
    can::Frame frame;
    frame.id = id;
    if (filter.takes(frame)) taken.push_back(id);
  }
  return taken;
}

TEST(FrameFilter, TakesWhatIsWantedAndCountsTheRest) {
  const std::vector<std::uint32_t> ids{1, 2, 3, 1, 2, 0x1FFF'FFFF};
  FrameFilter all{{}};
  EXPECT_EQ(taken_of(all, ids), ids);
  EXPECT_EQ(all.left_out(), 0U);
  FrameFilter only{{.ids = {1, 3}}};
  EXPECT_EQ(taken_of(only, ids), (std::vector<std::uint32_t>{1, 3, 1}));
  EXPECT_EQ(only.left_out(), 3U);
  FrameFilter without{{.not_ids = {2}}};
  EXPECT_EQ(taken_of(without, ids), (std::vector<std::uint32_t>{1, 3, 1, 0x1FFF'FFFF}));
  EXPECT_EQ(without.left_out(), 2U);
  FrameFilter both{{.ids = {1, 2}, .not_ids = {2}}};
  EXPECT_EQ(taken_of(both, ids), (std::vector<std::uint32_t>{1, 1}));
  EXPECT_FALSE(both.problem());
}

TEST(FrameFilter, AnIdentifierThatNoFrameHasIsNamedWithThoseThatThereAre) {
  FrameFilter wrong{{.ids = {1, 0x7B}}};
  taken_of(wrong, {1, 0x1A0});
  const auto problem = wrong.problem();
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->place, "--id 7B");
  EXPECT_NE(problem->what.find("1, 1A0"), std::string::npos) << problem->what;
  FrameFilter wrong_exclusion{{.not_ids = {9}}};
  EXPECT_NE(wrong_exclusion.problem()->what.find("there are none"), std::string::npos);
  std::vector<std::uint32_t> many;
  for (std::uint32_t id = 100; id < 145; ++id) many.push_back(id);
  taken_of(wrong_exclusion, many);
  EXPECT_EQ(wrong_exclusion.problem()->place, "--not-id 9");
  EXPECT_TRUE(wrong_exclusion.problem()->what.ends_with(" and 5 more"));
}

TEST(FrameFilter, WhatALeftOutNodeSendsIsLeftOut) {
  const SendingNode plant{
      .name = "Plant", .messages = {{1, false}, {3, false}}, .is_left_out = true};
  const SendingNode other{.name = "Other", .messages = {{2, false}, {3, true}}};
  FrameFilter filter{{.nodes = {plant, other}}};
  EXPECT_EQ(taken_of(filter, {1, 2, 3, 9}), (std::vector<std::uint32_t>{2, 9}));
  can::Frame extended{.id = 3, .extended = true};
  EXPECT_TRUE(filter.takes(extended));
  EXPECT_EQ(filter.left_out(), 2U);
  EXPECT_FALSE(filter.problem());
  FrameFilter silent{{.nodes = {plant, other}}};
  taken_of(silent, {2});
  ASSERT_TRUE(silent.problem());
  EXPECT_EQ(silent.problem()->place, "--overlay Plant");
  EXPECT_TRUE(silent.problem()->what.ends_with(": Other"));
}

}  // namespace
}  // namespace pitwall::replay
