// Locations of the files that come with the program: beside it where it is installed, in the tree
// that it was built from otherwise.
//   errors none: what is not there is told by who reads it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace pitwall::settings {

// Beside the program only where it holds that file.
std::filesystem::path data_folder(const char* beside, const char* in_tree, const std::string& file);
// The folder that was named; else the one that comes with the program.
inline std::filesystem::path console_folder(const std::string& named = {}) {
  if (!named.empty()) return named;
  return data_folder("console", "build/console/dist", "index.html");
}
// A path as it is; a name is one of the tracks that come with the program.
std::string track_file(const std::string& track);

}  // namespace pitwall::settings
