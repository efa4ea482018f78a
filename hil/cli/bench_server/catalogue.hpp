// List of the scenarios in a folder and its subfolders, for the user to choose from.
//   in     the folder
//   out    one row per file, by its id: the path in the folder without ".yaml". The description is
//          the comment at the beginning of the file
//   invariants
//          an invalid scenario file is listed with its problem and cannot be started
//   bound  the first kMaxScenarios in order of their ids
//   errors Problem if the folder does not exist
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
  std::string problem{};       // why it cannot be started; empty: valid
  std::string track{}, car{};  // files
  double duration_s = kUnset;
  std::uint64_t seed = 0;
  // whether this mode supports all of its faults and expectations
  bool lockstep = false, live = false;
  std::vector<std::string> faults{}, expect{};
};

Result<std::vector<Listed>, Problem> list_scenarios(const std::string& folder);

// The row of one file, from its text.
Listed listed(const std::string& id, const std::string& file, const std::string& text);
std::string description_of(std::string_view text);

}  // namespace pitwall::bench_server
