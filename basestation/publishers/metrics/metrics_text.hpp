// Metrics of a base station in the Prometheus text format.
//   in     the figures of each car's service at one moment, as plain values
//   out    the text of /metrics
//   names  pitwall_field_UNIT{car,group,field}: every number of the registry and of the base's own,
//          in base units; pitwall_group_age_seconds{car,group}; counters pitwall_*_total
//   invariants
//          a field that is stale, or that the car does not know, has no sample, so that no old
//          value looks like a present one. The age of its group shows how old it is
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/publisher.hpp"
#include "basestation/state/station_field.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/transport/bench_clock/bench_pause.hpp"

namespace pitwall::publishers::metrics {

inline constexpr std::size_t kNumbers = telemetry::kFieldCount + state::kBaseFields;

// The field at this place of CarStatus::numbers.
constexpr state::FieldId id_at(std::size_t place) {
  return place < telemetry::kFieldCount
             ? state::id_of(telemetry::FieldIndex{place})
             : state::id_of(static_cast<state::BaseField>(place - telemetry::kFieldCount));
}

struct CarStatus {
  int car = 0;
  std::string name, mode;
  std::uint64_t history_bytes = 0;             // of the trends of the service
  std::array<double, kNumbers> numbers = [] {  // NaN: not known now
    std::array<double, kNumbers> unset{};
    unset.fill(kUnset);
    return unset;
  }();
  std::array<double, telemetry::kGroups> ages_s = [] {  // NaN: never sampled
    std::array<double, telemetry::kGroups> never{};
    never.fill(kUnset);
    return never;
  }();
  struct Alarms {
    std::string priority;
    std::uint64_t active = 0, unacknowledged = 0;
  };
  std::vector<Alarms> alarms{};
  // `name`: without pitwall_ and _total.
  struct Count {
    std::string_view name, help;
    std::uint64_t value = 0;
  };
  std::vector<Count> counts{};
  service::PublisherFigures::Counts refused{};  // datagrams, by reason
  std::vector<service::PublisherFigures> publishers{};
};

std::string metrics_text(std::span<const CarStatus> cars,
                         const std::optional<web::WebCounters>& web,
                         const std::optional<transport::BenchPause>& pause = {});

}  // namespace pitwall::publishers::metrics
