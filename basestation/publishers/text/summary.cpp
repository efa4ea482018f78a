// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/summary.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "basestation/state/event_text.hpp"
#include "basestation/state/value_text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::publishers {
namespace {

std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  return formatted("%.10g", value);
}

std::string ms(Duration d) { return number(d.milliseconds()); }
std::string ms(const std::optional<Duration>& d) { return d ? ms(*d) : "null"; }
std::string text_of(std::uint64_t n) { return std::to_string(n); }
const char* text_of(bool yes) { return yes ? "true" : "false"; }

// {"a": 1, "b": 2}; values are JSON already.
class Object {
 public:
  Object& add(std::string_view key, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + json::quoted(key) + ": " + value;
    return *this;
  }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string ages_json(const link::AgeHistogram& ages) {
  if (ages.empty()) return R"({"p50": null, "p90": null, "p99": null, "max": null})";
  return Object{}
      .add("p50", ms(ages.quantile(0.50)))
      .add("p90", ms(ages.quantile(0.90)))
      .add("p99", ms(ages.quantile(0.99)))
      .add("max", ms(ages.largest()))
      .text();
}

std::string ages_by_class(const link::AgeStatistics& ages) {
  constexpr std::array<std::pair<telemetry::Class, const char*>, telemetry::kClasses> kNames{
      {{telemetry::Class::kSafety, "safety"},
       {telemetry::Class::kMotion, "motion"},
       {telemetry::Class::kHealth, "health"},
       {telemetry::Class::kStatistics, "statistics"}}};
  Object object;
  for (const auto& [priority, name] : kNames) object.add(name, ages_json(ages.of(priority)));
  return object.text();
}

std::string ages_by_group(const link::AgeStatistics& ages) {
  Object object;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (row.direction != telemetry::Direction::kDown) continue;
    object.add(row.name, ages_json(ages.of(row.group)));
  }
  return object.text();
}

struct Refused {
  std::uint64_t total = 0;
  std::string by_kind;
};

// A copy by another path is no refusal: it is what a second path is for.
Refused refused_of(const telemetry::LinkReport& report) {
  Refused refused;
  Object kinds;
  const auto add = [&](std::string_view name, std::uint64_t n) {
    refused.total += n;
    kinds.add(name, text_of(n));
  };
  for (std::size_t i = 0; i < telemetry::kRefusals; ++i) {
    const auto kind = static_cast<telemetry::Refusal>(i);
    const bool replayed = kind == telemetry::Refusal::kReplayed;
    add(telemetry::text_of(kind),
        report.association.refused[i] - (replayed ? report.association.duplicates : 0));
  }
  for (std::size_t i = 0; i < telemetry::kBodyErrors; ++i) {
    add(telemetry::text_of(static_cast<telemetry::BodyError>(i)), report.bad_bodies[i]);
  }
  add("bad records", report.bad_records);
  refused.by_kind = kinds.text();
  return refused;
}

std::string path_json(const telemetry::PathReport& path) {
  const telemetry::PathFigures& h = path.received;
  return Object{}
      .add("received", text_of(h.received))
      .add("lost", text_of(h.lost))
      .add("duplicates", text_of(h.duplicates))
      .add("late", text_of(h.late))
      .add("loss_last_5_s", number(h.loss))
      .add("burst_ms", ms(h.mean_bad))
      .add("between_bursts_ms", ms(h.mean_good))
      .add("delay_p50_ms", ms(h.delay_p50))
      .add("delay_p95_ms", ms(h.delay_p95))
      .add("delay_p99_ms", ms(h.delay_p99))
      .add("jitter_ms", ms(h.jitter))
      .add("down_bytes_per_s", number(h.rate_bytes_per_s))
      .add("up_bytes", text_of(path.spent.bytes))
      .add("up_packets", text_of(path.spent.packets))
      .add("up_refused_room", text_of(path.spent.refused))
      .add("up_budget_use", number(path.budget_use))
      .add("up_rate_factor", number(path.rate_factor))
      .add("address_proved", text_of(path.validated))
      .text();
}

template <class Items, class Make>
std::string array_of(const Items& items, const Make& make) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ",\n    ") + make(item);
  return text.empty() ? "[]" : "[\n    " + text + "]";
}

std::string since_ms(std::optional<Instant> then, Instant start) {
  return then ? ms(*then - start) : "null";
}

std::string command_json(const telemetry::CommandProgress& c, Instant start) {
  return Object{}
      .add("id", text_of(std::uint64_t{c.id}))
      .add("command", json::quoted(state::command_text(c.command)))
      .add("given_s", number((c.issued - start).seconds()))
      .add("sent_ms", since_ms(c.sent, c.issued))
      .add("received_ms", since_ms(c.received, c.issued))
      .add("decided_ms", since_ms(c.decided, c.issued))
      .add("fate", c.outcome ? json::quoted(telemetry::text_of(*c.outcome)) : "null")
      .text();
}

std::string losses_by_place(const telemetry::StationEndpoint& endpoint) {
  Object object;
  for (std::size_t bin = 0; bin < telemetry::kTrackBins; ++bin) {
    const double loss = endpoint.loss_at(bin);
    if (std::isnan(loss)) continue;
    object.add(number(link::Station::kSection_m * static_cast<double>(bin)), number(loss));
  }
  return object.text();
}

