// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/segment_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>

#include "protocol/recorder/file_disk.hpp"
#include "protocol/recording/mcap_recovery.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::recorder {
namespace {

bool ends_with_magic(const std::string& path) {
  using transport::posix_call;
  const transport::FileDescriptor fd{
      posix_call([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); })};
  std::array<std::uint8_t, recording::kMcapMagic.size()> last{};
  const auto end =
      posix_call([&] { return ::lseek(fd.get(), -std::int64_t{last.size()}, SEEK_END); });
  const auto got = posix_call([&] { return ::read(fd.get(), last.data(), last.size()); });
  return end && got.value == std::int64_t{last.size()} && last == recording::kMcapMagic;
}

}  // namespace

Result<std::vector<std::string>, Problem> segments_of(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator{folder, error}) {
    if (entry.path().extension() == ".mcap") paths.push_back(entry.path().string());
  }
  if (error) return Unexpected{Problem{folder, error.message()}};
  std::ranges::sort(paths);  // their names begin with their time
  return paths;
}

Result<std::string, Problem> recover_file(const std::string& path) {
  if (is_being_written(path)) return Unexpected{Problem{path, "another process is writing it"}};
  const auto file = transport::read_file(path);
  if (!file) return Unexpected{file.error()};
  const auto recovery = recording::recover_mcap(as_bytes(*file), path);
  if (!recovery) return Unexpected{recovery.error()};
  if (recovery->was_whole()) return path + ": " + to_string(*recovery);
  const bool damaged = recovery->chunks_lost + recovery->messages_lost != 0 ||
                       recovery->checksum_wrong ||
                       recovery->found == recording::McapEnd::kMalformed;
  if (damaged) {
    const auto copied = transport::write_file(path + ".damaged", *file);
    if (!copied) return Unexpected{copied.error()};
  }
  const std::string_view bytes{reinterpret_cast<const char*>(recovery->file.data()),
                               recovery->file.size()};
  const auto written = transport::write_file(path, bytes);
  if (!written) return Unexpected{written.error()};
  return path + ": " + to_string(*recovery);
}

std::vector<std::string> recover_folder(const std::string& folder) {
  std::vector<std::string> lines;
  const auto paths = segments_of(folder);
  if (!paths) return lines;
  for (const std::string& path : *paths) {
    if (ends_with_magic(path) || is_being_written(path)) continue;
    const auto line = recover_file(path);
    lines.push_back(line ? *line : to_string(line.error()));
  }
  return lines;
}

}  // namespace pitwall::recorder
