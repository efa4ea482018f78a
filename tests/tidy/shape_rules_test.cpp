// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/shape_rules.hpp"

#include <gtest/gtest.h>

namespace pitwall::tidy {
namespace {

std::string lines(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += "  x();\n";
  return text;
}

std::vector<std::size_t> sizes(const std::string& text) {
  std::vector<std::size_t> sizes;
  for (const auto& span : functions_of(make_source("a/b.cpp", text))) sizes.push_back(span.lines());
  return sizes;
}

using Sizes = std::vector<std::size_t>;

TEST(FunctionSize, EveryKindOfFunctionIsMeasured) {
  EXPECT_EQ(sizes("int f() { return 1; }\n"), (Sizes{1}));
  EXPECT_EQ(sizes("int f(int a,\n      int b) {\n" + lines(5) + "}\n"), (Sizes{8}));
  EXPECT_EQ(sizes("namespace a::b {\nnamespace {\nvoid f() {\n}\n}\nvoid g() {}\n}\n"),
            (Sizes{2, 1}));
  EXPECT_EQ(sizes("class A : public B {\n public:\n  A() : a_(1), b_{2}, c_{} {\n" + lines(2) +
                  "  }\n  int g() const { return 1; }\n private:\n  int a_ = 0;\n};\n"),
            (Sizes{4, 1}));
  EXPECT_EQ(sizes("template <class T, int N = 3>\nT f(T t) {\n}\n"), (Sizes{3}));
  EXPECT_EQ(sizes("bool operator==(A a, B b) {\n}\nA operator()(int i) const {\n}\n"),
            (Sizes{2, 2}));
  EXPECT_EQ(sizes("auto f() -> std::vector<int> {\n}\n"), (Sizes{2}));
  EXPECT_EQ(sizes("TEST(A, B) {\n" + lines(3) + "}\n"), (Sizes{5}));
  EXPECT_EQ(sizes("struct A {\n  void f() noexcept {\n  }\n  struct B { int x = 0; };\n};\n"),
            (Sizes{2}));
}

TEST(FunctionSize, InnerBlocksAndLambdasBelongToTheFunctionAroundThem) {
  EXPECT_EQ(sizes("void f() {\n  if (a) {\n    b();\n  }\n  auto g = [&](int i) {\n  };\n}\n"),
            (Sizes{7}));
}

TEST(FunctionSize, TablesInitialisersAndMacrosAreNone) {
  EXPECT_EQ(sizes("const std::vector<T> kT{\n {1, f(2)},\n {3, 4}};\n"), (Sizes{}));
  EXPECT_EQ(sizes("constexpr auto kT = make(T{\n1, 2});\n"), (Sizes{}));
  EXPECT_EQ(sizes("const std::map<int, std::function<void(int)>> kT{\n{1, 2}};\n"), (Sizes{}));
  EXPECT_EQ(sizes("enum class E { a, b };\nint x = 1;\n"), (Sizes{}));
  EXPECT_EQ(sizes("#define M(x) \\\n  if (x) { \\\n }\nvoid f() {}\n"), (Sizes{1}));
  EXPECT_EQ(sizes("// void f() {\nconst char* s = \"void g() {\";\n"), (Sizes{}));
}

TEST(FunctionSize, SeventyLinesPassAndSeventyOneDoNot) {
  const auto check = [](std::size_t inner) {
    return check_function_size(make_source("a/b.cpp", "\nvoid f() {\n" + lines(inner) + "}\n"));
  };
  EXPECT_TRUE(check(68).empty());
  const auto found = check(69);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 2U);
}

TEST(FileSize, TestsMayBeLonger) {
  EXPECT_TRUE(check_file_size(make_source("a/b.cpp", lines(400))).empty());
  EXPECT_FALSE(check_file_size(make_source("a/b.cpp", lines(401))).empty());
  EXPECT_TRUE(check_file_size(make_source("tests/a/b.cpp", lines(600))).empty());
  EXPECT_FALSE(check_file_size(make_source("tests/a/b.cpp", lines(601))).empty());
}

TEST(FileName, ForbiddenWordsAndOtherCases) {
  for (const std::string bad : {"a/util.hpp", "a/string_utils.cpp", "a/helpers/x.hpp",
                                "a/can_types.hpp", "a/base.cpp", "a/impl.hpp", "a/handler_x.cpp",
                                "a/session_manager.hpp", "a/misc.cpp", "a/CamelCase.cpp"}) {
    EXPECT_EQ(check_file_name(make_source(bad, "")).size(), 1U) << bad;
  }
  for (const std::string good : {"basestation/alarms/alarm.hpp", "a/utility_power.hpp",
                                 "a/implausible.cpp", "tests/a/b_test.cpp"}) {
    EXPECT_TRUE(check_file_name(make_source(good, "")).empty()) << good;
  }
}

TEST(MirroredTests, SourcesAndHeadersWithLogicNeedOne) {
  const std::string logic = "inline int f() {\n  a();\n  b();\n  c();\n  return 1;\n}\n";
  const std::string plain = "struct A {\n  int x = 0;\n  int y() const { return x; }\n};\n";
  const auto missing = [](const std::vector<SourceFile>& tree) {
    return check_mirrored_tests(tree).size();
  };
  EXPECT_EQ(missing({make_source("a/b.cpp", "")}), 1U);
  EXPECT_EQ(missing({make_source("a/b.cpp", ""), make_source("tests/a/b_test.cpp", "")}), 0U);
  EXPECT_EQ(missing({make_source("a/b.cpp", ""), make_source("tests/c/b_test.cpp", "")}), 1U);
  EXPECT_EQ(missing({make_source("a/b.hpp", logic)}), 1U);
  EXPECT_EQ(missing({make_source("a/b.hpp", plain)}), 0U);
  EXPECT_EQ(missing({make_source("a/b.hpp", logic), make_source("a/b.cpp", ""),
                     make_source("tests/a/b_test.cpp", "")}),
            0U);
  EXPECT_EQ(missing({make_source("a/main.cpp", "")}), 0U);
  EXPECT_EQ(missing({make_source("tests/support/b.cpp", "")}), 0U);
}

TEST(FolderSize, APairIsOneEntryAndSoIsASubfolder) {
  std::vector<SourceFile> tree;
  for (int i = 0; i < 17; ++i) {
    const std::string stem = "hil/a/x" + std::to_string(i);
    tree.push_back(make_source(stem + ".hpp", ""));
    tree.push_back(make_source(stem + ".cpp", ""));
  }
  EXPECT_TRUE(check_folder_size(tree).empty());
  tree.push_back(make_source("hil/a/b/y.cpp", ""));
  ASSERT_EQ(check_folder_size(tree).size(), 1U);
  EXPECT_EQ(check_folder_size(tree)[0].path, "hil/a");
}

TEST(FolderSize, AFolderOfTestsMayHoldWhatItsSourcesNeed) {
  std::vector<SourceFile> tree;
  for (int i = 0; i < 40; ++i)
    tree.push_back(make_source("tests/a/x" + std::to_string(i) + "_test.cpp", ""));
  EXPECT_TRUE(check_folder_size(tree).empty());
}

}  // namespace
}  // namespace pitwall::tidy
