// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/radio_section.hpp"

#include <gtest/gtest.h>

#include <string>

#include "hil/scenario/scenario.hpp"

namespace pitwall::scenario {
namespace {

Result<Scenario, Problem> with(const std::string& sections) {
  return read_scenario(
      "schema: 1\nname: short\nseed: 3\nduration_s: 20\ntrack: t.yaml\ncar: c.yaml\n"
      "race_control: [{at_s: 0.5, track: red}]\n" +
          sections,
      "short.yaml");
}

TEST(RadioSection, IsOneLinkForEachPath) {
  const auto read = with(
      "radio:\n"
      "  - {rate_kbit: 256, delay_ms: 15, jitter_ms: 2, fade_loss: 0.3, fade_ms: 120, seed: 9,\n"
      "     blackouts: [{at_s: 40, for_s: 2, every_s: 45}]}\n"
      "  - {loss: 0.02, duplicate: 0.01, corrupt: 0.001, queue_bytes: 4096}\n");
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->radio.size(), 2u);
  const link::LinkParams& one = read->radio[0].link;
  EXPECT_EQ(one.rate_bytes_per_s, 32'000.0);
  EXPECT_EQ(one.delay, milliseconds(15));
  EXPECT_EQ(one.jitter, milliseconds(2));
  EXPECT_EQ(one.fades.mean_bad, milliseconds(120));
  EXPECT_EQ(one.fades.mean_good, milliseconds(280));
  ASSERT_EQ(one.blackouts.size(), 1u);
  EXPECT_EQ(one.blackouts[0].from, Instant{} + seconds(40));
  EXPECT_EQ(one.blackouts[0].every, seconds(45));
  EXPECT_EQ(read->radio[0].seed, 9u);
  const link::LinkParams& two = read->radio[1].link;
  EXPECT_EQ(two.rate_bytes_per_s, 0.0);
  EXPECT_EQ(two.loss, 0.02);
  EXPECT_EQ(two.duplicate, 0.01);
  EXPECT_EQ(two.corrupt, 0.001);
  EXPECT_EQ(two.queue_bytes, 4096u);
  EXPECT_EQ(two.fades.mean_bad, Duration{});
  EXPECT_FALSE(read->radio[1].seed);
}

TEST(RadioSection, MayBeLeftOut) {
  const auto read = with("");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_TRUE(read->radio.empty());
  EXPECT_TRUE(read->operator_texts.empty());
}

TEST(OperatorSection, IsInTheOrderOfTimeAndRepeats) {
  const auto read = with(
      "operator:\n"
      "  - {at_s: 9, say: stop controlled}\n"
      "  - {at_s: 2, say: take 1, every_s: 0.5, until_s: 4}\n"
      "  - {at_s: 3, say: command speed_limit 30}\n");
  ASSERT_TRUE(read) << to_string(read.error());
  std::string output;
  for (const OperatorText& word : read->operator_texts)
    output += std::to_string(word.at.ns / 1'000'000) + " " + word.text + "|";
  EXPECT_EQ(output,
            "2000 take 1|2500 take 1|3000 take 1|3000 command speed_limit 30|3500 take 1|"
            "4000 take 1|9000 stop controlled|");
}

TEST(RadioSection, WhatMakesNoSenseIsRefusedWithItsPlace) {
  for (const char* wrong :
       {"radio: [{}, {}, {}]\n", "radio: []\n", "radio: [{rate_kbit: -1}]\n",
        "radio: [{fade_loss: 0.3}]\n", "radio: [{fade_ms: 100}]\n",
        "radio: [{fade_loss: 1.0, fade_ms: 100}]\n", "radio: [{rate_kbps: 3}]\n",
        "radio: [{loss: 1.1}]\n", "radio: [{blackouts: [{at_s: 1}]}]\n",
        "radio: [{blackouts: [{at_s: 1, for_s: 2, every_s: 2}]}]\n", "operator: [{at_s: 1}]\n",
        "operator: [{at_s: 1, say: \"\"}]\n", "operator: [{at_s: 1, say: x, every_s: 1}]\n",
        "operator: [{at_s: 5, say: x, every_s: 1, until_s: 4}]\n",
        "operator: [{at_s: 0, say: x, every_s: 0.01, until_s: 36000}]\n"}) {
    const auto read = with(wrong);
    ASSERT_FALSE(read) << wrong;
    EXPECT_EQ(read.error().place.substr(0, 13), "short.yaml:8:") << to_string(read.error());
  }
}

}  // namespace
}  // namespace pitwall::scenario
