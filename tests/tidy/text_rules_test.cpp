// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/text_rules.hpp"

#include <gtest/gtest.h>

namespace pitwall::tidy {
namespace {

std::size_t bans(const std::string& path, const std::string& text) {
  return check_bans(make_source(path, text)).size();
}

TEST(LineLength, CountsCharactersNotBytes) {
  const auto findings = [](const std::string& line) {
    return check_line_length(make_source("a/b.hpp", "\n" + line + "\n"));
  };
  EXPECT_TRUE(findings(std::string(100, 'x')).empty());
  const auto found = findings(std::string(101, 'x'));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 2U);
  std::string greek;
  for (int i = 0; i < 100; ++i) greek += "λ";
  EXPECT_TRUE(findings(greek).empty());
}

TEST(Bans, EachCallIsFoundWhereItIsNotAllowed) {
  const std::string pure = "vehicle/safety/supervisor.cpp";
  for (const std::string call : {"auto t = std::chrono::steady_clock::now();",
                                 "std::chrono::system_clock::now()",
                                 "high_resolution_clock c;",
                                 "clock_gettime(a, b)",
                                 "std::thread t;",
                                 "std::jthread t;",
                                 "std::mutex m;",
                                 "int x = rand();",
                                 "srand(1);",
                                 "std::random_device d;",
                                 "std::normal_distribution<double> d;",
                                 "std::uniform_real_distribution<> d;",
                                 "std::printf(\"x\");",
                                 "fprintf(f, x)",
                                 "std::cout << 1;",
                                 "std::cerr << 1;",
                                 "std::atan2(sin(a), cos(a))",
                                 "std::atan2(std::sin(a), std::cos(a))",
                                 "usleep(1)",
                                 "std::this_thread::sleep_for(x)",
                                 "assert(x);",
                                 "M_PI * 2",
                                 "std::getenv(x)",
                                 "std::exit(1)",
                                 "sprintf(a, b)",
                                 "atof(s)"}) {
    EXPECT_EQ(bans(pure, call), 1U) << call;
  }
}

TEST(Bans, OtherWordsCommentsAndStringsAreNone) {
  const std::string pure = "vehicle/safety/supervisor.cpp";
  for (const std::string text :
       {"static_assert(x);", "operand(1);", "strand(2)", "snprintf(a, b, c)", "my_steady_clocks x;",
        "// std::thread", "const char* s = \"rand()\";", "assertion(x)", "clock.sleep_until(t)",
        "EXPECT_EQ(1, 1)"}) {
    EXPECT_EQ(bans(pure, text), 0U) << text;
  }
}

TEST(Bans, TheRimMay) {
  EXPECT_EQ(bans("protocol/transport/clock.cpp", "std::chrono::steady_clock::now()"), 0U);
  EXPECT_EQ(bans("vehicle/io/camera.cpp", "std::thread t;"), 0U);
  EXPECT_EQ(bans("vehicle/io/camera.cpp", "std::chrono::steady_clock::now()"), 1U);
  EXPECT_EQ(bans("hil/main.cpp", "std::cout << 1;"), 0U);
  EXPECT_EQ(bans("hil/replay/replay_verb.cpp", "std::cout << 1;"), 0U);
  EXPECT_EQ(bans("hil/domain.cpp", "std::cout << 1;"), 1U);
  EXPECT_EQ(bans("protocol/vocabulary/check.hpp", "std::fprintf(stderr, x)"), 0U);
  EXPECT_EQ(bans("tests/hil/x_test.cpp", "std::chrono::steady_clock::now()"), 1U);
}

TEST(UsingNamespace, IsForSourcesOnly) {
  EXPECT_EQ(check_using_namespace(make_source("a/b.hpp", "using namespace std;")).size(), 1U);
  EXPECT_TRUE(check_using_namespace(make_source("a/b.cpp", "using namespace std;")).empty());
  EXPECT_TRUE(
      check_using_namespace(make_source("a/b.hpp", "namespace x { using std::a; }")).empty());
  const std::string local = "inline int f() {\n  using namespace detail;\n  return g();\n}\n";
  EXPECT_TRUE(check_using_namespace(make_source("a/b.hpp", local)).empty());
}

TEST(Leftovers, AreFoundInCommentsAndOnlyAsWords) {
  for (const std::string& word : {std::string{"TO"} + "DO", std::string{"FIX"} + "ME",
                                  std::string{"XX"} + "X", std::string{"HA"} + "CK"}) {
    const auto found = check_leftovers(make_source("a/b.cmake", "x\n# " + word + ": y\n"));
    ASSERT_EQ(found.size(), 1U) << word;
    EXPECT_EQ(found[0].line, 2U);
    EXPECT_TRUE(check_leftovers(make_source("a/b.cmake", "A" + word + "S")).empty());
  }
}

TEST(MachinePaths, AreFoundInTheProductAndTestsMayLookForRecordings) {
  const std::string recordings = std::string{"../sha"} + "red/data";
  const std::string home = std::string{"/ho"} + "me/me/x";
  EXPECT_EQ(check_machine_paths(make_source("hil/a.cpp", recordings)).size(), 1U);
  EXPECT_TRUE(check_machine_paths(make_source("tests/a.cpp", recordings)).empty());
  EXPECT_EQ(check_machine_paths(make_source("tests/a.cpp", home)).size(), 1U);
  EXPECT_TRUE(check_machine_paths(make_source("hil/a.cpp", "framework/x and homework")).empty());
}

TEST(Opening, WantsContractAndLicence) {
  const std::string spdx = "// SPDX-License-Identifier: Apache-2.0\n";
  EXPECT_TRUE(check_opening(make_source("a/b.hpp", "// What it is.\n" + spdx)).empty());
  EXPECT_FALSE(check_opening(make_source("a/b.hpp", spdx)).empty());
  EXPECT_TRUE(check_opening(make_source("a/b.cpp", spdx + "#include <x>\n")).empty());
  EXPECT_FALSE(check_opening(make_source("a/b.cpp", "#include <x>\n" + spdx)).empty());
  EXPECT_FALSE(check_opening(make_source("a/b.cpp", "")).empty());
}

}  // namespace
}  // namespace pitwall::tidy
