// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/bench_server.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "protocol/json/json_text.hpp"
#include "protocol/json/json_value.hpp"

namespace pitwall::bench_server {
namespace {

using json::Array;
using json::Object;

constexpr int kProtocol = 1;

std::string texts(const std::vector<std::string>& list) {
  Array items;
  for (const std::string& text : list) items.json(json::quoted(text));
  return items.str();
}

std::string text_or_null(const std::string& text) {
  return text.empty() ? "null" : json::quoted(text);
}

std::string scenario_text(const Listed& row) {
  return Object{}
      .text("type", "scenario")
      .text("id", row.id)
      .text("name", row.name)
      .text("description", row.description)
      .number("duration_s", row.duration_s)
      .number("seed", row.seed)
      .flag("lockstep", row.lockstep)
      .flag("live", row.live)
      .json("faults", texts(row.faults))
      .json("expect", texts(row.expect))
      .json("problem", text_or_null(row.problem))
      .str();
}

// Which of several runs a line is about stands in front of its own members.
std::string of_run(std::uint64_t run, std::string_view line) {
  return "{\"run\": " + std::to_string(run) + ", " + std::string{line.substr(1)};
}

// What the exit code of `pitwall-hil run` means.
std::string state_of(const Ending& ending) {
  if (ending.signal != 0) return "crashed";
  switch (ending.code) {
    case 0:
      return "passed";
    case 1:
      return "failed";
    case 4:
      return "contact";
    default:
      return "unusable";
  }
}

}  // namespace

std::vector<std::string> BenchServer::greeting() const {
  const auto broken =
      std::ranges::count_if(scenarios_, [](const Listed& row) { return !row.problem.empty(); });
  std::vector<std::string> lines{Object{}
                                     .text("type", "hello")
                                     .number("protocol", kProtocol)
                                     .text("server", identity_)
                                     .flag("simulation", true)
                                     .number("scenarios", scenarios_.size())
                                     .number("unreadable", broken)
                                     .str()};
  for (const Listed& row : scenarios_) lines.push_back(scenario_text(row));
  if (!sweeps_.empty()) lines.push_back(sweeps_);
  if (!run_) return lines;
  lines.push_back(run_text());
  if (!run_->plan.empty()) lines.push_back(run_->plan);
  lines.insert(lines.end(), run_->events.begin(), run_->events.end());
  for (const std::string* newest : {&run_->at, &run_->result})
    if (!newest->empty()) lines.push_back(*newest);
  return lines;
}

Answer BenchServer::receive(std::string_view line) {
  const auto request = parse_request(line);
  if (!request) return refuse(request.error());
  if (const auto* const begin = std::get_if<StartRunRequest>(&*request)) return start(*begin);
  if (const auto* const page = std::get_if<PageRequest>(&*request))
    return {.to_asker = {}, .to_all = {}, .start = {}, .page = *page};
  return stop(std::get<StopRunRequest>(*request));
}

Answer BenchServer::refuse(const Problem& problem) {
  ++counters_.refused;
  return {.to_asker = {Object{}
                           .text("type", "error")
                           .text("place", problem.place)
                           .text("what", problem.what)
                           .str()},
          .to_all = {},
          .start = {}};
}

Answer BenchServer::start(const StartRunRequest& request) {
  if (running())
    return refuse({"start", "run " + std::to_string(run_->start.run) + " (" + run_->id +
                                ") is still running; stop it first"});
  const auto found = std::ranges::find(scenarios_, request.scenario, &Listed::id);
  if (found == scenarios_.end()) return refuse({"scenario", "no such scenario"});
  if (!found->problem.empty()) return refuse({"scenario", found->problem});
  if (!(request.live ? found->live : found->lockstep))
    return refuse({"mode", std::string{"this scenario needs the "} +
                               (request.live ? "lockstep" : "live") + " bench"});
  run_ = Run{.start = {.run = ++runs_,
                       .file = found->file,
                       .seed = request.seed.value_or(found->seed),
                       .live = request.live},
             .id = found->id,
             .name = found->name,
             .by = request.by,
             .stopped_by = {},
             .folder = {},
             .state = "running",
             .why = {},
             .ending = {},
             .plan = {},
             .at = {},
             .result = {},
             .events = {}};
  return {.to_asker = {}, .to_all = {}, .start = run_->start};
}

Answer BenchServer::stop(const StopRunRequest& request) {
  if (!running()) return refuse({"stop", "no run is in progress"});
  run_->stopped_by = request.by.empty() ? "somebody" : request.by;
  return {.to_asker = {}, .to_all = {run_text()}, .start = {}, .stop = true};
}

std::vector<std::string> BenchServer::started(std::string folder) {
  run_->folder = std::move(folder);
  return {run_text()};
}

std::vector<std::string> BenchServer::not_started(const Problem& problem) {
  run_->state = "unusable";
  run_->why = to_string(problem);
  return {run_text()};
}

std::vector<std::string> BenchServer::progressed(std::string_view line) {
  const auto value = json::JsonValue::parse(line, "line");
  if (!run_ || !value || !value->is_object()) {
    ++counters_.malformed;
    return {};
  }
  const std::string type = value->text("type");
  std::string reported = of_run(run_->start.run, line);
  if (type == "plan") {
    run_->plan = reported;
  } else if (type == "at") {
    run_->at = reported;
  } else if (type == "result") {
    run_->result = reported;
  } else if (type == "event") {
    run_->events.push_back(reported);
    if (run_->events.size() > kEventsKept) run_->events.pop_front();
  } else if (type == "failure") {
    run_->why = value->text("what");
    return {};  // the ending tells it
  } else {
    ++counters_.malformed;
    return {};
  }
  return {std::move(reported)};
}

std::vector<std::string> BenchServer::ended(const Ending& ending) {
  run_->ending = ending;
  run_->state = run_->stopped_by.empty() ? state_of(ending) : "stopped";
  const bool judged =
      run_->state == "passed" || run_->state == "failed" || run_->state == "contact";
  if (judged && run_->result.empty()) {
    run_->state = "crashed";
    run_->why = "it ended without a result";
  }
  if (ending.signal != 0 && run_->stopped_by.empty())
    run_->why = "signal " + std::to_string(ending.signal) + " ended it";
  return {run_text()};
}

std::string BenchServer::page_refused(const PageRequest& request, const Problem& problem) {
  ++counters_.refused;
  return Object{}
      .text("type", "page")
      .text("page", request.page)
      .number("from", request.from)
      .text("problem", to_string(problem))
      .str();
}

std::vector<std::string> BenchServer::swept(std::string line) {
  if (line == sweeps_) return {};
  sweeps_ = std::move(line);
  return {sweeps_};
}

std::string BenchServer::run_text() const {
  const Run& run = *run_;
  const std::string file = run.folder.empty() ? "" : run.folder + "/";
  const auto number_or_null = [&](int Ending::*which) {
    return run.ending ? std::to_string((*run.ending).*which) : std::string{"null"};
  };
  return Object{}
      .text("type", "run")
      .number("run", run.start.run)
      .text("state", run.state)
      .text("scenario", run.id)
      .text("name", run.name)
      .number("seed", run.start.seed)
      .text("mode", run.start.live ? "live" : "lockstep")
      .text("by", run.by)
      .json("stopped_by", text_or_null(run.stopped_by))
      .json("why", text_or_null(run.why))
      .json("exit", number_or_null(&Ending::code))
      .json("signal", number_or_null(&Ending::signal))
      .json("page", text_or_null(run.ending ? run.ending->page : ""))
      .json("report", text_or_null(file.empty() ? "" : file + "report.html"))
      .json("junit", text_or_null(file.empty() ? "" : file + "junit.xml"))
      .json("log", text_or_null(file.empty() ? "" : file + "events.mcap"))
      .str();
}

}  // namespace pitwall::bench_server
