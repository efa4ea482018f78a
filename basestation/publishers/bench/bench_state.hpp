// Newest state of a bench server for consoles: scenarios, sweeps and current run, line by line. The
// protocol: hil/cli/bench_server/PROTOCOL.md.
//   in     lines of the server; the start of a connection to it
//   out    texts for consoles: states that replace each other, and a log of events; parts of pages,
//          which only who has asked for them gets
//   invariants
//          a line is taken whole or not at all. The server sends all its state to every new
//          connection: events that are known already are not published again
//          without the server the newest lines of a run stay, marked by the broken link, because
//          its further course is not known
//   bound  kMaxScenarios scenarios of kListMax_bytes in all; kEventsMax events of a run
//   errors Problem with the member as place; counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/json_value.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::bench {

// One text for all consoles; its type is also a member of the text.
struct Reported {
  std::string type, text;
  bool line = false;  // true: a line of a log; false: a state
};

struct BenchCounters {
  std::uint64_t taken = 0, refused = 0;  // lines of the server
};

class BenchState {
 public:
  static constexpr std::size_t kMaxScenarios = 1'000, kListMax_bytes = 1 << 20;
  static constexpr std::size_t kEventsMax = 2'000;

  void connected();
  Result<bool, Problem> take(std::string_view line);
  // Returns and removes the texts that are new since the last call.
  std::vector<Reported> news();
  // Returns and removes the server's newest refusal.
  std::optional<Problem> refusal() { return std::exchange(refusal_, std::nullopt); }

  // Returns and removes the newest part of a page.
  std::optional<json::JsonValue> page_part() { return std::exchange(page_part_, std::nullopt); }

  std::size_t scenarios() const { return scenarios_; }
  bool complete() const { return complete_; }  // all scenarios have been received
  const BenchCounters& counters() const { return counters_; }

 private:
  Result<bool, Problem> keep(const json::JsonValue& value, std::string_view line);
  Result<bool, Problem> keep_hello(const json::JsonValue& value);
  Result<bool, Problem> keep_scenario(std::string_view line);
  Result<bool, Problem> keep_sweeps(std::string_view line);
  Result<bool, Problem> keep_run(const json::JsonValue& value, std::string_view line);
  Result<bool, Problem> keep_event(const json::JsonValue& value, std::string_view line);
  void publish(const std::string& type, std::string_view of, bool line = false);

  std::string server_;  // its identity, from hello
  double run_ = 0.0;    // number of its newest run
  std::string list_;    // scenarios, as JSON
  std::size_t scenarios_ = 0, announced_ = 0;
  bool complete_ = false;
  std::size_t events_ = 0, events_again_ = 0;  // of this run: known, repeated by the server
  std::vector<Reported> news_;
  std::optional<Problem> refusal_;
  std::optional<json::JsonValue> page_part_;
  BenchCounters counters_;
};

}  // namespace pitwall::publishers::bench
