// Fit of the two-state fade model to a recording.
//   in     which of evenly sent datagrams were lost; or recorded outages
//   out    Fades: mean lengths of good and bad times, and the loss within each of them
//   errors Problem if a recording has fewer than kLeastBursts bursts of loss, or none that is
//          longer than the period
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

// lost[i] != 0: the datagram sent at i * period did not arrive.
Result<Fades, Problem> fit_fades(std::span<const std::uint8_t> lost, Duration period);
// Uses the time from the begin of the first outage to the begin of the last one.
Result<Fades, Problem> fit_fades(const LinkTrace& trace);

}  // namespace pitwall::link
