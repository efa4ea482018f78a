// List of the scenarios: every file of a folder and of the folders in it, as a person chooses among
// them.
//   in     the folder
//   out    one row per file, by its id: the path in the folder without ".yaml". The description is
//          the comment that the file begins with
//   invariants
//          a file that is no scenario is listed with what is wrong with it; it cannot be started
//   bound  kMaxScenarios, in the order of their ids
//   errors Problem where there is no such folder
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::bench_server {

inline constexpr std::size_t kMaxScenarios = 1'000;

struct Listed {
  std::string id{}, file{}, name{}, description{};
  std::string problem{};  // why it cannot be started; empty: it can
  double duration_s = kUnset;
  std::uint64_t seed = 0;
  bool lockstep = false, live = false;  // which bench carries out all of its faults
  std::vector<std::string> faults{}, expect{};
};

Result<std::vector<Listed>, Problem> list_scenarios(const std::string& folder);

// Of one file's text.
Listed listed(const std::string& id, const std::string& file, const std::string& text);
std::string description_of(std::string_view text);

}  // namespace pitwall::bench_server
