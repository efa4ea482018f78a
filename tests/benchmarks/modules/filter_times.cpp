// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/filter_times.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "protocol/transport/clock.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"

namespace pitwall::benchmarks {
namespace {

using localization::FilterParams, localization::FilterState, localization::Kind,
    localization::Measurement;

constexpr double kOpenGate = 1e30;

template <class Work>
double took_us(Work work) {
  const Duration before = transport::thread_time();
  work();
  return cost::microseconds_of(transport::thread_time() - before);
}

void bring(localization::SpatialBelief& b, const localization::SpatialParams& p,
           const Measurement& m, const Measurement* ahead) {
  advance(b, p, m.at, ahead);
}
void bring(localization::PlanarBelief& b, const localization::PlanarParams& p, const Measurement& m,
           const Measurement*) {
  advance(b.belief, p.noise, m.at);
}

// Everything in the window once more, in order.
template <class Model>
void time_window(const localization::Entries& e,
                 localization::Memory<typename Model::Belief>& known,
                 const typename Model::Params& params, FilterTimes& times) {
  typename Model::Belief b = known.every(e, 0);
  for (std::size_t i = 1; i < e.size; ++i) {
    const std::size_t next = imu_from(e, i);
    const Measurement* ahead = next < e.size ? &e[next] : nullptr;
    const Measurement& m = e[i];
    if (m.kind == Kind::kImu) {
      times.predict_us.push_back(took_us([&] { (void)Model::fold(b, params, m, ahead); }));
      continue;
    }
    bring(b, params, m, ahead);
    localization::Innovation innovation;
    const double us = took_us([&] { innovation = Model::fold(b, params, m, ahead); });
    if (innovation.size > 0) times.update_us[static_cast<std::size_t>(m.kind)].push_back(us);
  }
}

// A position as it was once true, a microsecond after the newest that is at least so old.
std::optional<Measurement> late_position(const localization::Entries& e, Duration late) {
  const Instant oldest = e[e.size - 1].at - late;
  for (std::size_t i = e.size; i-- > 1;) {
    if (e[i].kind != Kind::kPosition || e[i].at > oldest) continue;
    Measurement m = e[i];
    m.at = m.at + microseconds(1);
    return m;
  }
  return std::nullopt;
}

void settle(FilterState& filter, const FilterParams& params) {
  if (filter.kind == localization::FilterKind::kPlanar)
    localization::settle<localization::PlanarModel>(filter.entries, filter.planar, params.planar);
  else
    localization::settle<localization::SpatialModel>(filter.entries, filter.spatial,
                                                     params.spatial);
}

void time_rewind(FilterState& filter, const FilterParams& params, Duration late,
                 std::vector<double>& times_us, std::size_t& refused) {
  settle(filter, params);
  const auto m = late_position(filter.entries, late);
  bool taken = false;
  const double us = took_us([&] {
    taken = m && insert(filter, params, *m).has_value();
    settle(filter, params);
  });
  if (taken)
    times_us.push_back(us);
  else
    ++refused;
}

}  // namespace

void take_times(const FilterState& filter, const FilterParams& params, FilterTimes& times) {
  FilterParams open = params;
  open.planar.gate_nis.fill(kOpenGate);
  open.spatial.gate_nis.fill(kOpenGate);
  const auto copy = std::make_unique<FilterState>(filter);
  time_rewind(*copy, open, kShortRewind, times.short_rewind_us, times.refused);
  time_rewind(*copy, open, kLongRewind, times.long_rewind_us, times.refused);
  *copy = filter;
  settle(*copy, open);
  if (copy->kind == localization::FilterKind::kPlanar)
    time_window<localization::PlanarModel>(copy->entries, copy->planar, open.planar, times);
  else
    time_window<localization::SpatialModel>(copy->entries, copy->spatial, open.spatial, times);
}

}  // namespace pitwall::benchmarks
