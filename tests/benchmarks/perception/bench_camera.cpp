// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/bench_camera.hpp"

#include <cstdio>
#include <vector>

#include "hil/track_file/track_map_file.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/perception/camera_run.hpp"

namespace pitwall::benchmarks {

int bench_camera(std::span<const std::string> args) {
  std::string json_file, network_file = perception::kCameraNetworkFile;
  std::size_t images = 400;
  std::uint64_t seed = 1'000;
  CommandLine app{"pitwall-benchmarks camera: its detector on drawn images"};
  app.option("--json", json_file, "write scores and gates here");
  app.option("--network", network_file, "of the camera (ONNX)");
  app.option("--images", images, "of each set").range(1, 100'000);
  app.option("--seed", seed, "of the first image").range(0, 1'000'000);
  if (const auto code = app.ended_by(args)) return *code;
  auto detector = perception::CameraDetector::read(
      network_file, [](const std::string& path) { return transport::read_file(path); });
  if (!detector) return refuse(detector.error());
  if (!*detector) return refuse(Problem{"--network", "expected a file"});
  cost::CostGates gates;
  std::string text;
  json::Array rows;
  for (const perception_bench::SceneSet& set : perception_bench::scene_sets(images, seed)) {
    const auto track = track_file::read_track_map(set.track_file);
    if (!track) return refuse(track.error());
    const auto score = perception_bench::look_at_images(set, *track, **detector);
    if (text.empty()) {
      perception_bench::add_gates(score, gates);
      perception_bench::add_gates(perception_bench::measure_image_cost(set, *track, **detector),
                                  gates);
    }
    if (set.rules.decoys != sensors::DecoySet::kNone)
      perception_bench::add_decoy_gate(score, gates);
    text += perception_bench::to_text(set.name, score);
    rows.json(perception_bench::to_json(set.name, score));
  }
  std::printf("%s%s%s\n", text.c_str(), gates.text().c_str(), cost::machine_name().c_str());
  if (!json_file.empty()) {
    const std::string json = json::Object{}
                                 .text("bench", "camera")
                                 .flag("simulation", true)
                                 .number("seed", seed)
                                 .text("machine", cost::machine_name())
                                 .json("rows", rows.str())
                                 .json("gates", gates.json())
                                 .flag("held", gates.held())
                                 .str();
    const auto written = transport::write_file(json_file, json + "\n");
    if (!written) return refuse(written.error());
  }
  return gates.held() ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
