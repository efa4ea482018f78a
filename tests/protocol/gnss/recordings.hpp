// Reader of the public NovAtel recordings beside the project.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/public_data.hpp"

namespace pitwall::gnss {

inline std::string recordings_folder() { return (recordings::folder() / "gnss" / "").string(); }

inline std::optional<std::vector<std::uint8_t>> recording(const std::string& name) {
  std::ifstream in{recordings_folder() + name, std::ios::binary};
  if (!in) return std::nullopt;
  return std::vector<std::uint8_t>{std::istreambuf_iterator<char>{in}, {}};
}

// Lines of a JSON-lines file. number_after() is enough of a parser for flat numbers: it reads the
// number after "key": .
inline std::vector<std::string> recorded_lines(const std::string& name) {
  std::ifstream in{recordings_folder() + name};
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

inline double number_after(const std::string& line, const std::string& key) {
  const std::size_t at = line.find("\"" + key + "\": ");
  if (at == std::string::npos) return std::nan("");
  return std::stod(line.substr(at + key.size() + 4));
}

}  // namespace pitwall::gnss
