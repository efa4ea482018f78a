// SPDX-License-Identifier: Apache-2.0
#include "hil/report/html.hpp"

#include <gtest/gtest.h>

namespace pitwall::report {
namespace {

TEST(Html, ADocumentHasTitleStyleBodyAndScriptOnce) {
  const std::string html = document("a <b>", "<p>body</p>", ".own { }");
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
  EXPECT_NE(html.find("<title>a &lt;b&gt;</title>"), std::string::npos);
  const std::size_t style = html.find(".own { }</style>"), body = html.find("<p>body</p><script>");
  EXPECT_LT(style, body);
  EXPECT_NE(body, std::string::npos);
  EXPECT_TRUE(html.ends_with("</script>\n</body></html>\n"));
}

TEST(Html, TextIsEscapedAndHtmlIsNot) {
  EXPECT_EQ(section("<t>", "<p>"), "<section><h2>&lt;t&gt;</h2>\n<p></section>\n");
  EXPECT_EQ(fact("<n>", "<v>"), "<div><dt>&lt;n&gt;</dt><dd>&lt;v&gt;</dd></div>");
  EXPECT_EQ(note("<n>"), "<p class=\"note\">&lt;n&gt;</p>\n");
  EXPECT_EQ(cell("<b>1</b>"), "<td><b>1</b></td>");
  EXPECT_EQ(cell("1", "word"), "<td class=\"word\">1</td>");
}

TEST(Html, OfAnOddNumberOfPartsTheLastStandsAlone) {
  EXPECT_EQ(in_two_columns({"a", "b", "c"}), beside("a", "b") + beside("c", ""));
  EXPECT_EQ(in_two_columns({}), "");
}

TEST(Html, AFactWithoutAValueSaysSo) {
  EXPECT_NE(fact("seed", "").find("not recorded"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::report
