// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenes_verb.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/scenes/camera_scenes.hpp"
#include "hil/scenes/scene_set.hpp"
#include "hil/track_file/track_map_file.hpp"

namespace pitwall::cli {
namespace {

using scenes::Bodies;
using sensors::DecoySet;

template <class T>
using Named = std::array<std::pair<std::string_view, T>, 3>;

constexpr Named<Bodies> kBodies{
    {{"av21", Bodies::kAv21}, {"sf23", Bodies::kSf23}, {"drawn", Bodies::kDrawn}}};
constexpr Named<DecoySet> kDecoys{
    {{"none", DecoySet::kNone}, {"common", DecoySet::kCommon}, {"rare", DecoySet::kRare}}};

template <class T>
std::optional<T> named(const Named<T>& all, std::string_view name) {
  const auto* const found = std::ranges::find(all, name, &Named<T>::value_type::first);
  if (found == all.end()) return std::nullopt;
  return found->second;
}

}  // namespace

int scenes_verb(std::span<const std::string> args) {
  std::string folder, track, bodies = "drawn", decoys = "none";
  bool camera = false, varied = false;
  scenes::SceneSet set{.rules = {}, .scenes = 100, .seed = 1};
  CommandLine app{"pitwall-hil scenes: drawn scenes for the training of the networks"};
  app.option("FOLDER", folder, "made, with the arrays of NumPy in it").required();
  app.option("--track", track, "track file (YAML)").required();
  app.option("--bodies", bodies, "of the other cars: av21, sf23 or drawn").shows_default();
  app.option("--scenes", set.scenes, "how many").range(1, 100'000).shows_default();
  app.option("--seed", set.seed, "of the first scene").range(0, 1'000'000'000).shows_default();
  app.option("--dust", set.rules.dust, "density; 0: none").range(0.0, 10.0).shows_default();
  app.option("--spun", set.rules.spun_share, "share of cars that have spun").range(0.0, 1.0);
  app.option("--decoys", decoys, "things that are no cars: none, common or rare").shows_default();
  const VerbOption of_images =
      app.flag("--camera", camera, "images of the front cameras in place of sweeps");
  app.flag("--varied", varied, "other cameras than those of the AV-21").needs(of_images);
  if (const auto code = app.ended_by(args)) return *code;
  const auto chosen = named(kBodies, bodies);
  if (!chosen) return refuse({"--bodies " + bodies, "expected av21, sf23 or drawn"});
  set.bodies = *chosen;
  const auto standing = named(kDecoys, decoys);
  if (!standing) return refuse({"--decoys " + decoys, "expected none, common or rare"});
  set.rules.decoys = *standing;
  const auto map = track_file::read_track_map(track);
  if (!map) return refuse(map.error());
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  const auto written =
      camera ? scenes::write_camera_scenes({.bodies = set.bodies,
                                            .rules = {.dust = set.rules.dust,
                                                      .spun_share = set.rules.spun_share,
                                                      .varied = varied,
                                                      .decoys = set.rules.decoys},
                                            .scenes = set.scenes,
                                            .seed = set.seed},
                                           *map, folder, threads)
             : scenes::write_scenes(scenes::make_scenes(set, *map, threads), folder);
  if (!written) return refuse(written.error());
  std::printf("%s: %zu simulated %s of %s\n", folder.c_str(), set.scenes,
              camera ? "images" : "scenes", map->name().c_str());
  return kExitPass;
}

}  // namespace pitwall::cli
