// Built files of the console, kept in memory: no part of a request is used as a path on disk.
//   in     a folder with index.html and assets/; X.gz beside X is X gzipped
//   out    by path: bytes, gzipped bytes if they are shorter, type
//   invariants
//          read again when index.html has changed on disk, so that a new build shows without a
//          restart
//   bound  kFilesMax files of kFileMax bytes; others are left out
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace pitwall::publishers::web {

struct ServedFile {
  std::shared_ptr<const std::string> bytes;
  std::shared_ptr<const std::string> gzipped;  // nullptr: not shorter
  std::string_view type;
  bool forever = false;  // may be cached for ever, because its name changes with its content
};

class ConsoleFiles {
 public:
  static constexpr std::size_t kFilesMax = 200, kFileMax = 8 * 1'024 * 1'024;

  explicit ConsoleFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const ServedFile* find(std::string_view path);  // "/" or "/assets/x.js"; nullptr: no such file
  const std::filesystem::path& folder() const { return folder_; }
  bool built() const { return files_.contains("/"); }

 private:
  void read_if_new();
  void read(const std::filesystem::path& path, const std::string& name);

  std::filesystem::path folder_;
  std::map<std::string, ServedFile, std::less<>> files_;
  std::filesystem::file_time_type read_at_{};
};

std::string_view type_of(const std::filesystem::path& path);
std::string gzip(std::string_view bytes);

}  // namespace pitwall::publishers::web
