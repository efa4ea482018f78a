// Subcommand `pitwall-hil scenes FOLDER --track FILE [--bodies av21|sf23|drawn] [--scenes N]
// [--seed N] [--dust X] [--spun X] [--decoys none|common|rare] [--camera [--varied]]`: drawn scenes
// for the training of the networks.
//
//   out    the arrays of hil/scenes/pillar_scenes.hpp, or of camera_scenes.hpp beside it, in
//          FOLDER, which is made
//   errors exit code 2: the track is refused, FOLDER cannot be written, wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int scenes_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
