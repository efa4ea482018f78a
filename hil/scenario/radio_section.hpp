// The radio of a scenario and what its operator says over it: the sections `radio` and `operator`.
//   radio      a list, one map for each path: rate_kbit, queue_bytes, delay_ms, jitter_ms, loss,
//              duplicate, corrupt, fade_loss with fade_ms, blackouts (at_s, for_s, every_s), seed.
//              No section: a radio that takes no time and loses nothing
//   operator   a list of at_s and say, in the words of basestation/inputs/text_command.hpp; with
//              every_s and until_s the same again and again
//   invariants
//              both directions of a path meet the same fades, as on one radio link they do
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

inline constexpr std::size_t kMaxPaths = 2;

struct RadioPath {
  link::LinkParams link;
  std::optional<std::uint64_t> seed;  // of its own; else derived from the scenario's
};

struct OperatorText {
  Duration at{};
  std::string text;
};

std::vector<RadioPath> read_radio(yaml::StrictMap& map);
// In the order of time.
std::vector<OperatorText> read_operator(yaml::StrictMap& map);

}  // namespace pitwall::scenario
