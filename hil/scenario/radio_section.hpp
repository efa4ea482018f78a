// Sections `radio` and `operator` of a scenario file: the radio paths, and what the operator sends.
//   radio      a list with one map per path: rate_kbit, queue_bytes, delay_ms, jitter_ms, loss,
//              duplicate, corrupt, fade_loss with fade_ms, blackouts (at_s, for_s, every_s), seed.
//              Without the section the radio has no delay and no loss
//   operator   a list of at_s and say, a text command of basestation/inputs/text_command.hpp;
//              every_s and until_s repeat it
//   invariants
//              both directions of a path have the same fades, as on one real radio link
//   errors     thrown as yaml::InputError with the place, for read_scenario()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/link/link_params.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::scenario {

inline constexpr double kLongest_s = 36'000.0;  // ten hours: the longest soak
inline constexpr std::int64_t kMaxSeed = 1'000'000'000;

inline constexpr std::size_t kMaxPaths = 2;

struct RadioPath {
  link::LinkParams link;
  std::optional<std::uint64_t> seed;  // empty: derived from the seed of the scenario
};

struct OperatorText {
  Duration at{};
  std::string text;
};

std::vector<RadioPath> read_radio(yaml::StrictMap& map);
// Sorted by time.
std::vector<OperatorText> read_operator(yaml::StrictMap& map);

}  // namespace pitwall::scenario
