// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/radio_summary.hpp"

#include "vehicle/io/json_counts.hpp"

namespace pitwall::io {
namespace {

std::uint64_t whole_us(Duration span) {
  return span.ns > 0 ? static_cast<std::uint64_t>(span.ns) / 1'000 : 0;
}

template <class Counts>
std::uint64_t sum(const Counts& counts) {
  std::uint64_t total = 0;
  for (const std::uint64_t n : counts) total += n;
  return total;
}

std::string path_json(const telemetry::PathReport& path) {
  JsonCounts out;
  out.add("received", path.heard.received);
  out.add("lost", path.heard.lost);
  out.add("late", path.heard.late);
  out.add("delay_p99_us", whole_us(path.heard.delay_p99));
  out.add("sent", path.spent.packets);
  out.add("sent_bytes", path.spent.bytes);
  out.add("budget_refused", path.spent.refused);
  return out.object();
}

std::string refusals_json(const telemetry::AssociationCounters& counters) {
  JsonCounts out;
  for (std::size_t i = 0; i < telemetry::kRefusals; ++i)
    out.add(telemetry::text_of(static_cast<telemetry::Refusal>(i)), counters.refused[i]);
  return out.object();
}

std::string commands_json(const telemetry::LedgerCounters& ledger) {
  JsonCounts out;
  out.add("received", ledger.received);
  for (std::size_t i = 0; i < telemetry::kOutcomes; ++i)
    out.add(std::string(telemetry::text_of(static_cast<telemetry::Outcome>(i))), ledger.decided[i]);
  return out.object();
}

}  // namespace

std::string radio_json(const telemetry::LinkReport& report, std::size_t paths) {
  JsonCounts out;
  out.add("sessions", report.sessions);
  out.add("opened", report.association.opened);
  out.add("bad_bodies", sum(report.bad_bodies) + report.bad_records);
  out.add("slots", report.slots);
  out.add("slots_skipped", report.slots_skipped);
  out.add("events", report.events.events);
  out.add("events_dropped", report.events.dropped);
  out.add("bulk_delivered", report.bulk.delivered);
  out.add("round_trip_us", whole_us(report.round_trip.value_or(Duration{})));
  out.add_json("refused", refusals_json(report.association));
  out.add_json("commands", commands_json(report.ledger));
  std::string list;
  for (std::size_t i = 0; i < paths && i < report.paths.size(); ++i)
    list += (i == 0 ? "" : ", ") + path_json(report.paths[i]);
  out.add_json("paths", "[" + list + "]");
  return out.object();
}

}  // namespace pitwall::io
