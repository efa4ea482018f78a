// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/metrics_publisher.hpp"

#include <array>

#include "protocol/telemetry/packet/body.hpp"

namespace pitwall::publishers::metrics {
namespace {

void look_at_numbers(const service::CarService& car, Instant now, CarStatus& status) {
  for (std::size_t place = 0; place < kNumbers; ++place) {
    const state::FieldView view = car.view(id_at(place), now);
    if (state::usable(view) && !view.unset) status.numbers[place] = view.value;
  }
}

void look_at_ages(const service::CarService& car, Instant now, CarStatus& status) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const state::FieldView view = car.vehicle().group(row.group, now);
    if (view.quality == state::Quality::kNever) continue;
    status.ages_s[telemetry::index_of(row.group)] = view.age.seconds();
  }
}

void look_at_link(const service::CarService& car, Instant now, CarStatus& status) {
  const link::Station& station = car.link();
  const telemetry::LinkReport report = station.report(now);
  status.counts = {
      {"packets", "packets of the car", station.rate().packets()},
      {"packets_lost", "packets of the car that came by no path", station.lost_packets()},
      {"packet_copies", "packets that came by the other path, too", report.association.duplicates},
      {"sessions", "times that car and base agreed on keys", report.sessions},
      {"address_changes", "times that the car came from another address", report.association.roams},
      {"records_malformed", "records of the car that could not be read", report.bad_records},
      {"commands", "commands that were given", car.requests().queue().issued()},
      {"events", "events that the car told", station.events_received()},
      {"requests_refused", "requests of operators that were refused", car.requests().refused()}};
  for (std::size_t i = 0; i < telemetry::kRefusals; ++i) {
    const auto kind = static_cast<telemetry::Refusal>(i);
    // A copy by another path is no refusal: it is what a second path is for.
    const std::uint64_t copies =
        kind == telemetry::Refusal::kReplayed ? report.association.duplicates : 0;
    status.refused.emplace_back(telemetry::text_of(kind), report.association.refused[i] - copies);
  }
  for (std::size_t i = 0; i < telemetry::kBodyErrors; ++i) {
    status.refused.emplace_back(telemetry::text_of(static_cast<telemetry::BodyError>(i)),
                                report.bad_bodies[i]);
  }
}

void look_at_alarms(const service::CarService& car, CarStatus& status) {
  using alarms::Priority;
  const alarms::Engine& engine = car.evaluator().alarms();
  for (const Priority priority : {Priority::kHigh, Priority::kMedium, Priority::kLow}) {
    status.alarms.push_back({.priority = std::string{alarms::text_of(priority)},
                             .active = engine.count(priority),
                             .unacknowledged = engine.unacknowledged(priority)});
  }
}

}  // namespace

CarStatus status_of(const service::CarService& car, const MetricsSources& sources, Instant now) {
  service::CarIdentity identity = car.identity();
  CarStatus status{
      .car = identity.car, .name = std::move(identity.name), .mode = std::move(identity.mode)};
  look_at_numbers(car, now, status);
  look_at_ages(car, now, status);
  look_at_link(car, now, status);
  look_at_alarms(car, status);
  status.history_bytes = car.history_bytes();
  for (const service::Publisher* const publisher : sources.publishers) {
    if (auto figures = publisher->figures()) status.publishers.push_back(*std::move(figures));
  }
  return status;
}

void MetricsPublisher::publish(const service::CarService& car, Instant now) {
  if (now < due_) return;
  due_ = now + kEvery;
  board_.put(sources_.place, status_of(car, sources_, now));
  if (sources_.server != nullptr) board_.put(sources_.server->counters());
}

}  // namespace pitwall::publishers::metrics
