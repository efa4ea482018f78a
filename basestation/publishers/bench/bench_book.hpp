// Newest state of a bench server for consoles: scenarios and current run, line by line. The
// protocol: hil/cli/bench_server/PROTOCOL.md.
//   in     lines of the server; that it came or went
//   out    texts for consoles: states that replace each other, and a log of events
//   invariants
//          a line is taken whole or not at all. The server tells all it knows to who connects anew:
//          an event that is known already is not told again
//          without the server nobody knows how a run goes on: its newest lines stay, marked by the
//          link that is down
//   bound  kMaxScenarios and kListMax_bytes of them; kEventsMax of a run
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

// One text for all consoles; its type is a member of it, too.
struct Reported {
  std::string type, text;
  bool line = false;  // of a log; else a state
};

struct BenchCounters {
  std::uint64_t taken = 0, refused = 0;  // lines of the server
};

class BenchBook {
 public:
  static constexpr std::size_t kMaxScenarios = 1'000, kListMax_bytes = 1 << 20;
  static constexpr std::size_t kEventsMax = 2'000;

  void connected();
  Result<bool, Problem> take(std::string_view line);
  // What is new since it was asked last.
  std::vector<Reported> news();
  // What the server refused; once.
  std::optional<Problem> refusal() { return std::exchange(refusal_, std::nullopt); }

  std::size_t scenarios() const { return scenarios_; }
  bool complete() const { return complete_; }  // every scenario has been told
  const BenchCounters& counters() const { return counters_; }

 private:
  Result<bool, Problem> keep(const json::JsonValue& value, std::string_view line);
  Result<bool, Problem> keep_hello(const json::JsonValue& value);
  Result<bool, Problem> keep_scenario(std::string_view line);
  Result<bool, Problem> keep_run(const json::JsonValue& value, std::string_view line);
  Result<bool, Problem> keep_event(const json::JsonValue& value, std::string_view line);
  void publish(const std::string& type, std::string_view of, bool line = false);

  std::string server_;  // which one it is
  double run_ = 0.0;    // its newest run
  std::string list_;    // of scenarios, as JSON
  std::size_t scenarios_ = 0, announced_ = 0;
  bool complete_ = false;
  std::size_t events_ = 0, events_again_ = 0;  // of this run: known, told again
  std::vector<Reported> news_;
  std::optional<Problem> refusal_;
  BenchCounters counters_;
};

}  // namespace pitwall::publishers::bench
