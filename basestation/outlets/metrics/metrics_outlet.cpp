// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/metrics/metrics_outlet.hpp"

#include <array>

#include "protocol/telemetry/packet/body.hpp"

namespace pitwall::outlets::metrics {
namespace {

void look_at_numbers(const intake::Station& station, const Stand& stand, Instant now,
                     CarSight& sight) {
  for (std::size_t place = 0; place < kNumbers; ++place) {
    const picture::FieldId id = id_at(place);
    if (stand.wall == nullptr && picture::is_base(id)) return;  // those are the wall's
    const picture::FieldView view = stand.wall != nullptr
                                        ? stand.wall->seen(id, now)
                                        : station.picture().view(telemetry::FieldIndex{id}, now);
    if (picture::usable(view) && !view.unset) sight.numbers[place] = view.value;
  }
}

void look_at_ages(const intake::Station& station, Instant now, CarSight& sight) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const picture::FieldView view = station.picture().group(row.group, now);
    if (view.quality == picture::Quality::kNever) continue;
    sight.ages_s[telemetry::index_of(row.group)] = view.age.seconds();
  }
}

void look_at_link(const intake::Station& station, Instant now, CarSight& sight) {
  const telemetry::LinkReport report = station.report(now);
  sight.counts = {
      {"packets", "packets of the car", station.rate().packets()},
      {"packets_lost", "packets of the car that came by no path", station.lost_packets()},
      {"packet_copies", "packets that came by the other path, too", report.association.duplicates},
      {"sessions", "times that car and base agreed on keys", report.sessions},
      {"address_changes", "times that the car came from another address", report.association.roams},
      {"records_malformed", "records of the car that could not be read", report.bad_records},
      {"commands", "commands that were given", station.commands_given()},
      {"events", "events that the car told", station.events_heard()},
      {"words_refused", "words of the operator that were not understood", station.words_refused()}};
  for (std::size_t i = 0; i < telemetry::kRefusals; ++i) {
    const auto kind = static_cast<telemetry::Refusal>(i);
    // A copy by another path is no refusal: it is what a second path is for.
    const std::uint64_t copies =
        kind == telemetry::Refusal::kReplayed ? report.association.duplicates : 0;
    sight.refused.emplace_back(telemetry::text_of(kind), report.association.refused[i] - copies);
  }
  for (std::size_t i = 0; i < telemetry::kBodyErrors; ++i) {
    sight.refused.emplace_back(telemetry::text_of(static_cast<telemetry::BodyError>(i)),
                               report.bad_bodies[i]);
  }
}

void look_at_alarms(const wall::Wall& wall, CarSight& sight) {
  using alarms::Priority;
  const alarms::Engine& engine = wall.watch().alarms();
  for (const Priority priority : {Priority::kHigh, Priority::kMedium, Priority::kLow}) {
    sight.alarms.push_back({.priority = std::string{alarms::text_of(priority)},
                            .active = engine.count(priority),
                            .unseen = engine.unseen(priority)});
  }
}

}  // namespace

CarSight sight_of(const intake::Station& station, const Stand& stand, Instant now) {
  CarSight sight{.car = stand.car, .name = stand.name, .mode = wall::mode_of(station.source())};
  look_at_numbers(station, stand, now, sight);
  look_at_ages(station, now, sight);
  look_at_link(station, now, sight);
  if (stand.wall != nullptr) {
    look_at_alarms(*stand.wall, sight);
    sight.history_bytes = stand.wall->history_bytes();
  }
  for (const Outlet* const outlet : stand.outlets) {
    if (auto figures = outlet->figures()) sight.outlets.push_back(*std::move(figures));
  }
  return sight;
}

void MetricsOutlet::serve(intake::Station& station, Instant now) {
  if (now < due_) return;
  due_ = now + kEvery;
  board_.put(stand_.place, sight_of(station, stand_, now));
  if (stand_.server != nullptr) board_.put(stand_.server->counters());
}

}  // namespace pitwall::outlets::metrics
