// Loader of a shipped track file.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "vehicle/parameters/track_file.hpp"

namespace pitwall::track_file {

inline world::TrackDescription shipped_track(const std::string& name) {
  std::ifstream file(std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/tracks/" + name);
  std::stringstream text;
  text << file.rdbuf();
  const auto read = parameters::read_track(text.str(), name);
  if (!read) throw std::runtime_error(to_string(read.error()));
  return *read;
}

}  // namespace pitwall::track_file
