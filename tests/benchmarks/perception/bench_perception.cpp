// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/bench_perception.hpp"

#include <array>
#include <cstdio>
#include <vector>

#include "hil/sweep/in_parallel.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/perception/detection_table.hpp"
#include "tests/benchmarks/perception/detector_cost.hpp"

namespace pitwall::benchmarks {
namespace {

using perception_bench::DetectorRow, perception_bench::SceneSet;

constexpr unsigned kAtATime = 2;

std::vector<SceneSet> sets_of(std::size_t scenes, std::uint64_t seed) {
  return {{"held back: SF23 at IMS, dust x 2", "vehicle/config/tracks/ims.yaml",
           sensors::sf23_shape(), 2.0, scenes, seed},
          {"known: AV-21 at LVMS, dust", "vehicle/config/tracks/lvms.yaml", sensors::av21_shape(),
           1.0, scenes, seed}};
}

Result<std::vector<DetectorRow>, Problem> detect_all(const std::vector<SceneSet>& sets) {
  std::vector<world::TrackMap> tracks;
  for (const SceneSet& set : sets) {
    auto track = perception_bench::read_map(set.track_file);
    if (!track) return Unexpected{track.error()};
    tracks.push_back(std::move(*track));
  }
  std::vector<std::vector<DetectorRow>> found(sets.size());
  sweep::in_parallel(sets.size(), kAtATime, [&](std::size_t i) {
    found[i] = perception_bench::detect_scenes(sets[i], tracks[i]);
  });
  std::vector<DetectorRow> rows;
  for (const auto& of_set : found) rows.insert(rows.end(), of_set.begin(), of_set.end());
  return rows;
}

}  // namespace

int bench_perception(std::span<const std::string> args) {
  std::string json_file;
  std::size_t scenes = 400;
  std::uint64_t seed = 1'000;
  CommandLine app{"pitwall-benchmarks perception: LiDAR detectors on drawn scenes"};
  app.option("--json", json_file, "write scores and gates here");
  app.option("--scenes", scenes, "of each set").range(1, 100'000);
  app.option("--seed", seed, "of the first scene").range(0, 1'000'000);
  if (const auto code = app.ended_by(args)) return *code;
  const std::vector<SceneSet> sets = sets_of(scenes, seed);
  const auto rows = detect_all(sets);
  if (!rows) return refuse(rows.error());
  const auto track = perception_bench::read_map(sets.front().track_file);
  if (!track) return refuse(track.error());
  const auto measured = perception_bench::measure_cost(sets.front().shape, *track, seed);
  const cost::CostGates gates = gates_of(measured);
  std::printf("%s%s%s%s\n", perception_bench::to_text(*rows).c_str(),
              perception_bench::to_text(measured).c_str(), gates.text().c_str(),
              cost::machine_name().c_str());
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
