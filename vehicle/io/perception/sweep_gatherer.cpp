// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/sweep_gatherer.hpp"

#include <algorithm>
#include <ranges>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::io {

void SweepGatherer::arrived(std::size_t sensor, Instant begun, Instant now) {
  CHECK(!must_take_before(sensor));
  sensors_[sensor].begun = begun;
  sensors_[sensor].received_at = now;
  if (!first_) first_ = now;
}

bool SweepGatherer::is_due(Instant now) const {
  if (!first_) return false;
  if (gathering_ == Gathering::kAll) return is_whole();
  return now - *first_ >= kWait || std::ranges::all_of(sensors_, [&](const Sensor& sensor) {
           return sensor.begun || !is_alive(sensor, now);
         });
}

bool SweepGatherer::is_whole() const {
  const auto begun = [](const Sensor& sensor) { return sensor.begun; };
  if (!std::ranges::all_of(sensors_, [&](const auto& s) { return begun(s).has_value(); }))
    return false;
  const auto [oldest, newest] = std::ranges::minmax(
      sensors_ | std::views::transform([](const Sensor& sensor) { return *sensor.begun; }));
  return newest - oldest <= kTogether;
}

std::optional<SweepGatherer::Frame> SweepGatherer::take() {
  if (!first_) return std::nullopt;
  first_.reset();
  std::optional<Frame> frame;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    Sensor& sensor = sensors_[i];
    if (!sensor.begun) continue;
    if (!frame) frame = Frame{*sensor.begun, {}};
    frame->begun = std::min(frame->begun, *sensor.begun);
    frame->sensors.push_back(i);
    sensor.taken = *sensor.begun;
    sensor.begun.reset();
  }
  return frame;
}

}  // namespace pitwall::io
