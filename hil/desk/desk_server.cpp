// SPDX-License-Identifier: Apache-2.0
#include "hil/desk/desk_server.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <system_error>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::desk {
namespace {

constexpr const char* kFull = R"({"type": "error", "place": "desk", "what": "too many clients"})";

}  // namespace

DeskServer::DeskServer(ServerPlan plan, std::vector<Listed> scenarios,
                       transport::LineListener listener)
    : plan_(std::move(plan)),
      desk_(std::move(scenarios), "desk " + std::to_string(transport::monotonic_now().ns)),
      listener_(std::move(listener)) {}

Result<DeskServer, Problem> DeskServer::open(ServerPlan plan) {
  auto scenarios = list_scenarios(plan.scenarios);
  if (!scenarios) return Unexpected{scenarios.error()};
  std::error_code error;
  std::filesystem::create_directories(plan.runs, error);
  if (error) return Unexpected{Problem{plan.runs, error.message()}};
  auto listener = transport::LineListener::open(plan.socket);
  if (!listener) return Unexpected{listener.error()};
  return DeskServer{std::move(plan), *std::move(scenarios), *std::move(listener)};
}

void DeskServer::serve(Instant deadline, int stop) {
  FixedVector<int, transport::kMaxWatched> watched;
  CHECK(watched.push(stop));
  CHECK(watched.push(listener_.fd()));
  CHECK(watched.push(running_ ? running_->process.fd() : -1));
  for (const transport::LineSocket& client : clients_) CHECK(watched.push(client.fd()));
  const bool turning = running_ || std::ranges::any_of(clients_, [](const auto& client) {
                         return client.sending();
                       });
  const Instant next = turning ? transport::monotonic_now() + kTurn : deadline;
  static_cast<void>(transport::wait_readable(watched.span(), std::min(deadline, next)));
  welcome();
  hear();
  follow_run(transport::monotonic_now());
  std::erase_if(clients_, [](const auto& client) { return client.closed(); });
}

void DeskServer::welcome() {
  while (auto client = listener_.accept()) {
    if (clients_.size() >= kMaxClients) {
      client->send(kFull);
      continue;
    }
    for (const std::string& line : desk_.greeting()) client->send(line);
    clients_.push_back(*std::move(client));
  }
}

void DeskServer::hear() {
  for (transport::LineSocket& client : clients_) {
    for (const std::string& line : client.receive()) {
      const Answer answer = desk_.heard(line);
      for (const std::string& told : answer.to_asker) client.send(told);
      tell(answer.to_all);
      if (answer.start) begin(*answer.start);
      if (!answer.stop || !running_) continue;
      running_->process.kill(SIGTERM);
      running_->kill_at = transport::monotonic_now() + kStopLimit;
    }
  }
}

void DeskServer::begin(const Start& start) {
  const std::string folder = plan_.runs + "/" + std::to_string(start.run);
  const std::string progress = folder + "/progress.jsonl";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::filesystem::remove(progress, error);
  if (error) return tell(desk_.not_started({folder, error.message()}));
  auto process = transport::Process::spawn(
      {.argv = plan_.command(start, folder, progress), .own_group = true});
  if (!process) return tell(desk_.not_started(process.error()));
  tell(desk_.started(folder));
  running_.emplace(Running{*std::move(process), ProgressTail{progress}, std::nullopt});
}

void DeskServer::follow_run(Instant now) {
  if (!running_) return;
  if (running_->kill_at && now >= *running_->kill_at) running_->process.kill(SIGKILL);
  // In this order: what a run told before it ended is read after it ended.
  const auto status = running_->process.poll();
  std::vector<std::string> lines;
  do {
    lines = running_->tail.read();
    for (const std::string& line : lines) tell(desk_.progressed(line));
  } while (status && !lines.empty());
  if (!status) return;
  running_.reset();
  tell(desk_.ended({.code = status->code, .signal = status->signal}));
}

void DeskServer::tell(const std::vector<std::string>& lines) {
  for (transport::LineSocket& client : clients_)
    for (const std::string& line : lines) client.send(line);
}

}  // namespace pitwall::desk
