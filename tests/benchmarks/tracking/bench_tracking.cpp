// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/bench_tracking.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "hil/sweep/in_parallel.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/tracking/tracking_cost.hpp"
#include "tests/benchmarks/tracking/tracking_table.hpp"

namespace pitwall::benchmarks {
namespace {

using tracking::Method;
using tracking_bench::Gate, tracking_bench::Scene, tracking_bench::TrackingRow;

constexpr unsigned kAtATime = 2;
constexpr std::size_t kOrders = 100;
constexpr Duration kOrdersSpan = seconds(6), kCostSpan = seconds(40);

struct TrackingJob {
  Scene scene;
  Method method;
};

tracking::Params params_of(Method method) {
  tracking::Params params;
  params.method = method;
  return params;
}

std::vector<TrackingRow> track_scenes(std::uint64_t seed) {
  std::vector<TrackingJob> jobs;
  for (Scene scene : {tracking_bench::race_scene(), tracking_bench::pair_scene(),
                      tracking_bench::blind_scene()}) {
    scene.seed = seed;
    for (const Method method : {Method::kPaper, Method::kRoad}) jobs.push_back({scene, method});
  }
  std::vector<TrackingRow> rows(jobs.size());
  sweep::in_parallel(jobs.size(), kAtATime, [&](std::size_t i) {
    rows[i] = tracking_bench::run_tracking(jobs[i].scene, params_of(jobs[i].method));
  });
  return rows;
}

}  // namespace

int bench_tracking(std::span<const std::string> args) {
  std::string json_file;
  std::uint64_t seed = 1;
  CommandLine app{"pitwall-benchmarks tracking: trackers on the same detections of other cars"};
  app.option("--json", json_file, "write rows and gates here");
  app.option("--seed", seed, "of traffic, sensors and our own errors").range(0, 1'000'000);
  if (const auto code = app.ended_by(args)) return *code;
  const std::vector<TrackingRow> rows = track_scenes(seed);
  Scene orders_scene = tracking_bench::race_scene();
  orders_scene.span = kOrdersSpan, orders_scene.seed = seed;
  const auto orders =
      tracking_bench::compare_orders(orders_scene, params_of(Method::kRoad), kOrders);
  const auto measured = tracking_bench::measure_tracking_cost(params_of(Method::kRoad), kCostSpan);
  const std::vector<Gate> gates = gates_of(rows, orders);
  const cost::CostGates cost_gates = gates_of(measured);
  std::printf("%s%s%s%s%s\n", tracking_bench::to_text(rows).c_str(),
              tracking_bench::to_text(measured).c_str(), tracking_bench::to_text(gates).c_str(),
              cost_gates.text().c_str(), cost::machine_name().c_str());
  const bool held = std::ranges::all_of(gates, &Gate::held) && cost_gates.held();
  if (!json_file.empty()) {
    const std::string json = json::Object{}
                                 .text("bench", "tracking")
                                 .flag("simulation", true)
                                 .number("seed", seed)
                                 .text("machine", cost::machine_name())
                                 .json("rows", tracking_bench::to_json(rows))
                                 .json("gates", tracking_bench::to_json(gates))
                                 .json("cost_gates", cost_gates.json())
                                 .flag("held", held)
                                 .str();
    const auto written = transport::write_file(json_file, json + "\n");
    if (!written) return refuse(written.error());
  }
  return held ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
