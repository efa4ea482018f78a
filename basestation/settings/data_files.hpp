// Locations of the files that come with the program: beside it if it is installed, otherwise in the
// source tree.
//   errors none; whoever reads a missing file reports it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace pitwall::settings {

// The folder beside the program, if it holds the file; otherwise the one in the source tree.
std::filesystem::path data_folder(const char* beside, const char* in_tree, const std::string& file);
// The named folder; without a name, the one that comes with the program.
inline std::filesystem::path console_folder(const std::string& named = {}) {
  if (!named.empty()) return named;
  return data_folder("console", "build/console/dist", "index.html");
}
// Returns a path unchanged; a name is one of the tracks that come with the program.
std::string track_file(const std::string& track);

}  // namespace pitwall::settings
