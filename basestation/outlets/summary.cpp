// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/summary.hpp"

#include <cstdio>

#include "basestation/outlets/value_text.hpp"

namespace pitwall::outlets {
namespace {

// Names, units and labels of the registry and of this file need no escapes.
std::string quoted(std::string_view text) { return "\"" + std::string{text} + "\""; }

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string milliseconds_text(Duration d) { return number(d.milliseconds()); }

std::string refusals(const intake::IntakeCounters& counters) {
  std::string text = "{";
  for (std::size_t i = 0; i < telemetry::kPacketErrors; ++i) {
    text += (i == 0 ? "" : ", ") +
            quoted(telemetry::text_of(static_cast<telemetry::PacketError>(i))) + ": " +
            std::to_string(counters.refused[i]);
  }
  return text + "}";
}

std::string field_json(const telemetry::FieldRow& row, const picture::FieldView& view) {
  std::string text = quoted(path_of(row)) + ": {\"unit\": " + quoted(row.unit) +
                     ", \"quality\": " + quoted(picture::text_of(view.quality));
  if (view.quality == picture::Quality::kNever) return text + ", \"value\": null}";
  text += ", \"value\": " + number(view.value) + ", \"age_ms\": " + milliseconds_text(view.age);
  if (!row.labels.empty()) text += ", \"text\": " + quoted(value_text(row, view.value));
  return text + "}";
}

const char* source_text(const picture::Picture& picture) {
  if (!picture.ever()) return "none";
  return picture.source() == telemetry::Source::kCar ? "car" : "simulation";
}

const char* car_text(const intake::LinkStats& link, Instant now) {
  if (!link.ever()) return "never heard";
  return link.lost(now) ? "lost" : "heard";
}

}  // namespace

std::string json_summary(const intake::Station& station, Instant now) {
  const picture::Picture& picture = station.picture();
  const intake::IntakeCounters& counters = station.counters();
  const intake::LinkStats& link = station.link();
  const intake::AgeHistogram& ages = link.ages();
  std::string text = "{\n";
  const auto line = [&](std::string_view key, const std::string& value) {
    text += "  " + quoted(key) + ": " + value + ",\n";
  };
  line("source", quoted(source_text(picture)));
  line("car", quoted(car_text(link, now)));
  line("packets", std::to_string(counters.accepted));
  line("received", std::to_string(counters.received));
  line("lost", std::to_string(counters.lost));
  line("duplicates", std::to_string(counters.duplicates));
  line("late", std::to_string(counters.late));
  line("other_run", std::to_string(counters.other_run));
  line("runs", std::to_string(counters.runs));
  line("refused", std::to_string(counters.refused_total()));
  line("refused_by_kind", refusals(counters));
  line("rate_hz", number(link.mean_rate_hz()));
  line("age_ms", "{\"p50\": " + milliseconds_text(ages.quantile(0.50)) +
                     ", \"p90\": " + milliseconds_text(ages.quantile(0.90)) +
                     ", \"p99\": " + milliseconds_text(ages.quantile(0.99)) +
                     ", \"max\": " + milliseconds_text(ages.largest()) + "}");
  line("heartbeats_sent", std::to_string(station.uplink().counters().sent));
  line("heartbeats_not_sent", std::to_string(station.uplink().counters().not_sent));
  text += "  \"fields\": {\n";
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    text += "    " + field_json(telemetry::kFields[i], picture.view(i, now)) +
            (i + 1 < telemetry::kFieldCount ? ",\n" : "\n");
  }
  return text + "  }\n}\n";
}

}  // namespace pitwall::outlets
