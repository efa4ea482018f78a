// Bench server without sockets and processes: list of scenarios, state of the current run, messages
// for each client.
//   in     lines of clients; progress lines of the run; how its process ended
//   out    lines for the requesting client, lines for all; a run to start, a request to stop it
//   invariants
//          one run at a time; a second start is refused with a reason
//          a new client receives everything that the others have: the scenarios, the newest run,
//          its plan, its events, its newest state, its result; the sweeps
//          a process that ends without a result counts as crashed, and the reason says so
//   bound  the newest kEventsKept events of a run are kept for new clients
//   errors client errors are sent to that client and counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hil/cli/bench_server/bench_request.hpp"
#include "hil/cli/bench_server/catalogue.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench_server {

// A run whose process has to be started.
struct Start {
  std::uint64_t run = 0;  // from 1
  std::string file;
  std::uint64_t seed = 0;
  bool live = false;
};

struct Answer {
  std::vector<std::string> to_asker, to_all;
  std::optional<Start> start;
  bool stop = false;
  std::optional<PageRequest> page = {};  // to be read for who asks
};

struct BenchServerCounters {
  std::uint64_t refused = 0;    // refused lines of clients
  std::uint64_t malformed = 0;  // malformed lines of runs
};

// How a process ended: exit code, or the signal that ended it.
struct Ending {
  int code = 0, signal = 0;
  std::string page = {};  // of the run, as clients ask for it; empty: it has left none
};

class BenchServer {
 public:
  static constexpr std::size_t kEventsKept = 2'000;

  // `identity` of this process, by which a client detects a restarted server.
  explicit BenchServer(std::vector<Listed> scenarios, std::string identity = "server")
      : scenarios_(std::move(scenarios)), identity_(std::move(identity)) {}

  std::vector<std::string> greeting() const;
  Answer receive(std::string_view line);

  // `folder`: output folder of the run.
  std::vector<std::string> started(std::string folder);
  std::vector<std::string> not_started(const Problem& problem);
  // Takes one progress line of the run; returns no line if it is malformed.
  std::vector<std::string> progressed(std::string_view line);
  std::vector<std::string> ended(const Ending& ending);
  // Line for the client that asked for a page.
  std::string page_refused(const PageRequest& request, const Problem& problem);
  // Takes the sweeps that there are (sweep_list.hpp); returns no line if they are as before.
  std::vector<std::string> swept(std::string line);

  bool running() const { return run_ && run_->state == "running"; }
  std::uint64_t run() const { return runs_; }  // number of the newest one
  const std::vector<Listed>& scenarios() const { return scenarios_; }
  const BenchServerCounters& counters() const { return counters_; }

 private:
  struct Run {
    Start start;
    std::string id, name, by, stopped_by, folder, state, why;
    std::optional<Ending> ending;
    std::string plan, at, result;  // the newest line of each
    std::deque<std::string> events;
  };

  Answer start(const StartRunRequest& request);
  Answer stop(const StopRunRequest& request);
  Answer refuse(const Problem& problem);
  std::string run_text() const;

  std::vector<Listed> scenarios_;
  std::string identity_;
  std::string sweeps_;
  std::optional<Run> run_;
  std::uint64_t runs_ = 0;
  BenchServerCounters counters_;
};

}  // namespace pitwall::bench_server
