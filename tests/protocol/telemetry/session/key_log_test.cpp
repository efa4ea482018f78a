// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/key_log.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "protocol/telemetry/session/traffic.hpp"
#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

struct Line {
  std::string cipher, receiver, key;
  int phase = -1;
};

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in{text};
  for (Line line; in >> line.cipher >> line.receiver >> line.phase >> line.key;) {
    lines.push_back(line);
  }
  return lines;
}

TEST(KeyLog, HasALineForEachPhaseThatAnEndMayMeet) {
  Key key;
  key.bytes.fill(7);
  const auto lines = lines_of(key_log_lines(0x0B0A, key));
  ASSERT_EQ(lines.size(), std::size_t{kMaxSilentPhases} + 1);
  for (int phase = 0; phase <= kMaxSilentPhases; ++phase) {
    const Line& line = lines[static_cast<std::size_t>(phase)];
    EXPECT_EQ(line.cipher, "CHACHA20_POLY1305");
    EXPECT_EQ(line.receiver, "0b0a");
    EXPECT_EQ(line.phase, phase);
    EXPECT_EQ(line.key, text_of(key.bytes));
    key = next_phase(key);
  }
}

// What both ends tell is the same, each other's direction included; with it a packet is opened.
struct Reported {
  bool bench_keys, real_car;
};
class KeysReported : public ::testing::TestWithParam<Reported> {};

// A base does not log the session of a real car either, whatever its own file says.
TEST_P(KeysReported, OnlyWithKeysOfTheBench) {
  KeyPair pair = make_pair(5);
  pair.car.bench = GetParam().bench_keys && !GetParam().real_car;
  pair.base.bench = GetParam().bench_keys;
  const bool logged = GetParam().bench_keys && !GetParam().real_car;
  std::map<std::string, int> reported;  // line, by how many ends
  const auto receive = [&](const std::string& text) {
    std::istringstream in{text};
    for (std::string line; std::getline(in, line);) ++reported[line];
  };
  SeededRandomness car_chance(1), base_chance(2);
  const Greeting greeting{.boot = 1, .safety_schema = 1, .whole_schema = 2};
  Greeting of_car = greeting;
  of_car.real_car = GetParam().real_car;
  Association car({.keys = pair.car,
                   .greeting = of_car,
                   .peer = {kBaseAddress, kBaseAddress},
                   .key_log = receive},
                  car_chance);
  Association base({.keys = pair.base, .greeting = greeting, .key_log = receive}, base_chance);
  std::array<std::uint8_t, kMaxDatagram> out{}, plain{};
  const Instant now{seconds(1).ns};
  const auto opening = car.poll(0, now, out);
  ASSERT_TRUE(opening);
  EXPECT_FALSE(base.feed(opening->bytes, 0, kCarAddress, now, plain));
  const auto answer = base.poll(0, now, out);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(car.feed(answer->bytes, 0, kBaseAddress, now, plain));
  ASSERT_TRUE(car.ready());
  EXPECT_EQ(reported.size(), logged ? 2 * (std::size_t{kMaxSilentPhases} + 1) : 0);
  for (const auto& [line, ends] : reported) EXPECT_EQ(ends, 2) << line;
}

INSTANTIATE_TEST_SUITE_P(BenchAndCar, KeysReported,
                         ::testing::Values(Reported{false, false}, Reported{true, false},
                                           Reported{true, true}));

}  // namespace
}  // namespace pitwall::telemetry::testing
