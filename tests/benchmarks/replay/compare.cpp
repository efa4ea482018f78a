// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/compare.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "protocol/vocabulary/quantile.hpp"

namespace pitwall::replay {
namespace {

bool comes_before(const can::Frame& a, const can::Frame& b) {
  const auto key = [](const can::Frame& f) {
    return std::tie(f.id, f.extended, f.remote, f.fd, f.length, f.data);
  };
  return key(a) < key(b);
}

// How often each frame occurs, compared: order plays no part.
void count_differences(std::vector<can::Frame> wanted, std::vector<can::Frame> got,
                       Comparison& out) {
  std::sort(wanted.begin(), wanted.end(), comes_before);
  std::sort(got.begin(), got.end(), comes_before);
  std::size_t w = 0, g = 0;
  while (w < wanted.size() && g < got.size()) {
    if (comes_before(wanted[w], got[g])) {
      ++out.lost, ++w;
    } else if (comes_before(got[g], wanted[w])) {
      ++out.extra, ++g;
    } else {
      ++w, ++g;
    }
  }
  out.lost += wanted.size() - w;
  out.extra += got.size() - g;
}

TimingErrors timing_of(std::span<const LoggedFrame> log,
                       std::span<const can::ReceivedFrame> arrived) {
  std::vector<Duration> late, gaps;
  UtcTime stamp = log.front().at;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const Duration log_gap{std::max<std::int64_t>(log[i].at.ns - stamp.ns, 0)};
    stamp = std::max(stamp, log[i].at);
    late.push_back((arrived[i].at - arrived[0].at) - Duration{stamp.ns - log.front().at.ns});
    if (i == 0) continue;
    const Duration error = (arrived[i].at - arrived[i - 1].at) - log_gap;
    gaps.push_back(std::max(error, -error));
  }
  const Duration zero = *std::min_element(late.begin(), late.end());
  for (Duration& value : late) value = value - zero;
  return {.lateness = quantiles_of(std::move(late)), .gap = quantiles_of(std::move(gaps))};
}

}  // namespace

Quantiles quantiles_of(std::vector<Duration> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const auto at = [&samples](double share) {
    return static_cast<double>(samples[nearest_rank(share, samples.size())].ns) * 1e-3;
  };
  return {.p50_us = at(0.5), .p90_us = at(0.9), .p99_us = at(0.99), .max_us = at(1.0)};
}

Quantiles median_of(std::span<const Quantiles> runs) {
  Quantiles out;
  if (runs.empty()) return out;
  for (double Quantiles::*const field :
       {&Quantiles::p50_us, &Quantiles::p90_us, &Quantiles::p99_us, &Quantiles::max_us}) {
    std::vector<double> values;
    for (const Quantiles& run : runs) values.push_back(run.*field);
    std::sort(values.begin(), values.end());
    out.*field = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2.0;
  }
  return out;
}

Comparison compare(std::span<const LoggedFrame> log, std::span<const can::ReceivedFrame> arrived) {
  Comparison out{.wanted = log.size(), .arrived = arrived.size()};
  out.in_order = std::equal(
      log.begin(), log.end(), arrived.begin(), arrived.end(),
      [](const LoggedFrame& a, const can::ReceivedFrame& b) { return a.frame == b.frame; });
  std::vector<can::Frame> wanted, got;
  for (const LoggedFrame& logged : log) wanted.push_back(logged.frame);
  for (const can::ReceivedFrame& received : arrived) got.push_back(received.frame);
  count_differences(std::move(wanted), std::move(got), out);
  if (out.in_order && !log.empty()) out.timing = timing_of(log, arrived);
  return out;
}

}  // namespace pitwall::replay
