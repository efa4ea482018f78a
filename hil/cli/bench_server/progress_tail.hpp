// Reader of a line file that another process is still writing.
//   in     its path; the file may not exist yet
//   out    complete lines, each once, in order
//   invariants
//          a line without its line end is not returned, because it may still grow. A line longer
//          than kLineMax_bytes is skipped and counted
//   errors a missing file gives no lines
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace pitwall::bench_server {

class ProgressTail {
 public:
  static constexpr std::size_t kLineMax_bytes = 128 * 1024;
  // Maximum per call of read(): a lockstep run writes a thousand lines a second.
  static constexpr std::size_t kTurnMax_bytes = 1 << 20;

  explicit ProgressTail(std::string path) : path_(std::move(path)) {}

  std::vector<std::string> read();
  std::uint64_t too_long() const { return too_long_; }

 private:
  std::string path_, part_;
  std::ifstream file_;
  bool skipping_ = false;
  std::uint64_t too_long_ = 0;
};

}  // namespace pitwall::bench_server
