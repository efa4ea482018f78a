// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/metrics_text.hpp"

#include "basestation/publishers/metrics/exposition.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::publishers::metrics {
namespace {

struct FieldName {
  std::string_view group, name, unit;
};

FieldName name_of(state::FieldId id) {
  if (state::is_base(id)) {
    const state::BaseRow& row = state::row_of(state::base_field(id));
    return {row.group, row.name, row.unit};
  }
  const telemetry::FieldRow& row = telemetry::kFields[id];
  return {telemetry::row_of(row.group).name, row.name, row.unit};
}

double number(std::uint64_t count) { return static_cast<double>(count); }

void add_fields(const CarStatus& status, const std::string& car, Exposition& out) {
  for (std::size_t place = 0; place < kNumbers; ++place) {
    const FieldName field = name_of(id_at(place));
    const UnitName* const unit = unit_name(field.unit);
    CHECK(unit != nullptr);
    out.add(Kind::kGauge, "pitwall_field_" + std::string{unit->words}, unit->help,
            {{"car", car}, {"group", std::string{field.group}}, {"field", std::string{field.name}}},
            status.numbers[place] * unit->factor);
  }
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    out.add(Kind::kGauge, "pitwall_group_age_seconds",
            "age of the newest sample of a group of fields, the way to the base included",
            {{"car", car}, {"group", std::string{row.name}}},
            status.ages_s[telemetry::index_of(row.group)]);
  }
}

void add_alarms(const CarStatus& status, const std::string& car, Exposition& out) {
  for (const CarStatus::Alarms& alarms : status.alarms) {
    const Labels labels{{"car", car}, {"priority", alarms.priority}};
    out.add(Kind::kGauge, "pitwall_alarms", "alarms in the active list", labels,
            number(alarms.active));
    out.add(Kind::kGauge, "pitwall_alarms_unseen", "active alarms that nobody has acknowledged",
            labels, number(alarms.unacknowledged));
  }
}

void add_counts(const CarStatus& status, const std::string& car, Exposition& out) {
  for (const CarStatus::Count& count : status.counts) {
    out.add(Kind::kCounter, "pitwall_" + std::string{count.name} + "_total", count.help,
            {{"car", car}}, number(count.value));
  }
  for (const auto& [why, count] : status.refused) {
    out.add(Kind::kCounter, "pitwall_datagrams_refused_total",
            "datagrams that were not the car's, by the reason", {{"car", car}, {"why", why}},
            number(count));
  }
}

void add_publisher(const service::PublisherFigures& figures, const std::string& car,
                   Exposition& out) {
  const Labels labels{{"car", car}, {"publisher", figures.publisher}};
  const auto with = [&labels](std::string_view name, const std::string& value) {
    Labels more = labels;
    more.emplace_back(name, value);
    return more;
  };
  out.add(Kind::kCounter, "pitwall_publisher_sent_total", "messages that a publisher gave away",
          labels, number(figures.sent));
  out.add(Kind::kCounter, "pitwall_publisher_failed_total",
          "messages that the network did not take", labels, number(figures.failed));
  out.add(Kind::kGauge, "pitwall_publisher_clients", "readers that a publisher knows of", labels,
          number(figures.clients));
  for (const auto& [topic, count] : figures.dropped) {
    out.add(Kind::kCounter, "pitwall_publisher_dropped_total",
            "messages that were lost because a reader or the network was too slow",
            with("topic", topic), number(count));
  }
  for (const auto& [what, count] : figures.refused) {
    out.add(Kind::kCounter, "pitwall_publisher_refused_total",
            "what readers asked for and did not get", with("what", what), number(count));
  }
}

void add_web(const web::WebCounters& web, Exposition& out) {
  const auto count = [&out](std::string_view name, std::string_view help, std::uint64_t value) {
    out.add(Kind::kCounter, name, help, {}, number(value));
  };
  out.add(Kind::kGauge, "pitwall_web_consoles", "consoles that are connected", {},
          number(web.joined - web.left));
  count("pitwall_web_connections_total", "connections to the web server", web.connections);
  count("pitwall_web_connections_refused_total", "connections that there was no room for",
        web.refused_room);
  count("pitwall_web_waiting_closed_total", "silent connections closed for newer ones",
        web.closed_waiting);
  count("pitwall_web_places_refused_total", "consoles that there was no place for",
        web.refused_places);
  count("pitwall_web_short_refused_total", "clients refused: memory or descriptors ran short",
        web.refused_short);
  count("pitwall_web_short_closed_total", "consoles closed: memory ran short", web.closed_short);
  count("pitwall_web_revoked_total", "clients closed: their token no longer holds",
        web.closed_revoked);
  count("pitwall_web_tls_failed_total", "connections that did not become TLS", web.refused_tls);
  count("pitwall_web_malformed_total", "malformed HTTP requests", web.bad_http);
  count("pitwall_web_refused_total", "HTTP requests answered 4xx", web.refused_http);
  count("pitwall_web_requests_total", "messages that consoles sent", web.texts_received);
  count("pitwall_web_messages_total", "messages sent to consoles", web.messages_sent);
  count("pitwall_web_sent_bytes_total", "bytes sent to consoles", web.bytes_sent);
  count("pitwall_web_pictures_dropped_total", "pictures lost by consoles that did not read",
        web.pictures_dropped);
  count("pitwall_web_unread_closed_total", "consoles closed because they left too much unread",
        web.closed_unread);
  count("pitwall_web_posts_dropped_total", "messages that the web thread had no room for",
        web.posts_dropped);
  count("pitwall_web_faults_total", "exceptions of the web libraries, survived", web.faults);
}

}  // namespace

std::string metrics_text(std::span<const CarStatus> cars,
                         const std::optional<web::WebCounters>& web,
                         const std::optional<transport::BenchPause>& pause) {
  Exposition out;
  for (const CarStatus& status : cars) {
    const std::string car = std::to_string(status.car);
    out.add(Kind::kGauge, "pitwall_car_info",
            "always 1; which car it is, and whether it is REAL, a simulation (HIL) or none (NONE)",
            {{"car", car}, {"name", status.name}, {"mode", status.mode}}, 1.0);
    out.add(Kind::kGauge, "pitwall_history_bytes", "values that the base keeps of the last hour",
            {{"car", car}}, number(status.history_bytes));
    add_counts(status, car, out);
    add_alarms(status, car, out);
    for (const service::PublisherFigures& figures : status.publishers)
      add_publisher(figures, car, out);
    add_fields(status, car, out);
  }
  if (web) add_web(*web, out);
  if (pause) {
    out.add(Kind::kCounter, "pitwall_bench_time_stood_seconds_total",
            "wall clock for which bench time stood; only of a base that goes by bench time", {},
            pause->total.seconds());
  }
  return out.text();
}

}  // namespace pitwall::publishers::metrics
