// SPDX-License-Identifier: Apache-2.0
#include "hil/report/page.hpp"

#include <gtest/gtest.h>

#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

TEST(Page, TheSameLogGivesTheSameBytes) {
  const LogOrder order{.with_failure = true};
  EXPECT_EQ(page(run_of(order), nullptr, "none"), page(run_of(order), nullptr, "none"));
}

TEST(Page, NeedsNothingFromOutside) {
  const std::string html = page(run_of({}), nullptr, "none");
  for (const char* outside : {"http://", "https://", "src=", "@import", "url("})
    EXPECT_EQ(count(html, outside), std::string(outside) == "http://" ? 1u : 0u)
        << outside << " (the one http:// names the SVG namespace)";
}

TEST(Page, IsSmallEvenOfALongRun) {
  const std::string html = page(run_of({.duration_s = 180.0}), nullptr, "none");
  EXPECT_LT(html.size(), 2'000'000u);
  EXPECT_GT(html.size(), 100'000u);
}

TEST(Page, HostileNamesStayText) {
  const std::string evil = "</title><script>alert(1)</script>\"'<img onerror=x>\x01\x7f\xff";
  const std::string html =
      page(run_of({.scenario = evil,
                   .mode = "<i>",
                   .faults = R"([{"kind":"</svg><script>x","at_s":1},{"kind":"late","at_s":1e300},
                            {"kind":"none"},7])"}),
           nullptr, "<b>");
  EXPECT_EQ(count(html, "<script>"), 1u) << "the page's own";
  EXPECT_EQ(count(html, "</script>"), 2u) << "its own, and that of its data";
  for (const char* tag : {"<img", "<i>", "<b>none", "alert(1)</script>"})
    EXPECT_EQ(count(html, tag), 0u) << tag;
  for (const char c : html) EXPECT_FALSE(c >= 0 && c < ' ' && c != '\n') << static_cast<int>(c);
}

TEST(Page, AMatchHasItsSheetAndNoErrorFromALineThatTheCarLeaves) {
  RunData run = run_of({});
  constexpr const char* kBrackets = "paper, real car";
  EXPECT_GT(count(page(run, nullptr, "none"), kBrackets), 0u);
  run.result.emplace().match.emplace().result = "draw";
  const std::string html = page(run, nullptr, "none");
  EXPECT_EQ(count(html, "Match sheet"), 1u);
  EXPECT_EQ(count(html, kBrackets), 0u);
}

TEST(Page, AnEmptyRunIsAPageToo) {
  RunData run;
  run.infrastructure.push_back("no log");
  const std::string html = page(run, nullptr, "none");
  EXPECT_EQ(count(html, "INFRASTRUCTURE"), 2u) << "title and banner";
}

}  // namespace
}  // namespace pitwall::report
