// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/link/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::link {
namespace {

constexpr double kConverged = 1e-6;

// The sampled chain: 0 good, 1 bad.
struct Chain {
  std::array<double, 2> leave{};  // probability to change state from one datagram to the next
  std::array<double, 2> loss{};

  double stays(int state, int next) const {
    const auto i = static_cast<std::size_t>(state);
    return state == next ? 1.0 - leave[i] : leave[i];
  }
  double seen(int state, bool lost) const {
    const double p = loss[static_cast<std::size_t>(state)];
    return lost ? p : 1.0 - p;
  }
};

using Pair = std::array<double, 2>;

Pair normalised(Pair p) {
  const double sum = p[0] + p[1];
  return {p[0] / sum, p[1] / sum};
}

// What is known of the state at each datagram from those up to it.
std::vector<Pair> forward(const Chain& c, std::span<const std::uint8_t> lost) {
  std::vector<Pair> known(lost.size());
  Pair now = normalised({c.leave[1], c.leave[0]});
  for (std::size_t i = 0; i < lost.size(); ++i) {
    if (i > 0)
      now = {now[0] * c.stays(0, 0) + now[1] * c.stays(1, 0),
             now[0] * c.stays(0, 1) + now[1] * c.stays(1, 1)};
    now = normalised({now[0] * c.seen(0, lost[i] != 0), now[1] * c.seen(1, lost[i] != 0)});
    known[i] = now;
  }
  return known;
}

// One round: the chain that explains best what the last one makes of the record.
Chain improved(const Chain& c, std::span<const std::uint8_t> lost) {
  const std::vector<Pair> known = forward(c, lost);
  Pair later{1.0, 1.0};  // likelihood of all after i, scaled
  Pair time{}, left{}, losses{};
  for (std::size_t i = lost.size(); i-- > 0;) {
    const Pair here = normalised({known[i][0] * later[0], known[i][1] * later[1]});
    for (std::size_t s = 0; s < 2; ++s) {
      time[s] += here[s];
      losses[s] += lost[i] != 0 ? here[s] : 0.0;
    }
    if (i == 0) break;
    const bool was = lost[i] != 0;
    const Pair ahead{c.seen(0, was) * later[0], c.seen(1, was) * later[1]};
    const double to_bad = known[i - 1][0] * c.stays(0, 1) * ahead[1];
    const double to_good = known[i - 1][1] * c.stays(1, 0) * ahead[0];
    const double all = known[i - 1][0] * c.stays(0, 0) * ahead[0] +
                       known[i - 1][1] * c.stays(1, 1) * ahead[1] + to_bad + to_good;
    left[0] += to_bad / all;
    left[1] += to_good / all;
    later = normalised({c.stays(0, 0) * ahead[0] + c.stays(0, 1) * ahead[1],
                        c.stays(1, 0) * ahead[0] + c.stays(1, 1) * ahead[1]});
  }
  return {{left[0] / time[0], left[1] / time[1]}, {losses[0] / time[0], losses[1] / time[1]}};
}

double difference(const Chain& a, const Chain& b) {
  double most = 0.0;
  for (std::size_t s = 0; s < 2; ++s)
    most = std::max({most, std::abs(a.leave[s] - b.leave[s]), std::abs(a.loss[s] - b.loss[s])});
  return most;
}

// As if every loss were a fade.
Chain first_guess(std::span<const std::uint8_t> lost, std::size_t bursts) {
  const auto losses = static_cast<double>(std::ranges::count_if(lost, [](auto l) { return l; }));
  const auto runs = static_cast<double>(bursts);
  return {{runs / (static_cast<double>(lost.size()) - losses), runs / losses}, {0.01, 0.95}};
}

}  // namespace

Result<Fades, Problem> fit_fades(std::span<const std::uint8_t> lost, Duration period) {
  CHECK(period > Duration{});
  std::size_t bursts = 0;
  for (std::size_t i = 1; i < lost.size(); ++i)
    bursts += lost[i] != 0 && lost[i - 1] == 0 ? 1U : 0U;
  if (bursts < kLeastBursts)
    return Unexpected{Problem{"record", "holds " + std::to_string(bursts) + " bursts of loss; " +
                                            std::to_string(kLeastBursts) + " are needed"}};
  Chain chain = first_guess(lost, bursts);
  for (int round = 0; round < kMostRounds; ++round) {
    const Chain next = improved(chain, lost);
    const double moved = difference(chain, next);
    chain = next;
    if (moved < kConverged) break;
  }
  const double both = chain.leave[0] + chain.leave[1];
  if (!(both > 0.0 && both < 1.0 && chain.leave[0] > 0.0 && chain.leave[1] > 0.0))
    return Unexpected{Problem{"record", "its losses come in no bursts longer than the period"}};
  const double rate = -std::log1p(-both) / period.seconds();  // 1/good + 1/bad
  return Fades{from_seconds(both / (rate * chain.leave[0])),
               from_seconds(both / (rate * chain.leave[1])), chain.loss[0], chain.loss[1]};
}

Result<Fades, Problem> fit_fades(const LinkTrace& trace) {
  const auto& outages = trace.outages;
  if (outages.size() < kLeastBursts)
    return Unexpected{Problem{"trace", "holds " + std::to_string(outages.size()) + " outages; " +
                                           std::to_string(kLeastBursts) + " are needed"}};
  double bad_s = 0.0, loss = 0.0;
  for (const Outage& outage : std::span(outages).first(outages.size() - 1)) {
    bad_s += (outage.to - outage.from).seconds();
    loss += outage.loss * (outage.to - outage.from).seconds();
  }
  const double all_s = (outages.back().from - outages.front().from).seconds();
  const auto count = static_cast<double>(outages.size() - 1);
  return Fades{from_seconds((all_s - bad_s) / count), from_seconds(bad_s / count), 0.0,
               loss / bad_s};
}

}  // namespace pitwall::link
