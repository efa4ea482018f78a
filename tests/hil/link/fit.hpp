// Fades from a recording: the two-state model that fits best.
//   in     which of evenly sent datagrams were lost; or recorded outages
//   out    Fades, with what is lost in good times and comes through in bad ones told apart from the
//          fades themselves
//   errors Problem where a recording is too short or too uniform to say
//   cost   O(datagrams) for each of at most kMostRounds rounds
//   source Baum, Petrie, Soules, Weiss 1970 (expectation maximisation of a hidden Markov chain);
//          sampled two-state chain: exp(-(1/good + 1/bad) period) = 1 - P(good to bad) - P(bad to
//          good)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hil/link/link_params.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

inline constexpr int kMostRounds = 200;
inline constexpr std::size_t kLeastBursts = 20;

// lost[i] != 0: the datagram sent at i * period did not come.
Result<Fades, Problem> fit_fades(std::span<const std::uint8_t> lost, Duration period);
// From the first outage's beginning to the last one's.
Result<Fades, Problem> fit_fades(const LinkTrace& trace);

}  // namespace pitwall::link
