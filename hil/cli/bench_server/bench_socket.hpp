// Socket of the bench server: serves clients and runs each scenario as a child process.
//   in     socket path; the command that runs a scenario; the output folder of the runs; the folder
//          of sweeps, which is read again every kSweepsPeriod
//   out    messages of PROTOCOL.md, pages among them
//   invariants
//          each run is a process of its own: its crash does not affect the server and its clients.
//          It ends with the server, however that ends
//          a stop sends SIGTERM, and after kStopLimit SIGKILL to the whole run
//   bound  kMaxClients; a further client gets an error message and is disconnected
//   errors open(): Problem of the socket or the folder; later errors are sent to clients
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/live/process_supervisor.hpp"
#include "hil/cli/bench_server/bench_server.hpp"
#include "hil/cli/bench_server/page_files.hpp"
#include "hil/cli/bench_server/progress_tail.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/stream/line_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench_server {

inline constexpr std::size_t kMaxClients = 16;

struct ServerPlan {
  std::string socket, scenarios, runs;
  std::string sweeps = {};  // folder of sweeps
  // Program and arguments of a run, with its report folder and its progress file.
  std::function<std::vector<std::string>(const Start&, const std::string& report,
                                         const std::string& progress)>
      command;
};

class BenchSocket {
 public:
  static constexpr Duration kTurn = milliseconds(50);
  // A live run itself waits for the end of its processes.
  static constexpr Duration kStopLimit = bench::ProcessSupervisor::kStopLimit + seconds(10);
  static constexpr Duration kSweepsPeriod = seconds(2);

  static Result<BenchSocket, Problem> open(ServerPlan plan);

  // One turn: waits until the deadline, an event or a readable `stop`, then handles all events.
  void serve(Instant deadline, int stop = -1);
  const BenchServer& server() const { return server_; }
  std::size_t clients() const { return clients_.size(); }

 private:
  struct Running {
    transport::Process process;
    ProgressTail tail;
    std::optional<Instant> kill_at;
  };

  BenchSocket(ServerPlan plan, std::vector<Listed> scenarios, transport::LineListener listener);
  void greet_new_clients();
  void receive();
  void follow_run(Instant now);
  void follow_sweeps(Instant now);
  void begin(const Start& start);
  void stop_run();
  std::string page_answer(const PageRequest& request);
  void publish(const std::vector<std::string>& lines);

  ServerPlan plan_;
  PageFolders pages_;
  BenchServer server_;
  transport::LineListener listener_;
  std::list<transport::LineSocket> clients_;
  std::optional<Running> running_;
  Instant sweeps_due_{};
};

}  // namespace pitwall::bench_server
