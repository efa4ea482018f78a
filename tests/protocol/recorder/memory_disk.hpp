// Disk of the recorder in memory, with a capacity that can be used up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "protocol/recorder/segment_chain.hpp"

namespace pitwall::recorder {

struct MemoryDisk : Disk {
  std::map<std::string, std::vector<std::uint8_t>> files;
  std::uint64_t capacity = std::uint64_t{1} << 30U;
  std::string open;

  std::uint64_t used() const {
    std::uint64_t sum = 0;
    for (const auto& [name, bytes] : files) sum += bytes.size();
    return sum;
  }
  std::optional<Problem> begin(const std::string& name) override {
    open = name;
    files[name];
    return std::nullopt;
  }
  bool append(std::span<const std::uint8_t> bytes) override {
    if (used() + bytes.size() > capacity) return false;
    files[open].insert(files[open].end(), bytes.begin(), bytes.end());
    return true;
  }
  void end(bool keep) override {
    if (!keep) files.erase(open);
  }
  std::string problem() const override { return open + ": error: full"; }
  std::uint64_t free_bytes() const override { return capacity > used() ? capacity - used() : 0; }
};

}  // namespace pitwall::recorder
