// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/bench_perception.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "hil/sweep/in_parallel.hpp"
#include "hil/track_file/track_map_file.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/perception/detection_table.hpp"
#include "tests/benchmarks/perception/detector_cost.hpp"

namespace pitwall::benchmarks {
namespace {

using perception::PillarDetector, perception_bench::DetectorRow, perception_bench::SceneSet;

constexpr unsigned kAtATime = 2;

Result<std::optional<PillarDetector>, Problem> network_of(const std::string& file) {
  return PillarDetector::read(file,
                              [](const std::string& path) { return transport::read_file(path); });
}

// Each set with a network of its own: one serves one thread.
Result<std::vector<DetectorRow>, Problem> detect_all(const std::vector<SceneSet>& sets,
                                                     const std::string& network_file) {
  std::vector<std::optional<PillarDetector>> networks;
  std::vector<world::TrackMap> tracks;
  for (const SceneSet& set : sets) {
    auto track = track_file::read_track_map(set.track_file);
    if (!track) return Unexpected{track.error()};
    auto network = network_of(network_file);
    if (!network) return Unexpected{network.error()};
    tracks.push_back(std::move(*track)), networks.push_back(*std::move(network));
  }
  std::vector<std::vector<DetectorRow>> found(sets.size());
  sweep::in_parallel(sets.size(), kAtATime, [&](std::size_t i) {
    found[i] = perception_bench::detect_scenes(sets[i], tracks[i], std::move(networks[i]));
  });
  std::vector<DetectorRow> rows;
  for (const auto& of_set : found) rows.insert(rows.end(), of_set.begin(), of_set.end());
  return rows;
}

}  // namespace

int bench_perception(std::span<const std::string> args) {
  std::string json_file, error_file, network_file = perception::kPillarNetworkFile;
  std::size_t scenes = 400;
  std::uint64_t seed = 1'000;
  CommandLine app{"pitwall-benchmarks perception: LiDAR detectors on drawn scenes"};
  app.option("--json", json_file, "write scores and gates here");
  app.option("--errors", error_file, "write those of the first detector here (YAML)");
  app.option("--network", network_file, "of the LiDAR (ONNX); \"\": clusters alone");
  app.option("--scenes", scenes, "of each set").range(1, 100'000);
  app.option("--seed", seed, "of the first scene").range(0, 1'000'000);
  if (const auto code = app.ended_by(args)) return *code;
  const std::vector<SceneSet> sets = perception_bench::scene_sets(scenes, seed);
  const auto rows = detect_all(sets, network_file);
  if (!rows) return refuse(rows.error());
  const auto track = track_file::read_track_map(sets.front().track_file);
  if (!track) return refuse(track.error());
  auto network = network_of(network_file);
  if (!network) return refuse(network.error());
  const auto measured =
      perception_bench::measure_cost(sets.front().shape, *track, *std::move(network), seed);
  cost::CostGates gates = gates_of(measured);
  if (!network_file.empty()) {
    perception_bench::add_gates(rows->front().score, gates);
    const auto among_decoys = std::ranges::find(*rows, sets.back().name, &DetectorRow::set);
    perception_bench::add_decoy_gate(among_decoys->score, gates);
  }
  std::printf("%s%s%s%s\n", perception_bench::to_text(*rows).c_str(),
              perception_bench::to_text(measured).c_str(), gates.text().c_str(),
              cost::machine_name().c_str());
  if (!error_file.empty()) {
    const auto written =
        transport::write_file(error_file, perception_bench::error_file(rows->front()));
    if (!written) return refuse(written.error());
  }
  if (!json_file.empty()) {
    const std::string json = json::Object{}
                                 .text("bench", "perception")
                                 .flag("simulation", true)
                                 .number("seed", seed)
                                 .text("machine", cost::machine_name())
                                 .json("rows", perception_bench::to_json(*rows))
                                 .json("cost_gates", gates.json())
                                 .flag("held", gates.held())
                                 .str();
    const auto written = transport::write_file(json_file, json + "\n");
    if (!written) return refuse(written.error());
  }
  return gates.held() ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
