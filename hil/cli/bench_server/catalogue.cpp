// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/catalogue.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "hil/bench/fault_plan.hpp"
#include "hil/bench/signals.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench_server {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kEnding = ".yaml";
constexpr std::size_t kMaxScenarioBytes = 1 << 20;

}  // namespace

std::string description_of(std::string_view text) {
  std::string description;
  while (text.starts_with('#')) {
    std::string_view line = text.substr(1, text.find('\n') - 1);
    text.remove_prefix(std::min(text.size(), line.size() + 2));
    while (line.starts_with(' ')) line.remove_prefix(1);
    if (!description.empty() && !line.empty()) description += ' ';
    description += line;
  }
  return description;
}

Listed listed(const std::string& id, const std::string& file, const std::string& text) {
  Listed row{.id = id, .file = file, .name = id, .description = description_of(text)};
  const auto scenario = scenario::read_scenario(text, file);
  if (!scenario) {
    row.problem = to_string(scenario.error());
    return row;
  }
  row.name = scenario->name;
  row.track = scenario->track_file;
  row.car = scenario->car_file;
  row.duration_s = scenario->duration.seconds();
  row.seed = scenario->seed;
  for (const scenario::Fault& fault : scenario->faults) row.faults.push_back(fault.kind);
  const auto can = [&](bench::BenchMode mode) {
    return !bench::refused_by(mode, scenario->faults) && !bench::unjudged_by(mode, *scenario);
  };
  row.lockstep = can(bench::BenchMode::kLockstep);
  row.live = can(bench::BenchMode::kLive) && !scenario->receivers;
  const auto expectations = bench::expectations_of(*scenario);
  if (!expectations) {
    row.problem = to_string(expectations.error());
    return row;
  }
  for (const grading::Expectation& one : *expectations)
    row.expect.push_back(grading::to_string(one));
  return row;
}

Result<std::vector<Listed>, Problem> list_scenarios(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> ids;
  for (fs::recursive_directory_iterator at{folder, error}, end; !error && at != end;
       at.increment(error)) {
    if (!at->is_regular_file() || at->path().extension() != kEnding) continue;
    std::string id = at->path().lexically_relative(folder).string();
    id.resize(id.size() - kEnding.size());
    ids.push_back(std::move(id));
  }
  if (error) return Unexpected{Problem{folder, error.message()}};
  std::ranges::sort(ids);
  if (ids.size() > kMaxScenarios) ids.resize(kMaxScenarios);
  std::vector<Listed> rows;
  for (const std::string& id : ids) {
    const std::string file = (fs::path(folder) / id).string() + std::string{kEnding};
    const auto text = transport::read_file(file, kMaxScenarioBytes);
    if (text) {
      rows.push_back(listed(id, file, *text));
    } else {
      rows.push_back({.id = id, .file = file, .name = id, .problem = to_string(text.error())});
    }
  }
  return rows;
}

}  // namespace pitwall::bench_server
