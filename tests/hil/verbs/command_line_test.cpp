// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/command_line.hpp"

#include <gtest/gtest.h>

namespace pitwall::verbs {
namespace {

std::optional<int> code_of(const std::vector<std::string>& args, std::string& word, int& number) {
  CLI::App app{"test"};
  app.add_option("word", word)->required();
  app.add_option("--number", number)->check(CLI::Range(1, 9));
  return ended_by(app, args);
}

TEST(CommandLine, WordsAreReadInTheirOrder) {
  std::string word;
  int number = 0;
  EXPECT_FALSE(code_of({"one", "--number", "7"}, word, number));
  EXPECT_EQ(word, "one");
  EXPECT_EQ(number, 7);
}

TEST(CommandLine, HelpPassesAndWrongWordsAreUnusable) {
  std::string word;
  int number = 0;
  EXPECT_EQ(code_of({"--help"}, word, number), kExitPass);
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{},
                                                {"one", "two"},
                                                {"one", "--number"},
                                                {"one", "--number", "10"},
                                                {"one", "--unknown"}})
    EXPECT_EQ(code_of(wrong, word, number), kExitUnusable);
}

}  // namespace
}  // namespace pitwall::verbs
