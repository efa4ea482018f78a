// Requests of a client of the bench server, one JSON object per line, as PROTOCOL.md describes
// them.
//   in     a line
//   out    the request
//   errors Problem with the member as place; missing values are not guessed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench_server {

inline constexpr std::uint64_t kSeedMax = 1'000'000'000;  // same limit as `run --seed`
inline constexpr std::size_t kNameMax = 200;
inline constexpr std::size_t kMaxPageBytes = 4 << 20;

struct StartRunRequest {
  std::string scenario;
  std::optional<std::uint64_t> seed;  // replaces the seed of the file
  bool live = false;
  std::string by;
};
struct StopRunRequest {
  std::string by;
};
// The next part of a page (page_files.hpp).
struct PageRequest {
  std::string page;
  std::size_t from = 0;  // byte
};
using BenchRequest = std::variant<StartRunRequest, StopRunRequest, PageRequest>;

Result<BenchRequest, Problem> parse_request(std::string_view line);

}  // namespace pitwall::bench_server
