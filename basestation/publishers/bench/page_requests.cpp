// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/bench/page_requests.hpp"

#include <cmath>
#include <utility>

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::bench {
namespace {

// U+FFFD, of three bytes, stands for a byte that is not UTF-8.
constexpr std::size_t kMaxTextBytes = 3 * PageRequests::kMaxPageBytes;

}  // namespace

void PageRequests::ask(std::uint64_t request, std::string page) {
  if (waiting_.size() >= kMaxWaiting) {
    answers_.push_back({.request = request, .text = "too many pages are asked for at once"});
    return;
  }
  waiting_.push_back({.number = request, .page = std::move(page), .text = {}, .asked = {}});
}

std::optional<std::string> PageRequests::next_line(Instant now) {
  if (waiting_.empty() || waiting_.front().asked) return std::nullopt;
  Request& first = waiting_.front();
  first.asked = now;
  return json::Object{}
      .text("do", "page")
      .text("page", first.page)
      .number("from", first.from)
      .str();
}

Result<bool, Problem> PageRequests::take(const json::JsonValue& part) {
  if (waiting_.empty() || !waiting_.front().asked) return refuse("page", "expected no page");
  Request& first = waiting_.front();
  if (part.text("page") != first.page || part.number("from") != first.from)
    return refuse("page", "expected the part that was asked for");
  if (const std::string problem = part.text("problem"); !problem.empty()) {
    end(PageAnswer::Kind::kRefused, problem);
    return true;
  }
  const double next = part.number("next"), bytes = part.number("bytes");
  const std::string text = part.text("text");
  if (!(next >= first.from && next <= bytes && bytes <= static_cast<double>(kMaxPageBytes)) ||
      (next == first.from && next < bytes) || first.text.size() + text.size() > kMaxTextBytes) {
    end(PageAnswer::Kind::kRefused, "the bench server sent no part of a page");
    return refuse("next", "expected a byte of the page after this part");
  }
  if (first.from > 0.0 && bytes != first.bytes) {
    end(PageAnswer::Kind::kUnanswered, "the page has changed while it was read; open it again");
    return true;
  }
  first.text += text;
  first.from = next;
  first.bytes = bytes;
  first.asked.reset();
  if (next == bytes) end(PageAnswer::Kind::kPage, std::move(first.text));
  return true;
}

void PageRequests::expire(Instant now) {
  if (waiting_.empty() || !waiting_.front().asked || now - *waiting_.front().asked < kLimit) return;
  end(PageAnswer::Kind::kUnanswered, "the bench server does not answer");
}

void PageRequests::disconnect(const std::string& why) {
  while (!waiting_.empty()) end(PageAnswer::Kind::kUnanswered, why);
}

void PageRequests::end(PageAnswer::Kind kind, std::string text) {
  answers_.push_back({.request = waiting_.front().number, .kind = kind, .text = std::move(text)});
  waiting_.pop_front();
}

std::vector<PageAnswer> PageRequests::answers() { return std::exchange(answers_, {}); }

}  // namespace pitwall::publishers::bench
