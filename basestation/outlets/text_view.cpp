// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/text_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "basestation/outlets/value_text.hpp"

namespace pitwall::outlets {
namespace {

using picture::Quality;

constexpr std::size_t kColumnWidth = 72, kValueWidth = 26;
constexpr const char *kHome = "\x1b[H", *kClearLine = "\x1b[K", *kClearRest = "\x1b[J";
constexpr const char *kDim = "\x1b[2m", *kBold = "\x1b[1m", *kYellow = "\x1b[33m",
                     *kRed = "\x1b[1;31m", *kInverse = "\x1b[7m", *kPlain = "\x1b[0m";

struct Line {
  std::string text;
  const char* style = "";
};

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::string styled(const Line& line, std::size_t width, bool ansi) {
  const std::string text = padded(line.text, width);
  if (!ansi || *line.style == '\0') return text;
  return line.style + text + kPlain;
}

std::string age_text(const picture::FieldView& view) {
  if (view.quality == Quality::kNever) return "never";
  char text[32];
  if (view.age < seconds(10)) {
    std::snprintf(text, sizeof text, "%.0f ms", view.age.milliseconds());
  } else {
    std::snprintf(text, sizeof text, "%.0f s", view.age.seconds());
  }
  return text;
}

Line field_line(const telemetry::FieldRow& row, const picture::FieldView& view) {
  constexpr char kMarks[] = {' ', '~', '!', '-'};
  constexpr const char* kStyles[] = {"", kYellow, kDim, kDim};
  const auto quality = static_cast<std::size_t>(view.quality);
  const std::string value = value_text(row, view.value);
  constexpr int kWidth = static_cast<int>(kValueWidth);  // longer labels are cut
  char text[128];
  std::snprintf(text, sizeof text, "%c %-24s%*.*s %-6s %9s", kMarks[quality],
                std::string{row.name}.c_str(), kWidth, kWidth, value.c_str(),
                std::string{row.unit}.c_str(), age_text(view).c_str());
  return {text, kStyles[quality]};
}

std::vector<Line> field_lines(const picture::Picture& picture, Instant now) {
  std::vector<Line> lines;
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    const telemetry::FieldRow& row = telemetry::kFields[i];
    if (i == 0 || row.group != telemetry::kFields[i - 1].group) {
      lines.push_back(
          {std::string{telemetry::row_of(row.group).name}, kBold});
    }
    lines.push_back(field_line(row, picture.view(i, now)));
  }
  return lines;
}

// About half of the lines; a group is not torn apart.
std::size_t left_column_rows(const std::vector<Line>& lines) {
  std::size_t rows = (lines.size() + 1) / 2;
  while (rows < lines.size() && lines[rows].style != kBold) ++rows;
  return rows;
}

Line source_line(const intake::Station& station, Instant now) {
  const picture::Picture& picture = station.picture();
  if (!picture.ever()) return {"PITWALL   waiting for the first packet", kBold};
  if (station.link().lost(now)) {
    char text[120];
    std::snprintf(text, sizeof text,
                  "PITWALL   CAR LOST: not heard for %.1f s; all below is as old as that",
                  station.link().since_last(now).seconds());
    return {text, kRed};
  }
  if (picture.source() == telemetry::Source::kSimulation) {
    return {"PITWALL   *** SIMULATION ***   no real car", kInverse};
  }
  return {"PITWALL   REAL CAR", kBold};
}

// Whether the car's CAN bus is that of its database; nothing until the car has said so.
std::optional<Line> bus_line(const picture::Picture& picture, Instant now) {
  const auto value = [&](telemetry::FieldIndex field) {
    const double said = picture.view(field, now).value;
    return std::isnan(said) ? 0.0 : said;
  };
  const picture::FieldView identity = picture.view(telemetry::field("bus.identity"), now);
  if (identity.quality == Quality::kNever || std::isnan(identity.value)) return std::nullopt;
  char text[160];
  const auto database = static_cast<std::uint32_t>(value(telemetry::field("bus.database")));
  const double id = value(telemetry::field("bus.differing_id"));
  switch (static_cast<int>(identity.value)) {
    case 1:
      std::snprintf(text, sizeof text, "CAN bus   as in the car's database %08x", database);
      return Line{text, ""};
    case 2:
      std::snprintf(text, sizeof text,
                    "CAN bus   WRONG: id %.0f is not as in the car's database %08x; will not arm",
                    id, database);
      return Line{text, kRed};
    default:
      std::snprintf(text, sizeof text, "CAN bus   listening, the car's database is %08x", database);
      return Line{text, kYellow};
  }
}

std::string link_text(const intake::IntakeCounters& counters, const intake::LinkStats& link,
                      Instant now) {
  if (!link.ever()) return "link      nothing heard";
  char text[200];
  std::snprintf(text, sizeof text,
                "link      %.1f Hz   lost %llu (%.1f %%)   age p50 %.0f ms p99 %.0f ms   "
                "last packet %.0f ms ago",
                link.rate_hz(now), static_cast<unsigned long long>(counters.lost),
                100.0 * counters.loss(), link.ages().quantile(0.50).milliseconds(),
                link.ages().quantile(0.99).milliseconds(), link.since_last(now).milliseconds());
  return text;
}

// Up to the car: what was sent, and what the car says of it.
std::string uplink_text(const intake::Station& station, Instant now) {
  const intake::UplinkCounters& sent = station.uplink().counters();
  char text[160];
  std::snprintf(text, sizeof text, "uplink    heartbeats sent %llu   not sent %llu",
                static_cast<unsigned long long>(sent.sent),
                static_cast<unsigned long long>(sent.not_sent));
  const picture::FieldView trip = station.picture().view(telemetry::field("radio.round_trip"), now);
  if (trip.quality == Quality::kNever) return std::string{text} + "   round trip not known";
  char tail[80];
  std::snprintf(tail, sizeof tail, "   round trip %.1f ms, %s ago", trip.value,
                age_text(trip).c_str());
  return std::string{text} + tail;
}

std::string refused_text(const intake::IntakeCounters& counters) {
  std::string text = "refused   " + std::to_string(counters.refused_total());
  for (std::size_t i = 0; i < telemetry::kPacketErrors; ++i) {
    if (counters.refused[i] == 0) continue;
    text += std::string{"   "} + telemetry::text_of(static_cast<telemetry::PacketError>(i)) + " " +
            std::to_string(counters.refused[i]);
  }
  const std::pair<const char*, std::uint64_t> others[] = {{"duplicates", counters.duplicates},
                                                          {"late", counters.late},
                                                          {"other sender", counters.other_run}};
  for (const auto& [name, count] : others) {
    if (count > 0) text += std::string{"   "} + name + " " + std::to_string(count);
  }
  return text;
}

}  // namespace

std::string text_view(const intake::Station& station, Instant now, const ViewOptions& options) {
  const picture::Picture& picture = station.picture();
  const std::string end = options.ansi ? std::string{kClearLine} + "\n" : "\n";
  std::string screen = options.ansi ? kHome : "";
  screen += styled(source_line(station, now), 2 * kColumnWidth, options.ansi) + end;
  screen += link_text(station.counters(), station.link(), now) + end;
  screen += uplink_text(station, now) + end;
  screen += refused_text(station.counters()) + end;
  if (const auto bus = bus_line(picture, now))
    screen += styled(*bus, 2 * kColumnWidth, options.ansi) + end;
  screen += end;

  const std::vector<Line> lines = field_lines(picture, now);
  const std::size_t rows = left_column_rows(lines);
  for (std::size_t i = 0; i < rows; ++i) {
    screen += styled(lines[i], kColumnWidth, options.ansi);
    if (rows + i < lines.size()) screen += styled(lines[rows + i], 0, options.ansi);
    screen += end;
  }
  if (options.ansi) screen += kClearRest;
  return screen;
}

}  // namespace pitwall::outlets
