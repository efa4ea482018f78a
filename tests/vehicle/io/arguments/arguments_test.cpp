// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/arguments.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pitwall::io {
namespace {

using Words = std::vector<std::string>;

struct Parsed {
  std::variant<Arguments, int> result;
  std::string out, err;

  bool refused() const { return std::holds_alternative<int>(result); }
  int code() const { return std::get<int>(result); }
  const Arguments& args() const { return std::get<Arguments>(result); }
};

Parsed parse_vehicle(const Words& words) {
  std::vector<const char*> argv{"pitwall-vehicle"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  auto result = parse_arguments(static_cast<int>(argv.size()), argv.data());
  std::string out = ::testing::internal::GetCapturedStdout();
  return {std::move(result), std::move(out), ::testing::internal::GetCapturedStderr()};
}

const Words kLeast{"--car", "a.yaml", "--track", "b.yaml", "--can",
                   "can0",  "--keys", "c.keys",  "--gnss", "23501,23502"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Arguments, TheLeastHaveDefaults) {
  const Parsed p = parse_vehicle(kLeast);
  ASSERT_FALSE(p.refused()) << p.err;
  EXPECT_EQ(p.args().car_file, "a.yaml");
  EXPECT_EQ(p.args().track_file, "b.yaml");
  EXPECT_EQ(p.args().can_interface, "can0");
  EXPECT_EQ(to_string(p.args().receivers[0]), "udp:127.0.0.1:23501");
  EXPECT_EQ(to_string(p.args().receivers[1]), "udp:127.0.0.1:23502");
  EXPECT_EQ(p.args().radio, Words{"127.0.0.1:23431"});
  EXPECT_EQ(p.args().keys, "c.keys");
  EXPECT_EQ(p.args().local_report, 0) << "nobody is told without being asked for";
  EXPECT_EQ(p.args().summary_file, "");
  EXPECT_FALSE(p.args().simulation);
  EXPECT_FALSE(p.args().no_base) << "a car is not driven without its base by default";
  EXPECT_FALSE(p.args().arm) << "a car is armed on request only";
  EXPECT_EQ(p.out + p.err, "");
}

TEST(Arguments, EveryOptionArrives) {
  const Parsed p = parse_vehicle(with(
      kLeast, {"--radio", "10.0.0.5:99,10.0.0.6:99", "--radio", "10.0.1.5:98", "--local-report",
               "23436", "--summary", "s.json", "--simulation", "--arm", "--no-base", "--sensors",
               "sensors.yaml", "--sensors-domain", "7", "--debug-dds"}));
  ASSERT_FALSE(p.refused()) << p.err;
  EXPECT_EQ(p.args().radio, (Words{"10.0.0.5:99,10.0.0.6:99", "10.0.1.5:98"}));
  EXPECT_EQ(p.args().local_report, 23436);
  EXPECT_EQ(p.args().summary_file, "s.json");
  EXPECT_EQ(p.args().sensors_file, "sensors.yaml");
  EXPECT_EQ(p.args().sensors_domain, 7);
  EXPECT_TRUE(p.args().debug_dds);
  EXPECT_TRUE(p.args().simulation);
  EXPECT_TRUE(p.args().arm);
  EXPECT_TRUE(p.args().no_base);
}

TEST(Arguments, ADomainOfSensorsNeedsTheirFileAndIsOneOfRos) {
  EXPECT_FALSE(parse_vehicle(with(kLeast, {"--sensors", "s.yaml"})).args().sensors_domain);
  EXPECT_TRUE(parse_vehicle(with(kLeast, {"--sensors-domain", "7"})).refused());
  EXPECT_TRUE(parse_vehicle(with(kLeast, {"--debug-dds"})).refused()) << "nothing to show";
  EXPECT_TRUE(
      parse_vehicle(with(kLeast, {"--sensors", "s.yaml", "--sensors-domain", "102"})).refused());
}

TEST(Arguments, HelpIsNoError) {
  const Parsed p = parse_vehicle({"--help"});
  ASSERT_TRUE(p.refused());
  EXPECT_EQ(p.code(), 0);
  for (const char* option :
       {"--car", "--track", "--can", "--gnss", "--receiver", "--radio", "--keys", "--local-report",
        "--summary", "--sensors", "--simulation", "--arm", "--no-base"})
    EXPECT_NE(p.out.find(option), std::string::npos) << option;
}

TEST(Arguments, EachOfTheLeastIsNeeded) {
  for (std::size_t i = 0; i < kLeast.size(); i += 2) {
    Words words = kLeast;
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(i),
                words.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    const Parsed p = parse_vehicle(words);
    ASSERT_TRUE(p.refused()) << kLeast[i];
    EXPECT_EQ(p.code(), 2);
    EXPECT_NE(p.err.find(kLeast[i]), std::string::npos) << p.err;
  }
}

// Whoever has no keys is told how to make them; a bench without a base needs none.
TEST(Arguments, WithoutKeysOnlyABenchStarts) {
  Words words = kLeast;
  words.erase(words.begin() + 6, words.begin() + 8);
  const Parsed p = parse_vehicle(words);
  ASSERT_TRUE(p.refused());
  EXPECT_EQ(p.code(), 2);
  EXPECT_NE(p.err.find("--keys"), std::string::npos) << p.err;
  EXPECT_NE(p.err.find("pitwall-base keygen"), std::string::npos) << p.err;
  EXPECT_FALSE(parse_vehicle(with(words, {"--no-base"})).refused());
  EXPECT_FALSE(parse_vehicle(with(words, {"--check"})).refused());
}

TEST(Arguments, WrongUsageIsCodeTwoAndSaysWhy) {
  const std::vector<Words> wrong{
      {},
      with(kLeast, {"--unknown"}),
      with(kLeast, {"stray"}),
      with(kLeast, {"--radio"}),
      with(kLeast, {"--radio", "1.2.3.4:1", "--radio", "1.2.3.4:2", "--radio", "1.2.3.4:3"}),
      with(kLeast, {"--local-report", "0"}),
      with(kLeast, {"--local-report", "65536"}),
      with(kLeast, {"--can", "can1"}),
      with(kLeast, {"--arm=maybe"}),
  };
  for (const Words& words : wrong) {
    const Parsed p = parse_vehicle(words);
    ASSERT_TRUE(p.refused()) << (words.empty() ? "nothing" : words.back());
    EXPECT_EQ(p.code(), 2);
    EXPECT_FALSE(p.err.empty());
  }
}

TEST(Arguments, EachReceiverMayHaveALinkOfItsOwn) {
  Words words = kLeast;
  words.resize(8);
  const Parsed p = parse_vehicle(with(words, {"--receiver", "1=serial:/dev/ttyUSB0:921600",
                                              "--receiver", "0=tcp:192.168.7.2:3001"}));
  ASSERT_FALSE(p.refused()) << p.err;
  EXPECT_EQ(to_string(p.args().receivers[0]), "tcp:192.168.7.2:3001");
  EXPECT_EQ(to_string(p.args().receivers[1]), "serial:/dev/ttyUSB0:921600");
}

TEST(Arguments, ALinkThatMakesNoSenseIsNamedWithItsOption) {
  Words words = kLeast;
  words.resize(8);
  const std::vector<std::pair<Words, std::string>> wrong{
      {{"--receiver", "0=udp:23501"}, "unit 1"},
      {{"--receiver", "0=udp:23501", "--receiver", "1=udp:23501"}, "two different"},
      {{"--receiver", "0=udp:1", "--receiver", "0=udp:2"}, "already"},
      {{"--receiver", "2=udp:1", "--receiver", "0=udp:2"}, "0=LINK"},
      {{"--receiver", "udp:1", "--receiver", "0=udp:2"}, "0=LINK"},
      {{"--receiver", "0=usb:1", "--receiver", "1=udp:2"}, "tcp:ADDRESS:PORT"},
      {{"--receiver", "0=tcp:host:1", "--receiver", "1=udp:2"}, "IPv4"},
      {{"--receiver", "0=udp:0", "--receiver", "1=udp:2"}, "port"},
      {{"--receiver", "0=serial:/dev/ttyS0:12345", "--receiver", "1=udp:2"}, "12345"},
      {{"--receiver", "0=serial:/dev/ttyS0:fast", "--receiver", "1=udp:2"}, "fast"},
      {{"--receiver", "0=serial:ttyS0", "--receiver", "1=udp:2"}, "/dev/ttyS0"},
      {{"--gnss", "1,2", "--receiver", "0=udp:3"}, "already"}};
  for (const auto& [more, stated] : wrong) {
    const Parsed p = parse_vehicle(with(words, more));
    ASSERT_TRUE(p.refused()) << more.back();
    EXPECT_EQ(p.code(), 2);
    EXPECT_NE(p.err.find("--receiver"), std::string::npos) << p.err;
    EXPECT_NE(p.err.find(stated), std::string::npos) << p.err;
  }
}

TEST(Arguments, PortsAreTwoNumbersOfTheRightSize) {
  for (const char* ports : {"23501", "23501,23502,23503", "a,b", "70000,23502", "-1,23502",
                            "0,23502", "23501,0", "23501,23501", ",", "", "1.5,2"}) {
    Words words = kLeast;
    words.back() = ports;
    const Parsed p = parse_vehicle(words);
    ASSERT_TRUE(p.refused()) << ports;
    EXPECT_EQ(p.code(), 2) << ports;
    EXPECT_FALSE(p.err.empty()) << ports;
  }
}

}  // namespace
}  // namespace pitwall::io
