// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/live_run.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hil/bench/live/live.hpp"
#include "hil/bench/live/machine.hpp"
#include "hil/bench/live/run_keys.hpp"
#include "hil/cli/live/car_plans.hpp"
#include "hil/cli/live/clock_place.hpp"
#include "hil/cli/live/timing_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

// Folder and keys of one car. Returns the keys as long as they are needed.
Result<std::optional<bench::RunKeys>, Problem> prepare(bench::LivePlan& plan,
                                                       const std::string& given_keys) {
  std::error_code error;
  fs::create_directories(plan.folder, error);
  if (error) return Unexpected{Problem{plan.folder, error.message()}};
  std::optional<bench::RunKeys> keys;
  if (!plan.has_base() || (plan.attached() && given_keys.empty())) return keys;
  auto made = bench::keys_of_run(plan, given_keys);
  if (!made) return Unexpected{made.error()};
  plan.keys = keys.emplace(*std::move(made)).folder;
  return keys;
}

bench::StationCar station_car(const bench::LivePlan& plan, int number, const std::string& name) {
  bench::StationCar car = bench::station_car_of(plan);
  car.number = number;
  car.name = name;
  for (std::string* const file : {&car.keys, &car.json, &car.command_socket})
    if (!file->empty()) *file = fs::absolute(*file).string();
  return car;
}

// The cars file of a base station that serves several.
Result<bool, Problem> write_cars(const bench::Loaded& loaded,
                                 std::span<const bench::LivePlan> plans) {
  if (plans.front().cars_file.empty()) return true;
  std::vector<bench::StationCar> cars{station_car(plans.front(), kOurNumber, "own")};
  for (std::size_t i = 0; i < loaded.stacks.size(); ++i) {
    const bench::LoadedStack& other = loaded.stacks[i];
    cars.push_back(station_car(plans[i + 1], other.number, other.name));
  }
  return transport::write_file(plans.front().cars_file, bench::cars_text(cars));
}

// What is left on the disk that was full goes where it would have been.
std::optional<Problem> copy_out(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  return error ? std::optional{Problem{from, error.message()}} : std::nullopt;
}

std::optional<Problem> open_logs(const RunOptions& options, const bench::Loaded& loaded,
                                 std::vector<bench::LivePlan>& plans, const std::string& own) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    auto log = sink_to(i == 0 ? own : file_of(loaded.stacks[i - 1].name, options.log_file));
    if (!log) return log.error();
    plans[i].log = *std::move(log);
  }
  return std::nullopt;
}

bench::RunResult joined(std::vector<bench::LiveResult> lives, const bench::Loaded& loaded) {
  std::vector<bench::RunResult> results;
  std::vector<std::string> names;
  for (bench::LiveResult& live : lives) results.push_back(std::move(live.run));
  for (const bench::LoadedStack& other : loaded.stacks) names.push_back(other.name);
  return bench::with_others(std::move(results), names);
}

void tell_timing(std::span<const bench::LiveResult> lives, const bench::Loaded& loaded) {
  const bench::RealTime& time = *lives.front().run.real_time;
  std::printf("%s%s%s", timing_text(lives.front()).c_str(), waits_text(time).c_str(),
              stolen_text(time).c_str());
  for (std::size_t i = 1; i < lives.size(); ++i)
    std::printf("car %s: %s", loaded.stacks[i - 1].name.c_str(), reports_text(lives[i]).c_str());
}

}  // namespace

Result<recording::Sink, Problem> sink_to(const std::string& path) {
  if (path.empty()) return recording::Sink{};
  auto file = transport::AppendWriter::open(path, transport::AppendWriter::Start::kTruncate);
  if (!file) return Unexpected{file.error()};
  const auto shared = std::make_shared<transport::AppendWriter>(*std::move(file));
  return recording::Sink{
      [shared](std::span<const std::uint8_t> bytes) { return shared->write(bytes); }};
}

Result<bench::RunResult, Problem> run_live(const RunOptions& options, const bench::Loaded& loaded,
                                           const bench::Follow& follow) {
  auto plans = plans_of(options, loaded);
  if (!plans) return Unexpected{plans.error()};
  std::vector<std::optional<bench::RunKeys>> keys;  // as long as the run
  for (bench::LivePlan& plan : *plans) {
    auto made = prepare(plan, options.keys.empty() ? "" : plan.keys);
    if (!made) return Unexpected{made.error()};
    keys.push_back(*std::move(made));
  }
  if (const auto written = write_cars(loaded, *plans); !written) return Unexpected{written.error()};
  bench::LivePlan& own = plans->front();
  std::string log_file = options.log_file;
  if (!own.disk.empty()) {
    if (const auto mounted = bench::mount_disk(own.disk); !mounted)
      return Unexpected{mounted.error()};
    log_file = own.disk + "/events.mcap";
  }
  if (auto problem = open_logs(options, loaded, *plans, log_file)) return Unexpected{*problem};
  own.follow = follow;
  const ClockPlace clock = clock_place(options.clock, options.attach);
  own.clock_line = clock.line;
  for (bench::LivePlan& plan : *plans) plan.clock = clock.file;
  if (!clock.file.empty()) {
    if (const auto used = transport::use_clock(clock.file); !used) return Unexpected{used.error()};
  }
  auto results = bench::run_live(loaded, *plans);
  std::error_code none;
  if (clock.is_own) fs::remove(clock.file, none);
  if (!results) return Unexpected{results.error()};
  if (!own.disk.empty() && !options.log_file.empty())
    if (auto problem = copy_out(log_file, options.log_file)) return Unexpected{*problem};
  if (!options.quiet) tell_timing(*results, loaded);
  bench::RunResult result = joined(*std::move(results), loaded);
  if (!result.timely() && result.passed())
    result.remarks.push_back(bench::late_text(*result.real_time));
  return result;
}

}  // namespace pitwall::cli
