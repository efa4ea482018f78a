// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_options.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

// The place of the error, in angle brackets; empty: there is none.
std::string refused(const std::vector<std::string>& arguments) {
  const auto options = parse_replay_options(arguments);
  return options ? std::string{} : "<" + options.error().place + ">";
}
std::string at(const std::string& place) { return "<" + place + ">"; }

TEST(ReplayOptions, EveryOptionReachesItsValue) {
  const std::vector<std::string> arguments{
      "--interface", "v0",      "box.mcap",  "--map",  "can0=v1", "--receiver", "/gnss/0=3001",
      "--speed",     "2.5",     "--loop",    "3",      "--from",  "1.5",        "--until",
      "9",           "--skip",  "4",         "--late", "drop:7",  "--spin",     "50",
      "--topic",     "/gnss/0", "--topic",   "can0",   "--id",    "1a0",        "--not-id",
      "1FFFFFFF",    "--json",  "out.json",  "--dbc",  "a.dbc",   "--overlay",  "Plant",
      "--overlay",   "Pit",     "--restamp", "a.yaml", "--dds",   "7@10.0.0.5"};
  const auto options = parse_replay_options(arguments);
  ASSERT_TRUE(options) << to_string(options.error());
  const TimelineOptions& t = options->timeline;
  EXPECT_EQ(options->file, "box.mcap");
  EXPECT_EQ(t.interface, "v0");
  ASSERT_EQ(t.map.size(), 1U);
  EXPECT_EQ(t.map[0], (std::pair<std::string, std::string>{"can0", "v1"}));
  ASSERT_EQ(t.receivers.size(), 1U);
  EXPECT_EQ(t.receivers[0].first, "/gnss/0");
  EXPECT_EQ(t.speed, 2.5);
  EXPECT_EQ(options->play.passes, 3U);
  EXPECT_EQ(t.from, milliseconds(1'500));
  EXPECT_EQ(t.until, seconds(9));
  EXPECT_EQ(t.longest_gap, seconds(4));
  EXPECT_EQ(options->play.late, LatePolicy::kDrop);
  EXPECT_EQ(options->play.late_limit, milliseconds(7));
  EXPECT_EQ(options->lead, microseconds(50));
  EXPECT_EQ(t.topics, (std::vector<std::string>{"/gnss/0", "can0"}));
  EXPECT_EQ(t.ids, (std::vector<std::uint32_t>{0x1A0}));
  EXPECT_EQ(t.not_ids, (std::vector<std::uint32_t>{0x1FFF'FFFF}));
  EXPECT_EQ(options->json_file, "out.json");
  EXPECT_EQ(options->dbc_file, "a.dbc");
  ASSERT_TRUE(t.dds);
  EXPECT_EQ(t.dds->domain, 7);
  EXPECT_EQ(t.dds->interface, "10.0.0.5");
  EXPECT_EQ(options->manifest_file, "a.yaml");
  EXPECT_EQ(options->overlaid, (std::vector<std::string>{"Plant", "Pit"}));
}

TEST(ReplayOptions, AValueThatAnOptionDoesNotAllowIsNamed) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"--speed", "fast"},      {"--loop", "0"},      {"--loop", "1000001"}, {"--spin", "201"},
      {"--spin", "-1"},         {"--id", "20000000"}, {"--id", "xyz"},       {"--not-id", ""},
      {"--from", "-1"},         {"--until", "1e8"},   {"--skip", "nan"},     {"--map", "can0"},
      {"--late", "never"},      {"--late", "abort"},  {"--late", "drop"},    {"--late", "drop:"},
      {"--late", "drop:0"},     {"--late", "drop:x"}, {"--topic", ""},       {"--json", ""},
      {"--late", "catch-up:5"}, {"--dds", "102"},     {"--dds", "-1"},       {"--dds", "0@eth0"},
      {"--dds", "0@"}};
  for (const auto& [option, value] : wrong)
    EXPECT_EQ(refused({"log", option, value}), at(value)) << option;
  for (const char* receiver : {"/gnss/0", "=127.0.0.1:1", "/gnss/0=", "/gnss/0=here:3001",
                               "/gnss/0=127.0.0.1:0", "/gnss/0=127.0.0.1:65536"})
    EXPECT_EQ(refused({"log", "--receiver", receiver}), at(receiver));
}

TEST(ReplayOptions, UnknownOptionsMissingValuesAndFilesAreNamed) {
  EXPECT_EQ(refused({}), at("replay"));
  EXPECT_EQ(refused({"log", "--speed"}), at("--speed"));
  EXPECT_EQ(refused({"log", "--what", "1"}), at("--what"));
  EXPECT_EQ(refused({"log", "--start", "1"}), at("--start"));
  EXPECT_EQ(refused({"one.log", "other.log"}), at("other.log"));
}

TEST(ReplayOptions, ANodeNeedsADatabaseAndADatabaseAUse) {
  EXPECT_EQ(refused({"log", "--overlay", "Plant"}), at("--overlay"));
  EXPECT_EQ(refused({"log", "--dbc", "a.dbc"}), at("--dbc"));
  EXPECT_EQ(refused({"log", "--overlay", "Plant", "--dbc", "a.dbc"}), "");
  EXPECT_EQ(refused({"log", "--overlay", "Plant", "--restamp", "a.yaml"}), "");
  EXPECT_EQ(refused({"log", "--dbc", "a.dbc", "--restamp", "a.yaml"}), "");
}

}  // namespace
}  // namespace pitwall::replay
