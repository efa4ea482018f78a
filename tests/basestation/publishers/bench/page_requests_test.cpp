// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/bench/page_requests.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::bench {
namespace {

using json::JsonValue;
using Kind = PageAnswer::Kind;

JsonValue part(const std::string& page, int from, double next, double bytes,
               const std::string& text) {
  return *JsonValue::parse(json::Object{}
                               .text("type", "page")
                               .text("page", page)
                               .number("from", from)
                               .number("next", next)
                               .number("bytes", bytes)
                               .text("text", text)
                               .str(),
                           "part");
}

struct Asking {
  PageRequests pages;
  Instant now{seconds(50).ns};

  // The byte that is asked for; -1: nothing is.
  int asked(const std::string& page) {
    const auto line = pages.next_line(now);
    if (!line) return -1;
    const auto value = *JsonValue::parse(*line, "line");
    EXPECT_EQ(value.text("do"), "page");
    EXPECT_EQ(value.text("page"), page);
    return static_cast<int>(value.number("from"));
  }
  PageAnswer only_answer() {
    const auto answers = pages.answers();
    EXPECT_EQ(answers.size(), 1U);
    return answers.size() == 1 ? answers[0] : PageAnswer{};
  }
};

TEST(PageRequests, APageIsPutTogetherOfItsParts) {
  Asking asking;
  EXPECT_EQ(asking.asked("a"), -1);
  asking.pages.ask(7, "a");
  EXPECT_EQ(asking.asked("a"), 0);
  EXPECT_EQ(asking.asked("a"), -1) << "each part once";
  ASSERT_TRUE(asking.pages.take(part("a", 0, 3, 5, "abc")));
  EXPECT_TRUE(asking.pages.answers().empty());
  EXPECT_EQ(asking.asked("a"), 3);
  ASSERT_TRUE(asking.pages.take(part("a", 3, 5, 5, "de")));
  const PageAnswer answer = asking.only_answer();
  EXPECT_EQ(answer.request, 7U);
  EXPECT_EQ(answer.kind, Kind::kPage);
  EXPECT_EQ(answer.text, "abcde");
  EXPECT_TRUE(asking.pages.empty());
}

TEST(PageRequests, RequestsWaitForTheOneBefore) {
  Asking asking;
  asking.pages.ask(1, "a");
  asking.pages.ask(2, "b");
  EXPECT_EQ(asking.asked("a"), 0);
  ASSERT_TRUE(asking.pages.take(*JsonValue::parse(
      R"({"type": "page", "page": "a", "from": 0, "problem": "no such page"})", "part")));
  const PageAnswer refused = asking.only_answer();
  EXPECT_EQ(refused.request, 1U);
  EXPECT_EQ(refused.kind, Kind::kRefused);
  EXPECT_EQ(refused.text, "no such page");
  EXPECT_EQ(asking.asked("b"), 0);
  ASSERT_TRUE(asking.pages.take(part("b", 0, 0, 0, "")));
  EXPECT_EQ(asking.only_answer().kind, Kind::kPage) << "an empty one";
}

TEST(PageRequests, APartThatNobodyAskedForIsRefused) {
  Asking asking;
  EXPECT_FALSE(asking.pages.take(part("a", 0, 1, 1, "x")));
  asking.pages.ask(1, "a");
  EXPECT_FALSE(asking.pages.take(part("a", 0, 1, 1, "x"))) << "not yet";
  EXPECT_EQ(asking.asked("a"), 0);
  EXPECT_FALSE(asking.pages.take(part("b", 0, 1, 1, "x")));
  EXPECT_FALSE(asking.pages.take(part("a", 1, 2, 2, "x")));
  EXPECT_TRUE(asking.pages.answers().empty());
  EXPECT_TRUE(asking.pages.take(part("a", 0, 1, 1, "x")));
}

TEST(PageRequests, NonsenseOfTheServerEndsTheRequest) {
  const double most = static_cast<double>(PageRequests::kMaxPageBytes);
  for (const auto& [next, bytes] : std::vector<std::pair<double, double>>{
           {-1.0, 5.0}, {0.0, 5.0}, {6.0, 5.0}, {kUnset, 5.0}, {1.0, kUnset}, {1.0, most + 1}}) {
    Asking asking;
    asking.pages.ask(1, "a");
    EXPECT_EQ(asking.asked("a"), 0);
    EXPECT_FALSE(asking.pages.take(part("a", 0, next, bytes, "x"))) << next << " of " << bytes;
    EXPECT_EQ(asking.only_answer().kind, Kind::kRefused);
  }
}

// A server that sends more than it says takes no memory without end.
TEST(PageRequests, TheTextHasABound) {
  Asking asking;
  asking.pages.ask(1, "a");
  const std::string text(1 << 20, 'x');
  int parts = 0;
  while (asking.asked("a") == parts && parts < 100 &&
         asking.pages.take(part("a", parts, parts + 1, 1'000, text)))
    ++parts;
  EXPECT_EQ(parts, 12);
  EXPECT_EQ(asking.only_answer().kind, Kind::kRefused);
}

TEST(PageRequests, APageThatChangesWhileItIsReadIsNone) {
  Asking asking;
  asking.pages.ask(1, "a");
  EXPECT_EQ(asking.asked("a"), 0);
  ASSERT_TRUE(asking.pages.take(part("a", 0, 2, 4, "ab")));
  EXPECT_EQ(asking.asked("a"), 2);
  ASSERT_TRUE(asking.pages.take(part("a", 2, 5, 5, "xyz")));
  const PageAnswer answer = asking.only_answer();
  EXPECT_EQ(answer.kind, Kind::kUnanswered);
  EXPECT_NE(answer.text.find("has changed"), std::string::npos);
}

TEST(PageRequests, ASilentServerAndOneThatGoesEndThem) {
  Asking asking;
  asking.pages.ask(1, "a");
  asking.pages.ask(2, "b");
  EXPECT_EQ(asking.asked("a"), 0);
  asking.now = asking.now + PageRequests::kLimit - milliseconds(1);
  asking.pages.expire(asking.now);
  EXPECT_TRUE(asking.pages.answers().empty());
  asking.now = asking.now + milliseconds(1);
  asking.pages.expire(asking.now);
  EXPECT_EQ(asking.only_answer().request, 1U);
  asking.pages.disconnect("gone");
  const PageAnswer answer = asking.only_answer();
  EXPECT_EQ(answer.request, 2U);
  EXPECT_EQ(answer.kind, Kind::kUnanswered);
  EXPECT_EQ(answer.text, "gone");
}

TEST(PageRequests, NoMoreThanSoManyWait) {
  Asking asking;
  for (std::uint64_t i = 0; i <= PageRequests::kMaxWaiting; ++i) asking.pages.ask(i, "a");
  const PageAnswer answer = asking.only_answer();
  EXPECT_EQ(answer.request, PageRequests::kMaxWaiting);
  EXPECT_EQ(answer.kind, Kind::kUnanswered);
}

}  // namespace
}  // namespace pitwall::publishers::bench
