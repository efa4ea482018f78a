// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/scenario_table.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

constexpr std::size_t kColumns = 7;
using Row = std::array<std::string, kColumns>;

std::string stem_of(const std::string& file) { return std::filesystem::path{file}.stem().string(); }

Row row_of(const bench_server::Listed& one) {
  return {one.file,
          one.name,
          formatted("%g s", one.duration_s),
          stem_of(one.track),
          stem_of(one.car),
          std::to_string(one.faults.size()),
          std::to_string(one.expect.size())};
}

}  // namespace

std::string scenario_table(std::span<const bench_server::Listed> rows) {
  std::vector<Row> table{{"file", "name", "duration", "track", "car", "faults", "expectations"}};
  for (const bench_server::Listed& one : rows) table.push_back(row_of(one));
  std::array<std::size_t, kColumns> widths{};
  for (const Row& row : table)
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string out;
  for (const Row& row : table) {
    for (std::size_t i = 0; i + 1 < kColumns; ++i)
      out += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
    out += row.back() + "\n";
  }
  return out;
}

}  // namespace pitwall::cli
