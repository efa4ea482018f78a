// Reader of a file of lines while another process writes it.
//   in     its path; the file may not be there yet
//   out    whole lines, each once, in order
//   invariants
//          a line without an end is no line: it may still be written. One longer than
//          kLineMax_bytes is skipped and counted
//   errors a file that is not there has no lines
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
  // What a turn reads at most: a lockstep run tells a thousand lines a second.
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
