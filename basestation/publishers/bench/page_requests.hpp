// Requests for pages of the bench server: each page is asked for part by part, one after the other.
//   in     requests, each with a number of its caller; parts, as the server sends them
//          (hil/cli/bench_server/PROTOCOL.md); time
//   out    lines to the server; whole pages, or why there is none
//   invariants
//          every request is answered once. A page that changes while it is read is none
//   bound  kMaxWaiting requests; kMaxPageBytes of a page; kLimit until the next part comes
//   errors take(): Problem of a part that nobody asked for
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "protocol/json/json_value.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::publishers::bench {

struct PageAnswer {
  enum class Kind : std::uint8_t { kPage, kRefused, kUnanswered };
  std::uint64_t request = 0;
  Kind kind = Kind::kUnanswered;
  std::string text;  // the page; otherwise why there is none
};

class PageRequests {
 public:
  static constexpr std::size_t kMaxWaiting = 16, kMaxPageBytes = 4 << 20;
  static constexpr Duration kLimit = seconds(5);

  void ask(std::uint64_t request, std::string page);
  // Line that asks for the next part, once each.
  std::optional<std::string> next_line(Instant now);
  Result<bool, Problem> take(const json::JsonValue& part);
  // Ends a request that the server leaves without an answer.
  void expire(Instant now);
  // Ends all requests: there is no server.
  void disconnect(const std::string& why);

  bool empty() const { return waiting_.empty(); }
  // Returns and removes the answers that are new since the last call.
  std::vector<PageAnswer> answers();

 private:
  struct Request {
    std::uint64_t number = 0;
    std::string page, text;
    double from = 0.0, bytes = kUnset;  // of the next part; of the page
    std::optional<Instant> asked;       // the next part
  };

  void end(PageAnswer::Kind kind, std::string text);

  std::deque<Request> waiting_;  // the first one is being read
  std::vector<PageAnswer> answers_;
};

}  // namespace pitwall::publishers::bench
