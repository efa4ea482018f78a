// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/station_addresses.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace pitwall::io {
namespace {

using Words = std::vector<std::string>;

std::string refusal(const Words& paths) {
  const auto parsed = parse_station_addresses(paths);
  return parsed ? "" : to_string(parsed.error());
}

TEST(StationAddresses, AreInOrderByPath) {
  const auto parsed = parse_station_addresses(
      Words{"10.0.0.5:23431,10.0.0.6:23431,10.0.0.7:23441", "10.1.0.5:23432"});
  ASSERT_TRUE(parsed) << to_string(parsed.error());
  ASSERT_EQ(parsed->size(), 2U);
  EXPECT_EQ((*parsed)[0], (StationAddresses{{.ip = 0x0A000005, .port = 23'431},
                                            {.ip = 0x0A000006, .port = 23'431},
                                            {.ip = 0x0A000007, .port = 23'441}}));
  EXPECT_EQ((*parsed)[1], (StationAddresses{{.ip = 0x0A010005, .port = 23'432}}));
}

TEST(StationAddresses, AreFourOfAPathAtMost) {
  const std::string four = "10.0.0.1:1,10.0.0.2:1,10.0.0.3:1,10.0.0.4:1";
  EXPECT_EQ(refusal({four}), "");
  EXPECT_EQ(refusal({four + ",10.0.0.5:1"}),
            "--radio " + four + ",10.0.0.5:1: error: 5 addresses, expected one to 4 of a path");
}

TEST(StationAddresses, ThatAreNoneAreNamed) {
  for (const auto& [list, wrong] : std::vector<std::pair<std::string, std::string>>{
           {"", ""},
           {"nowhere", "nowhere"},
           {"23431", "23431"},
           {"10.0.0.5", "10.0.0.5"},
           {"10.0.0.5:1,", ""},
           {",10.0.0.5:1", ""},
           {"10.0.0.5:1,,10.0.0.6:1", ""},
           {"10.0.0.5:1, 10.0.0.6:1", " 10.0.0.6:1"},
           {"10.0.0.5:1;10.0.0.6:1", "10.0.0.5:1;10.0.0.6:1"},
           {"10.0.0.5:1,256.0.0.1:1", "256.0.0.1:1"},
           {"10.0.0.5:1,10.0.0.6:", "10.0.0.6:"},
           {"10.0.0.5:1,10.0.0.6:70000", "10.0.0.6:70000"},
           {"base:23431", "base:23431"}}) {
    const std::string output = refusal({list});
    EXPECT_EQ(output.find("--radio " + wrong + ": error: "), 0U) << list << ": " << output;
    EXPECT_NE(output.find("expected ADDRESS:PORT"), std::string::npos) << list << ": " << output;
  }
  const std::string output = refusal({"10.0.0.5:1,10.0.0.6:0"});
  EXPECT_EQ(output.find("--radio 10.0.0.6:0: error: the base station has no port"), 0U) << output;
}

TEST(StationAddresses, AreOfOnePathOrTwo) {
  EXPECT_EQ(refusal({}), "--radio: error: 0 paths, expected one or 2");
  EXPECT_EQ(refusal({"10.0.0.1:1", "10.0.0.2:1"}), "");
  EXPECT_EQ(refusal({"10.0.0.1:1", "10.0.0.2:1", "10.0.0.3:1"}),
            "--radio: error: 3 paths, expected one or 2");
}

TEST(StationAddresses, EachIsNamedOnce) {
  const std::string twice = "--radio 10.0.0.5:1: error: is named twice, expected each address once";
  EXPECT_EQ(refusal({"10.0.0.5:1,10.0.0.6:1,10.0.0.5:1"}), twice);
  EXPECT_EQ(refusal({"10.0.0.5:1", "10.0.0.6:1,10.0.0.5:1"}), twice) << "nor on the other path";
  EXPECT_EQ(refusal({"10.0.0.5:1,10.0.0.5:2"}), "");
}

// A socket of loopback reaches this machine only, and no other socket is bound there.
TEST(StationAddresses, OfOnePathAreAllOfThisMachineOrNone) {
  EXPECT_EQ(refusal({"127.0.0.1:1,127.0.0.2:1"}), "");
  EXPECT_EQ(refusal({"127.0.0.1:1", "10.0.0.5:1"}), "") << "each path has a socket of its own";
  for (const std::string list : {"127.0.0.1:1,10.0.0.5:1", "10.0.0.5:1,127.3.0.1:1"}) {
    const std::string output = refusal({list});
    EXPECT_EQ(output.find("--radio " + list + ": error: loopback beside"), 0U) << output;
  }
  EXPECT_TRUE(is_loopback({.ip = 0x7F000001}));
  EXPECT_FALSE(is_loopback({.ip = 0x80000001}));
}

}  // namespace
}  // namespace pitwall::io
