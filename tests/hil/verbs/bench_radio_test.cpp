// The verb with a contestant of a shell script in our place, so that its gates can be seen to hold
// and to be missed. Needs root, for networks of their own.
// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/bench_radio.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/transport/tun.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/verbs/program_run.hpp"

namespace pitwall::verbs {
namespace {

class BenchRadio : public ProgramRun {
 protected:
  // Whoever it is: the newest state of the last 3 s is always as old as this when it comes.
  void write_peer(const std::string& name, int age_ms) {
    const std::string age_ns = std::to_string(age_ms) + "000000";
    ASSERT_TRUE(transport::write_file(
        path(name),
        "#!/bin/sh\n[ $1 = car ] && exit 0\ni=3000\nwhile [ $i -gt 0 ]; do at=$(($2 - i * "
        "1000000))\necho $((at - " +
            age_ns + ")) $at safety\ni=$((i - 20))\ndone\n",
        0755));
  }
  Said judged(int age_ms) {
    write_peer("peer_pitwall", age_ms);
    return run({"bench", "radio", "--seconds", "1", "--case", "overload", "--peers", path(""),
                "--json", path("radio.json")});
  }
};

TEST_F(BenchRadio, RefusesWhatItCannotUse) {
  expect_refusal({"bench", "radio", "--seconds", "0"}, "--seconds");
  expect_refusal({"bench", "radio", "--trace", path("none.csv")}, path("none.csv"));
  expect_refusal({"bench", "radio", "--only", "nobody"}, "no such contestant or case");
  ASSERT_TRUE(transport::write_file(path("bad.csv"), "from_s,to_s\n2,1\n"));
  expect_refusal({"bench", "radio", "--trace", path("bad.csv")},
                 path("bad.csv") + ":2: error: the outage ends before it begins");
}

TEST_F(BenchRadio, WithoutOursThereIsNoVerdict) {
  expect_refusal({"bench", "radio", "--seconds", "1", "--peers", path("")},
                 "peer_pitwall: error: is not built");
}

TEST_F(BenchRadio, WritesTheFadesThatEverybodyMeets) {
  run({"bench", "radio", "--seconds", "60", "--only", "nobody", "--write-trace", path("a.csv")});
  run({"bench", "radio", "--seconds", "60", "--only", "nobody", "--write-trace", path("b.csv")});
  run({"bench", "radio", "--seconds", "60", "--only", "nobody", "--seed", "2", "--write-trace",
       path("c.csv")});
  EXPECT_GT(text_of("a.csv").size(), 1'000U);
  EXPECT_EQ(text_of("a.csv"), text_of("b.csv"));
  EXPECT_NE(text_of("a.csv"), text_of("c.csv"));
}

TEST_F(BenchRadio, CodeWordsAndFileSayTheSame) {
  const auto network = transport::TunNetwork::create({.address = 0x0A4D0001});
  if (!network) GTEST_SKIP() << to_string(network.error());
  for (const bool good : {true, false}) {
    const Said said = judged(good ? 20 : 90);
    EXPECT_EQ(said.code, good ? 0 : 1) << said.out << said.err;
    EXPECT_EQ(said.out.find("MISSED") == std::string::npos, good) << said.out;
    const auto json = yaml::load_file(path("radio.json"));
    ASSERT_TRUE(json) << to_string(json.error());
    yaml::StrictMap map = json->root();
    EXPECT_EQ(map.flag("held"), good);
    auto rows = map.maps("rows");
    ASSERT_EQ(rows.size(), 1U);  // the others are not built here, and that is said
    EXPECT_EQ(rows[0].text("stream"), "safety");
    EXPECT_NEAR(rows[0].number("age_p50_ms", 0.0, 1e6), good ? 30.0 : 100.0, 2.0);
    EXPECT_NE(said.out.find("is not built"), std::string::npos);
  }
}

}  // namespace
}  // namespace pitwall::verbs
