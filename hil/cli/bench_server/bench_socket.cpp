// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/bench_socket.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <system_error>

#include "hil/cli/bench_server/sweep_list.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::bench_server {
namespace {

constexpr const char* kFull = R"({"type": "error", "place": "server", "what": "too many clients"})";

}  // namespace

BenchSocket::BenchSocket(ServerPlan plan, std::vector<Listed> scenarios,
                         transport::LineListener listener)
    : plan_(std::move(plan)),
      pages_{.runs = plan_.runs, .sweeps = plan_.sweeps},
      server_(std::move(scenarios), "server " + std::to_string(transport::monotonic_now().ns)),
      listener_(std::move(listener)) {}

Result<BenchSocket, Problem> BenchSocket::open(ServerPlan plan) {
  auto scenarios = list_scenarios(plan.scenarios);
  if (!scenarios) return Unexpected{scenarios.error()};
  std::error_code error;
  std::filesystem::create_directories(plan.runs, error);
  if (error) return Unexpected{Problem{plan.runs, error.message()}};
  auto listener = transport::LineListener::open(plan.socket);
  if (!listener) return Unexpected{listener.error()};
  return BenchSocket{std::move(plan), *std::move(scenarios), *std::move(listener)};
}

void BenchSocket::serve(Instant deadline, int stop) {
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
  follow_sweeps(transport::monotonic_now());
  greet_new_clients();
  receive();
  follow_run(transport::monotonic_now());
  std::erase_if(clients_, [](const auto& client) { return client.closed(); });
}

void BenchSocket::greet_new_clients() {
  while (auto client = listener_.accept()) {
    if (clients_.size() >= kMaxClients) {
      client->send(kFull);
      continue;
    }
    for (const std::string& line : server_.greeting()) client->send(line);
    clients_.push_back(*std::move(client));
  }
}

void BenchSocket::receive() {
  for (transport::LineSocket& client : clients_) {
    for (const std::string& line : client.receive()) {
      const Answer answer = server_.receive(line);
      for (const std::string& reported : answer.to_asker) client.send(reported);
      publish(answer.to_all);
      if (answer.page) client.send(page_answer(*answer.page));
      if (answer.start) begin(*answer.start);
      if (answer.stop) stop_run();
    }
  }
}

void BenchSocket::stop_run() {
  if (!running_) return;
  running_->process.kill(SIGTERM);
  running_->kill_at = transport::monotonic_now() + kStopLimit;
}

std::string BenchSocket::page_answer(const PageRequest& request) {
  const auto line = page_line(pages_, request);
  return line ? *line : server_.page_refused(request, line.error());
}

void BenchSocket::begin(const Start& start) {
  const std::string folder = plan_.runs + "/" + std::to_string(start.run);
  const std::string progress = folder + "/progress.jsonl";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  // A server that was here before may have left a run of this number.
  for (const std::string& file : {progress, folder + "/report.html"})
    if (!error) std::filesystem::remove(file, error);
  if (error) return publish(server_.not_started({folder, error.message()}));
  auto process = transport::Process::spawn(
      {.argv = plan_.command(start, folder, progress), .own_group = true});
  if (!process) return publish(server_.not_started(process.error()));
  publish(server_.started(folder));
  running_.emplace(Running{*std::move(process), ProgressTail{progress}, std::nullopt});
}

void BenchSocket::follow_run(Instant now) {
  if (!running_) return;
  if (running_->kill_at && now >= *running_->kill_at) running_->process.kill(SIGKILL);
  // In this order: what a run told before it ended is read after it ended.
  const auto status = running_->process.poll();
  std::vector<std::string> lines;
  do {
    lines = running_->tail.read();
    for (const std::string& line : lines) publish(server_.progressed(line));
  } while (status && !lines.empty());
  if (!status) return;
  running_.reset();
  const std::string page = page_of_run(std::to_string(server_.run()));
  publish(server_.ended({.code = status->code,
                         .signal = status->signal,
                         .page = has_page(pages_, page) ? page : ""}));
}

void BenchSocket::follow_sweeps(Instant now) {
  if (now < sweeps_due_) return;
  sweeps_due_ = now + kSweepsPeriod;
  publish(server_.swept(sweeps_line(pages_)));
}

void BenchSocket::publish(const std::vector<std::string>& lines) {
  for (transport::LineSocket& client : clients_)
    for (const std::string& line : lines) client.send(line);
}

}  // namespace pitwall::bench_server
