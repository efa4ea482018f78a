// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/radio_summary.hpp"

#include "protocol/json/json_text.hpp"

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
  json::Object out;
  out.number("received", path.received.received);
  out.number("lost", path.received.lost);
  out.number("late", path.received.late);
  out.number("delay_p99_us", whole_us(path.received.delay_p99));
  out.number("sent", path.spent.packets);
  out.number("sent_bytes", path.spent.bytes);
  out.number("budget_refused", path.spent.refused);
  return out.str();
}

std::string refusals_json(const telemetry::AssociationCounters& counters) {
  json::Object out;
  for (std::size_t i = 0; i < telemetry::kRefusals; ++i)
    out.number(telemetry::text_of(static_cast<telemetry::Refusal>(i)), counters.refused[i]);
  return out.str();
}

std::string commands_json(const telemetry::LedgerCounters& ledger) {
  json::Object out;
  out.number("received", ledger.received);
  for (std::size_t i = 0; i < telemetry::kOutcomes; ++i)
    out.number(std::string(telemetry::text_of(static_cast<telemetry::Outcome>(i))),
               ledger.decided[i]);
  return out.str();
}

}  // namespace

std::string radio_json(const telemetry::LinkReport& report, std::size_t paths) {
  json::Object out;
  out.number("sessions", report.sessions);
  out.number("opened", report.association.opened);
  out.number("bad_bodies", sum(report.bad_bodies) + report.bad_records);
  out.number("slots", report.slots);
  out.number("slots_skipped", report.slots_skipped);
  out.number("events", report.events.events);
  out.number("events_dropped", report.events.dropped);
  out.number("bulk_delivered", report.bulk.delivered);
  out.number("round_trip_us", whole_us(report.round_trip.value_or(Duration{})));
  out.json("refused", refusals_json(report.association));
  out.json("commands", commands_json(report.ledger));
  json::Array list;
  for (std::size_t i = 0; i < paths && i < report.paths.size(); ++i)
    list.json(path_json(report.paths[i]));
  out.json("paths", list.str());
  return out.str();
}

}  // namespace pitwall::io