std::string field_json(const telemetry::FieldRow& row, const state::FieldView& view) {
  Object object;
  object.add("unit", json::quoted(row.unit))
      .add("quality", json::quoted(state::text_of(view.quality)));
  if (view.quality == state::Quality::kNever) return object.add("value", "null").text();
  object.add("value", number(view.value)).add("age_ms", ms(view.age));
  if (!row.labels.empty()) object.add("text", json::quoted(state::value_text(row, view.value)));
  return object.text();
}

const char* source_text(link::Station::Source source) {
  switch (source) {
    case link::Station::Source::kNone:
      return "none";
    case link::Station::Source::kSimulation:
      return "simulation";
    case link::Station::Source::kCar:
      return "car";
  }
  return "none";
}

const char* car_text(const link::PacketRate& rate, Instant now) {
  if (!rate.ever()) return "not received yet";
  return rate.lost(now) ? "lost" : "received";
}

class Document {
 public:
  void line(std::string_view key, const std::string& value) {
    text_ += "  " + json::quoted(key) + ": " + value + ",\n";
  }
  void add_fields(const state::VehicleState& vehicle, Instant now) {
    text_ += "  \"fields\": {\n";
    for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
      const telemetry::FieldRow& row = telemetry::kFields[i];
      if (telemetry::row_of(row.group).direction != telemetry::Direction::kDown) continue;
      text_ += (first_ ? "    " : ",\n    ") + json::quoted(state::path_of(row)) + ": " +
               field_json(row, vehicle.view(i, now));
      first_ = false;
    }
    text_ += "\n  }\n";
  }
  std::string text() const { return "{\n" + text_ + "}\n"; }

 private:
  std::string text_;
  bool first_ = true;
};

void add_link(const service::CarService& car, Instant now, Document& document) {
  const telemetry::LinkReport report = car.link().report(now);
  const Refused refused = refused_of(report);
  document.line("refused", text_of(refused.total));
  document.line("refused_by_kind", refused.by_kind);
  document.line("duplicates", text_of(report.association.duplicates));
  document.line("sessions", text_of(report.sessions));
  document.line("exchanges", text_of(report.association.exchanges));
  document.line("roams", text_of(report.association.roams));
  document.line("key_phases", text_of(report.association.phases));
  document.line("slots", text_of(report.slots));
  document.line("slots_skipped", text_of(report.slots_skipped));
  document.line("both_lost", number(report.both_lost));
  document.line("clock", Object{}
                             .add("known", text_of(car.link().endpoint().clock_known()))
                             .add("round_trip_ms", ms(report.round_trip))
                             .add("bound_ms", ms(report.clock_bound))
                             .text());
  std::string paths;
  for (telemetry::PathId path = 0; path < car.link().paths(); ++path) {
    paths += (path == 0 ? "" : ",\n    ") + path_json(report.paths[path]);
  }
  document.line("paths", "[" + paths + "]");
  document.line("loss_by_place_m", losses_by_place(car.link().endpoint()));
}

void add_logs(const service::CarService& car, Document& document) {
  const Instant start = car.link().rate().first();
  document.line("commands_given", text_of(car.requests().queue().issued()));
  document.line("requests_refused", text_of(car.requests().refused()));
  std::vector<telemetry::CommandProgress> commands;
  for (const command::Ticket& ticket : car.requests().queue().tickets())
    if (ticket.progress) commands.push_back(*ticket.progress);
  document.line("commands", array_of(commands, [&](const auto& command) {
                  return command_json(command, start);
                }));
  document.line("events_heard", text_of(car.link().events_received()));
  document.line("events", array_of(car.link().events(), [&](const telemetry::Event& event) {
                  return Object{}
                      .add("at_s", number((event.at - start).seconds()))
                      .add("event", json::quoted(state::event_text(event)))
                      .text();
                }));
  std::uint64_t objects = 0, bytes = 0;
  for (const link::BulkTally& tally : car.link().bulk()) {
    objects += tally.objects;
    bytes += tally.bytes;
  }
  document.line("bulk",
                Object{}.add("objects", text_of(objects)).add("bytes", text_of(bytes)).text());
}

}  // namespace

std::string json_summary(const service::CarService& car, Instant now,
                         const std::optional<transport::BenchPause>& pause) {
  const link::PacketRate& rate = car.link().rate();
  Document document;
  document.line("source", json::quoted(source_text(car.link().source())));
  document.line("bench_time",
                pause ? Object{}.add("stood_s", number(pause->total.seconds())).text() : "null");
  document.line("car", json::quoted(car_text(rate, now)));
  document.line("packets", text_of(rate.packets()));
  document.line("lost", text_of(car.link().lost_packets()));
  document.line("loss", number(car.link().loss()));
  document.line("rate_hz", number(rate.mean_rate_hz()));
  document.line("silent_ms", rate.ever() ? ms(rate.since_last(now)) : "null");
  document.line("age_ms", ages_json(car.link().ages().of(telemetry::Group::kEgo)));
  document.line("ages_ms", ages_by_class(car.link().ages()));
  document.line("ages_ms_by_group", ages_by_group(car.link().ages()));
  add_link(car, now, document);
  add_logs(car, document);
  document.add_fields(car.vehicle(), now);
  return document.text();
}

}  // namespace pitwall::publishers
