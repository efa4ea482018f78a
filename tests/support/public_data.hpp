// The public recordings that lie beside the project, never in it. A test that reads one skips with
// a message where it is missing.
//   in     PITWALL_SHARED_DATA, else shared/data beside the source tree
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace pitwall::recordings {

inline std::filesystem::path folder() {
  if (const char* named = std::getenv("PITWALL_SHARED_DATA")) return named;
  return std::filesystem::path(PITWALL_SOURCE_DIR) / ".." / "shared" / "data";
}

// The rows of a gzipped table of numbers, without those that begin with '#'; none if it is missing.
inline std::vector<std::vector<double>> gzipped_table(const std::filesystem::path& path,
                                                      char separator) {
  std::vector<std::vector<double>> rows;
  if (!std::filesystem::exists(path)) return rows;
  FILE* pipe = popen(("zcat '" + path.string() + "'").c_str(), "r");
  if (pipe == nullptr) return rows;
  std::array<char, 1024> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    if (line[0] == '#') continue;
    std::stringstream fields(line.data());
    std::vector<double>& row = rows.emplace_back();
    for (std::string field; std::getline(fields, field, separator);)
      row.push_back(std::stod(field));
  }
  pclose(pipe);
  return rows;
}

}  // namespace pitwall::recordings
