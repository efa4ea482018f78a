// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/command_line.hpp"

#include <gtest/gtest.h>

namespace pitwall::cli {
namespace {

struct ParsedWords {
  std::string word;
  int number = 0;
  std::vector<double> place;
  bool loud = false, has_number = false;
  std::optional<int> code;
};

ParsedWords read(const std::vector<std::string>& args) {
  ParsedWords output;
  CommandLine line{"test"};
  line.option("word", output.word, "a word").required();
  const VerbOption number = line.option("--number", output.number, "1 to 9").range(1, 9);
  line.option("--place", output.place, "two numbers").with_commas().words(2).needs(number);
  line.flag("--loud", output.loud, "not with --number").excludes(number);
  output.code = line.ended_by(args);
  output.has_number = number.given();
  return output;
}

TEST(CommandLine, WordsAreReadInTheirOrder) {
  const ParsedWords output = read({"one", "--number", "7", "--place", "1.5,-2"});
  EXPECT_FALSE(output.code);
  EXPECT_EQ(output.word, "one");
  EXPECT_EQ(output.number, 7);
  EXPECT_TRUE(output.has_number);
  EXPECT_EQ(output.place, (std::vector{1.5, -2.0}));
  EXPECT_FALSE(read({"one"}).has_number);
}

TEST(CommandLine, HelpPassesAndWrongWordsAreUnusable) {
  EXPECT_EQ(read({"--help"}).code, kExitPass);
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{},
                                                {"one", "two"},
                                                {"one", "--number"},
                                                {"one", "--number", "10"},
                                                {"one", "--number", "7.5"},
                                                {"one", "--place", "1,2"},
                                                {"one", "--number", "7", "--place", "1"},
                                                {"one", "--number", "7", "--loud"},
                                                {"one", "--unknown"}})
    EXPECT_EQ(read(wrong).code, kExitUnusable) << ::testing::PrintToString(wrong);
}

TEST(CommandLine, ExactlyOneOfThePartsIsSaid) {
  const auto output = [](const std::vector<std::string>& args) {
    std::string file;
    CommandLine line{"test"};
    CommandLine show = line.one_of("show", "a file");
    show.option("FILE", file, "to be shown").required();
    const CommandLine list = line.one_of("list", "all files");
    const auto code = line.ended_by(args);
    if (code) return std::to_string(*code);
    return (show.is_chosen() ? "show " + file : "") + (list.is_chosen() ? "list" : "");
  };
  EXPECT_EQ(output({"show", "a"}), "show a");
  EXPECT_EQ(output({"list"}), "list");
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{}, {"show"}, {"list", "a"}, {"other"}})
    EXPECT_EQ(output(wrong), std::to_string(kExitUnusable));
}

}  // namespace
}  // namespace pitwall::cli
