// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/reading/can_file.hpp"

#include "hil/replay/reading/progress_line.hpp"
#include "hil/replay/recordings/can_part.hpp"
#include "protocol/transport/file_bytes.hpp"

namespace pitwall::replay {

Result<CanLog, Problem> read_can_file(const std::string& path, bool shows_progress) {
  const auto file = transport::FileBytes::map(path);
  if (!file) return Unexpected{file.error()};
  ProgressLine line("reading " + path, shows_progress);
  return traffic::read_can_traffic(*file, path, {.reached = line.function()});
}

}  // namespace pitwall::replay
