// The rules over the tree as it is.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <set>
#include <sstream>

#include "tests/tidy/hidden_names.hpp"
#include "tests/tidy/identifier_rules.hpp"
#include "tests/tidy/include_rules.hpp"
#include "tests/tidy/message_rules.hpp"
#include "tests/tidy/shape_rules.hpp"
#include "tests/tidy/source_tree.hpp"
#include "tests/tidy/text_rules.hpp"

namespace pitwall::tidy {
namespace {

const std::vector<SourceFile>& tree() {
  static const std::vector<SourceFile> kTree = read_tree(PITWALL_SOURCE_DIR);
  return kTree;
}

std::string report(const std::vector<Finding>& findings) {
  std::ostringstream text;
  for (const Finding& f : findings) text << f.path << ":" << f.line << ": " << f.what << "\n";
  return text.str();
}

template <class Rule>
std::string findings_of(Rule&& rule) {
  std::vector<Finding> all;
  for (const SourceFile& file : tree()) {
    const std::vector<Finding> found = rule(file);
    all.insert(all.end(), found.begin(), found.end());
  }
  return report(all);
}

TEST(Tree, IsThere) {  // or every rule below would pass for want of files
  std::set<std::string> paths;
  for (const SourceFile& file : tree()) paths.insert(file.path);
  EXPECT_TRUE(paths.contains("protocol/vocabulary/result.hpp"));
  EXPECT_TRUE(paths.contains("tests/tidy/tree_test.cpp"));
  EXPECT_TRUE(paths.contains("vehicle/world/ego_state.hpp"));
}

TEST(Tree, IncludesOnlyWhatTheTableAllows) { EXPECT_EQ(findings_of(check_include_table), ""); }
TEST(Tree, HeavyHeadersStayInFewFiles) { EXPECT_EQ(findings_of(check_heavy_headers), ""); }
TEST(Tree, LinesAreShort) { EXPECT_EQ(findings_of(check_line_length), ""); }
TEST(Tree, BannedCallsAreReplaced) { EXPECT_EQ(findings_of(check_bans), ""); }
TEST(Tree, HeadersUseNoNamespace) { EXPECT_EQ(findings_of(check_using_namespace), ""); }
TEST(Tree, NothingIsLeftOver) { EXPECT_EQ(findings_of(check_leftovers), ""); }
TEST(Tree, NoPathOfOneMachine) { EXPECT_EQ(findings_of(check_machine_paths), ""); }
TEST(Tree, OpensWithContractAndLicence) { EXPECT_EQ(findings_of(check_opening), ""); }
TEST(Tree, FilesAreSmall) { EXPECT_EQ(findings_of(check_file_size), ""); }
TEST(Tree, FunctionsAreSmall) { EXPECT_EQ(findings_of(check_function_size), ""); }
TEST(Tree, FileNamesAreNouns) { EXPECT_EQ(findings_of(check_file_name), ""); }
TEST(Tree, IdentifiersAreThoseOfTheField) { EXPECT_EQ(findings_of(check_identifiers), ""); }
// Prints the table of all messages: they are read from end to end, by people.
TEST(Tree, MessagesSayWhatWasExpected) {
  std::size_t count = 0;
  for (const SourceFile& file : tree()) {
    for (const ErrorMessage& message : messages_of(file)) {
      std::printf("%s:%zu: %s\n", file.path.c_str(), message.line, message.text.c_str());
      ++count;
    }
  }
  EXPECT_GT(count, 300U) << "or the reader of messages reads none";
  EXPECT_EQ(findings_of(check_messages), "");
}

TEST(Tree, NoFileHidesAFunctionOfAHeader) { EXPECT_EQ(report(check_hidden_names(tree())), ""); }
TEST(Tree, FoldersAreSmall) { EXPECT_EQ(report(check_folder_size(tree())), ""); }
TEST(Tree, EveryFileHasItsTest) { EXPECT_EQ(report(check_mirrored_tests(tree())), ""); }

TEST(Tree, OwnHeaderComesFirst) {
  std::set<std::string> paths;
  for (const SourceFile& file : tree()) paths.insert(file.path);
  EXPECT_EQ(findings_of([&](const SourceFile& file) {
              const auto header = folder_of(file.path) + "/" + stem_of(file.path) + ".hpp";
              return check_own_header_first(file, paths.contains(header));
            }),
            "");
}

}  // namespace
}  // namespace pitwall::tidy
