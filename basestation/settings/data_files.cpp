// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/data_files.hpp"

#include <system_error>

namespace pitwall::settings {

std::filesystem::path data_folder(const char* beside, const char* in_tree,
                                  const std::string& file) {
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto folder = program.parent_path() / beside;
  if (!none && std::filesystem::exists(folder / file, none)) return folder;
  return std::filesystem::path{PITWALL_SOURCE_DIR} / in_tree;
}

std::string track_file(const std::string& track) {
  if (track.find('/') != std::string::npos || track.ends_with(".yaml")) return track;
  const std::string file = track + ".yaml";
  return data_folder("tracks", "vehicle/config/tracks", file) / file;
}

}  // namespace pitwall::settings
