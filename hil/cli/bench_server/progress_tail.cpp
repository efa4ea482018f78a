// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/progress_tail.hpp"

#include <array>
#include <utility>

namespace pitwall::bench_server {

std::vector<std::string> ProgressTail::read() {
  std::vector<std::string> lines;
  if (!file_.is_open()) file_.open(path_, std::ios::binary);
  if (!file_.is_open()) return lines;
  file_.clear();  // the end of the file was its end for now
  std::array<char, 64 * 1024> bytes{};
  for (std::size_t taken = 0; taken < kTurnMax_bytes;) {
    file_.read(bytes.data(), bytes.size());
    const auto got = static_cast<std::size_t>(file_.gcount());
    taken += got;
    for (std::size_t i = 0; i < got; ++i) {
      if (bytes[i] != '\n') {
        if (!skipping_) part_ += bytes[i];
        if (part_.size() <= kLineMax_bytes) continue;
        skipping_ = true;
        ++too_long_;
        part_.clear();
        continue;
      }
      if (!skipping_) lines.push_back(std::exchange(part_, {}));
      skipping_ = false;
    }
    if (got < bytes.size()) break;
  }
  return lines;
}

}  // namespace pitwall::bench_server
