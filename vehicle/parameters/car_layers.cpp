// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/car_layers.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace pitwall::parameters {
namespace {

// The file that a document is like, with the place of the key.
struct Like {
  std::string path, place;
};

Result<std::optional<Like>, Problem> like_of(const yaml::Document& document,
                                             const std::string& path) {
  try {
    yaml::StrictMap root = document.root();
    if (!root.has(kLikeKey)) return std::optional<Like>{};
    const std::string name = root.text(kLikeKey);
    if (name.empty()) root.fail(kLikeKey, "names no file");
    const std::filesystem::path file = std::filesystem::path{path}.parent_path() / name;
    return std::optional<Like>{{file.lexically_normal().string(), root.place(kLikeKey)}};
  } catch (const yaml::InputError& e) {
    return Unexpected{e.problem};
  }
}

bool is_among(const std::vector<CarLayer>& files, const std::string& path) {
  return std::ranges::any_of(files, [&](const CarLayer& file) {
    return std::filesystem::path{file.path}.lexically_normal().string() == path;
  });
}

}  // namespace

Result<CarLayers, Problem> read_layers(const std::string& path, const ReadFile& read_file) {
  std::vector<CarLayer> files;
  std::optional<yaml::Document> whole;
  std::optional<Like> next{{path, path}};
  while (next) {
    const std::string named = "like: " + next->path;
    if (is_among(files, next->path))
      return refuse(next->place, named + " is like this file itself; expected no circle");
    if (files.size() == kCarFilesMost)
      return refuse(next->place, named + " is file " + std::to_string(kCarFilesMost + 1) +
                                     " of a chain; expected " + std::to_string(kCarFilesMost) +
                                     " or fewer");
    auto text = read_file(next->path);
    if (!text && files.empty()) return Unexpected{text.error()};
    if (!text) return refuse(next->place, named + ": " + text.error().what);
    auto document = yaml::load_text(*text, next->path);
    if (!document) return Unexpected{document.error()};
    files.push_back({next->path, *std::move(text)});
    auto like = like_of(*document, next->path);
    if (!like) return Unexpected{like.error()};
    whole = whole ? whole->over(*document) : *std::move(document);
    next = *std::move(like);
  }
  return CarLayers{*std::move(whole), std::move(files)};
}

std::string whole_text(const CarLayers& layers) {
  std::string text;
  for (const CarLayer& file : layers.files) {
    if (!text.empty())
      text += "\n# ---- " + std::filesystem::path{file.path}.filename().string() + "\n";
    text += file.text;
  }
  return text;
}

}  // namespace pitwall::parameters
