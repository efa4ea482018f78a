// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/recording_folder.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "hil/replay/recordings/merge.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {

Result<traffic::Recording, Problem> read_traffic(const std::string& path) {
  std::vector<std::string> files{path};
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    auto segments = recorder::segments_of(path);
    if (!segments) return Unexpected{segments.error()};
    if (segments->empty()) return Unexpected{Problem{path, "no recording is in this folder"}};
    files = *std::move(segments);
  }
  std::vector<traffic::MergeInput> inputs;
  for (const std::string& file : files) {
    auto bytes = transport::read_file(file);
    if (!bytes) return Unexpected{bytes.error()};
    auto recording = traffic::read_recording(*std::move(bytes), file);
    if (!recording) return Unexpected{recording.error()};
    inputs.push_back({.recording = *std::move(recording)});
  }
  return traffic::merge(std::move(inputs));
}

}  // namespace pitwall::cli
