// The verb with a contestant of a shell script in our place, so that its gates can be seen to hold
// and to be missed. Needs root, for networks of their own.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/bench_radio.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/yaml/strict_map.hpp"
#include "tests/benchmarks/protocol_comparison/tun.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;
namespace {

class BenchRadio : public ProgramRun {
 protected:
  // Whoever it is: the newest state of the last 3 s is always as old as this when it comes.
  void write_peer(const std::string& name, int age_ms, int whole_ms) {
    const std::string age_ns = std::to_string(age_ms) + "000000",
                      whole_ns = std::to_string(whole_ms) + "000000";
    ASSERT_TRUE(transport::write_file(
        path(name),
        "#!/bin/sh\n[ $1 = car ] && exit 0\ni=3000\nwhile [ $i -gt 0 ]; do at=$(($2 - i * "
        "1000000))\necho $((at - " +
            age_ns + ")) $at safety\necho $((at - " + whole_ns +
            ")) $at all 100 signals\ni=$((i - 20))\ndone\n",
        0755));
  }
  ProgramOutput judged(int age_ms, int whole_ms) {
    write_peer("peer_pitwall", age_ms, whole_ms);
    return run({"radio", "--seconds", "1", "--case", "overload", "--peers", path(""), "--json",
                path("radio.json")});
  }
};

TEST_F(BenchRadio, RefusesWhatItCannotUse) {
  expect_refusal({"radio", "--seconds", "0"}, "--seconds");
  expect_refusal({"radio", "--trace", path("none.csv")}, path("none.csv"));
  expect_refusal({"radio", "--only", "nobody"}, "no such contestant or case");
  ASSERT_TRUE(transport::write_file(path("bad.csv"), "from_s,to_s\n2,1\n"));
  expect_refusal({"radio", "--trace", path("bad.csv")},
                 path("bad.csv") + ":2: error: the outage ends before it begins");
}

TEST_F(BenchRadio, WithoutOursThereIsNoVerdict) {
  expect_refusal({"radio", "--seconds", "1", "--peers", path("")},
                 "peer_pitwall: error: is not built");
}

TEST_F(BenchRadio, WritesTheFadesThatEverybodyMeets) {
  run({"radio", "--seconds", "60", "--only", "nobody", "--write-trace", path("a.csv")});
  run({"radio", "--seconds", "60", "--only", "nobody", "--write-trace", path("b.csv")});
  run({"radio", "--seconds", "60", "--only", "nobody", "--seed", "2", "--write-trace",
       path("c.csv")});
  EXPECT_GT(text_of("a.csv").size(), 1'000U);
  EXPECT_EQ(text_of("a.csv"), text_of("b.csv"));
  EXPECT_NE(text_of("a.csv"), text_of("c.csv"));
}

TEST_F(BenchRadio, CodeWordsAndFileSayTheSame) {
  const auto network = transport::TunNetwork::create({.address = 0x0A4D0001});
  if (!network) GTEST_SKIP() << to_string(network.error());
  struct Try {
    int safety_ms, whole_ms;
  };
  for (const Try t : {Try{20, 100}, Try{90, 100}, Try{20, 210}}) {
    const bool good = t.safety_ms == 20 && t.whole_ms == 100;
    const ProgramOutput output = judged(t.safety_ms, t.whole_ms);
    EXPECT_EQ(output.code, good ? 0 : 1) << output.out << output.err;
    EXPECT_EQ(output.out.find("MISSED") == std::string::npos, good) << output.out;
    const auto json = yaml::load_file(path("radio.json"));
    ASSERT_TRUE(json) << to_string(json.error());
    yaml::StrictMap map = json->root();
    EXPECT_EQ(map.flag("held"), good);
    auto rows = map.maps("rows");
    ASSERT_EQ(rows.size(), 2U);  // the others are not built here, and that is said
    EXPECT_EQ(rows[0].text("stream"), "safety");
    EXPECT_EQ(rows[1].text("stream"), "all 100 signals");
    EXPECT_NEAR(rows[0].number("age_p50_ms", 0.0, 1e6), t.safety_ms + 10.0, 2.0);
    EXPECT_NEAR(rows[1].number("age_p50_ms", 0.0, 1e6), t.whole_ms + 10.0, 2.0);
    EXPECT_NE(output.out.find("is not built"), std::string::npos);
  }
}

// A contestant as young as ours is named, one that is older is not; a tuned one has its row too.
TEST_F(BenchRadio, NamesWhoComesNearOurs) {
  const auto network = transport::TunNetwork::create({.address = 0x0A4D0001});
  if (!network) GTEST_SKIP() << to_string(network.error());
  write_peer("peer_pitwall", 20, 40);
  write_peer("peer_lcm_udpm", 42, 42);
  write_peer("peer_cyclone_dds", 90, 90);
  const ProgramOutput output =
      run({"radio", "--seconds", "1", "--case", "overload", "--peers", path("")});
  const std::string near = output.out.substr(output.out.find("times as old as ours"));
  EXPECT_NE(near.find("overload: LCM, bulk paced"), std::string::npos) << output.out;
  EXPECT_EQ(near.find("Cyclone"), std::string::npos) << output.out;
}

}  // namespace
}  // namespace pitwall::benchmarks
