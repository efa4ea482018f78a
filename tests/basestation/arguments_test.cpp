// SPDX-License-Identifier: Apache-2.0
#include "basestation/arguments.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

namespace pitwall::basestation {
namespace {

Result<Arguments, Refusal> parse(std::initializer_list<const char*> words) {
  std::vector<const char*> argv{"pitwall-base"};
  argv.insert(argv.end(), words);
  return parse_arguments(static_cast<int>(argv.size()), argv.data());
}

TEST(Arguments, ListenAtLoopbackByDefault) {
  const auto arguments = parse({});
  ASSERT_TRUE(arguments.has_value());
  EXPECT_EQ(arguments->listen, (transport::UdpAddress{transport::kLoopbackIp, kDefaultPort}));
  EXPECT_FALSE(arguments->text);
  EXPECT_EQ(arguments->duration, Duration{});
}

TEST(Arguments, AreTaken) {
  const auto arguments = parse({"--text", "--plain", "--listen", "127.0.0.1:5000", "--duration",
                                "1.5", "--json", "out.json", "--refresh", "2"});
  ASSERT_TRUE(arguments.has_value());
  EXPECT_TRUE(arguments->text && arguments->plain);
  EXPECT_EQ(arguments->listen.port, 5'000);
  EXPECT_EQ(arguments->duration, milliseconds(1'500));
  EXPECT_EQ(arguments->json_path, "out.json");
  EXPECT_EQ(arguments->refresh_hz, 2.0);
}

TEST(Arguments, MistakesExitWithTwoAndAreNamed) {
  const std::initializer_list<const char*> mistakes[] = {
      {"--nonsense"},          {"--listen", "here"},   {"--listen", "127.0.0.1:70000"},
      {"--duration", "-1"},    {"--duration", "soon"}, {"--refresh", "0"},
      {"--refresh", "nan"},    {"--duration", "nan"},  {"--listen"},
      {"--text", "something"},
  };
  for (const auto& words : mistakes) {
    const auto arguments = parse(words);
    ASSERT_FALSE(arguments.has_value()) << *words.begin();
    EXPECT_EQ(arguments.error().exit_code, 2) << *words.begin();
    EXPECT_FALSE(arguments.error().text.empty());
  }
}

TEST(Arguments, OtherMachinesNeedAFlag) {
  ASSERT_FALSE(parse({"--listen", "0.0.0.0:5000"}).has_value());
  EXPECT_EQ(parse({"--listen", "0.0.0.0:5000"}).error().exit_code, 2);
  EXPECT_TRUE(parse({"--listen", "0.0.0.0:5000", "--network"}).has_value());
}

TEST(Arguments, HelpIsNoMistake) {
  const auto arguments = parse({"--help"});
  ASSERT_FALSE(arguments.has_value());
  EXPECT_EQ(arguments.error().exit_code, 0);
  EXPECT_NE(arguments.error().text.find("--listen"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::basestation
