// A car file laid over those that it names with `like: FILE`: it writes only what differs.
//   in     path of the file; what reads a file by its path
//   out    CarLayers: one document for the reader, the files with their texts
//   invariants
//          FILE is relative to the folder of the file that names it; key by key the naming file
//          overrides the named one, a list as a whole, and `KEY: ~` takes a key away
//   errors Problem with file:line:column: a file that cannot be read, one that is named by itself
//          on the way, more than kCarFilesMost of them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::parameters {

using ReadFile = std::function<Result<std::string, Problem>(const std::string& path)>;

inline constexpr std::size_t kCarFilesMost = 4;
inline constexpr const char* kLikeKey = "like";

struct CarLayer {
  std::string path, text;
};

struct CarLayers {
  yaml::Document document;
  std::vector<CarLayer> files;  // in the order in which they name each other
};

Result<CarLayers, Problem> read_layers(const std::string& path, const ReadFile& read_file);

// All that the car was set up from: the text of the file, then each file that it is like under a
// comment with its name as written there.
std::string whole_text(const CarLayers& layers);

}  // namespace pitwall::parameters
