// Socket of the bench server: clients in, runs as child processes, their progress out.
//   in     socket path; the command that runs a scenario; the folder for what runs leave
//   out    PROTOCOL.md
//   invariants
//          a run is a process of its own: one that crashes leaves the server and its clients alone.
//          It ends with the server, however that ends
//          a stop is SIGTERM, and SIGKILL to the whole run after kStopLimit
//   bound  kMaxClients; who is one too many is told and hung up on
//   errors Problem of the socket or the folder; everything later is told to clients
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "hil/cli/bench_server/bench_server.hpp"
#include "hil/cli/bench_server/progress_tail.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/stream/line_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench_server {

inline constexpr std::size_t kMaxClients = 16;

struct ServerPlan {
  std::string socket, scenarios, runs;
  // Program and arguments for a run; its report folder and its progress file.
  std::function<std::vector<std::string>(const Start&, const std::string& report,
                                         const std::string& progress)>
      command;
};

class BenchSocket {
 public:
  static constexpr Duration kTurn = milliseconds(50), kStopLimit = seconds(5);

  static Result<BenchSocket, Problem> open(ServerPlan plan);

  // One turn: waits until the deadline or until something happens or `stop` is readable.
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
  void welcome();
  void receive();
  void follow_run(Instant now);
  void begin(const Start& start);
  void publish(const std::vector<std::string>& lines);

  ServerPlan plan_;
  BenchServer server_;
  transport::LineListener listener_;
  std::list<transport::LineSocket> clients_;
  std::optional<Running> running_;
};

}  // namespace pitwall::bench_server
