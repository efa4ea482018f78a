// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/text_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "basestation/outlets/link_text.hpp"
#include "basestation/outlets/value_text.hpp"

namespace pitwall::outlets {
namespace {

using picture::Quality;

constexpr std::size_t kHeadWidth = 26, kCellWidth = 29, kCells = 4;
static_assert(kHeadWidth + kCells * kCellWidth <= kScreenColumns);
constexpr const char *kHome = "\x1b[H", *kClearLine = "\x1b[K", *kClearRest = "\x1b[J",
                     *kPlain = "\x1b[0m";
// By Tone.
constexpr std::array kStyles{"", "\x1b[1m", "\x1b[2m", "\x1b[33m", "\x1b[1;31m", "\x1b[7m"};

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::string styled(const TextLine& line, bool ansi) {
  const char* const style = kStyles[static_cast<std::size_t>(line.tone)];
  if (!ansi || *style == '\0') return line.text;
  const bool inverse = line.tone == Tone::kInverse || line.tone == Tone::kAlarm;
  return style + (inverse ? padded(line.text, kScreenColumns) : line.text) + kPlain;
}

Tone tone_of(Quality quality) {
  switch (quality) {
    case Quality::kFresh:
      return Tone::kPlain;
    case Quality::kLate:
      return Tone::kWarning;
    case Quality::kStale:
    case Quality::kNever:
      return Tone::kDim;
  }
  return Tone::kDim;
}

std::string group_head(const telemetry::GroupRow& row, const picture::FieldView& group) {
  constexpr std::array kMarks{' ', '~', '!', '-'};
  char text[64];
  std::snprintf(text, sizeof text, "%c %-14s %8s", kMarks[static_cast<std::size_t>(group.quality)],
                std::string{row.name}.c_str(), age_text(group.age).c_str());
  return padded(text, kHeadWidth);
}

std::string cell_text(const telemetry::FieldRow& row, const picture::FieldView& view,
                      const picture::FieldView& group) {
  if (view.quality == Quality::kNever) return std::string{row.name} + ": -";
  std::string text = std::string{row.name} + ": " + value_text(row, view.value);
  if (!row.unit.empty() && row.unit != telemetry::FieldRow::kBitSet) {
    text += " " + std::string{row.unit};
  }
  if (view.age > group.age) text += " (" + age_text(view.age) + " ago)";
  return text;
}

void trim(std::string& line) { line.erase(line.find_last_not_of(' ') + 1); }

// Words in lines of the screen's width.
void add_words(const std::string& head, const std::vector<std::string>& words,
               std::vector<TextLine>& lines) {
  if (words.empty()) return;
  std::string line = head;
  for (const std::string& word : words) {
    if (line.size() + 1 + word.size() > kScreenColumns) {
      lines.push_back({line, Tone::kDim});
      line = std::string(head.size(), ' ');
    }
    line += " " + word;
  }
  lines.push_back({line, Tone::kDim});
}

// Cells in columns; a long one takes as many as it needs.
void add_group(const telemetry::GroupRow& row, const picture::Picture& picture, Instant now,
               std::vector<TextLine>& lines) {
  const picture::FieldView group = picture.group(row.group, now);
  const Tone tone = tone_of(group.quality);
  const auto [first, count] = telemetry::fields_of(row.group);
  std::string line = group_head(row, group);
  std::size_t used = 0;
  for (telemetry::FieldIndex i = first; i < first + count; ++i) {
    const std::string cell = cell_text(telemetry::kFields[i], picture.view(i, now), group);
    const std::size_t width = std::min((cell.size() + 1) / kCellWidth + 1, kCells);
    if (used + width > kCells) {
      trim(line);
      lines.push_back({line, tone});
      line = std::string(kHeadWidth, ' ');
      used = 0;
    }
    line += padded(cell, width * kCellWidth);
    used += width;
  }
  trim(line);
  lines.push_back({line, tone});
}

bool shown(const telemetry::GroupRow& row, bool all) {
  if (row.direction != telemetry::Direction::kDown) return false;
  return all || row.priority == telemetry::Class::kSafety ||
         row.priority == telemetry::Class::kMotion || row.group == telemetry::Group::kFaults;
}

std::vector<TextLine> group_lines(const picture::Picture& picture, Instant now, bool all) {
  std::vector<TextLine> lines;
  std::vector<std::string> never, hidden;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (row.direction != telemetry::Direction::kDown) continue;
    const picture::FieldView group = picture.group(row.group, now);
    if (group.quality == Quality::kNever) {
      never.emplace_back(row.name);
    } else if (shown(row, all)) {
      add_group(row, picture, now, lines);
    } else {
      hidden.push_back(std::string{row.name} + " " + age_text(group.age));
    }
  }
  add_words("with --all:", hidden, lines);
  add_words("never heard:", never, lines);
  return lines;
}

// Whether the car's CAN bus is that of its database; nothing until the car has said so.
std::optional<TextLine> bus_line(const picture::Picture& picture, Instant now) {
  const auto value = [&](telemetry::FieldIndex field) {
    const double said = picture.view(field, now).value;
    return std::isnan(said) ? 0.0 : said;
  };
  const picture::FieldView identity = picture.view(telemetry::field("bus.identity"), now);
  if (identity.quality == Quality::kNever) return std::nullopt;
  char text[160];
  const std::string age = " (" + age_text(identity.age) + " ago)";
  const auto database = static_cast<std::uint32_t>(value(telemetry::field("bus.database")));
  const double id = value(telemetry::field("bus.differing_id"));
  switch (static_cast<int>(identity.value)) {
    case 1:
      std::snprintf(text, sizeof text, "CAN bus   as in the car's database %08x", database);
      return TextLine{text + age, Tone::kPlain};
    case 2:
      std::snprintf(text, sizeof text,
                    "CAN bus   WRONG: id %.0f is not as in the car's database %08x; will not arm",
                    id, database);
      return TextLine{text + age, Tone::kAlarm};
    default:
      std::snprintf(text, sizeof text, "CAN bus   listening, the car's database is %08x", database);
      return TextLine{text + age, Tone::kWarning};
  }
}

// Which sensors the operator has excluded, and what the car says of each receiver: nothing until
// the car has said so.
std::vector<TextLine> sensor_lines(const picture::Picture& picture, Instant now) {
  using telemetry::field;
  const picture::FieldView excluded = picture.view(field("localization.excluded"), now);
  if (excluded.quality == Quality::kNever || std::isnan(excluded.value)) return {};
  const auto word = [&](telemetry::FieldIndex at) {
    return value_text(telemetry::kFields[at], picture.view(at, now).value);
  };
  const bool some = excluded.value > 0.0;
  std::vector<TextLine> lines;
  lines.push_back({"sensors   excluded by the operator: " + word(field("localization.excluded")),
                   some ? Tone::kWarning : Tone::kPlain});
  lines.push_back({"          imu0: " + word(field("localization.imu0_verdict")) +
                       "   imu1: " + word(field("localization.imu1_verdict")) +
                       "   wheels: " + word(field("localization.wheel_verdict")),
                   Tone::kPlain});
  const auto receiver = [&](const char* name, telemetry::FieldIndex position,
                            telemetry::FieldIndex velocity, telemetry::FieldIndex heading) {
    if (picture.view(position, now).quality == Quality::kNever) return;
    lines.push_back({std::string{"          "} + name + "   position: " + word(position) +
                         "   velocity: " + word(velocity) + "   heading: " + word(heading),
                     Tone::kPlain});
  };
  receiver("gnss0", field("gnss0.position_verdict"), field("gnss0.velocity_verdict"),
           field("gnss0.heading_verdict"));
  receiver("gnss1", field("gnss1.position_verdict"), field("gnss1.velocity_verdict"),
           field("gnss1.heading_verdict"));
  return lines;
}

}  // namespace

std::string text_view(const intake::Station& station, Instant now, const ViewOptions& options) {
  const std::string end = options.ansi ? std::string{kClearLine} + "\n" : "\n";
  std::vector<TextLine> lines = link_lines(station, now);
  if (auto bus = bus_line(station.picture(), now)) lines.push_back(*std::move(bus));
  for (TextLine& line : sensor_lines(station.picture(), now)) lines.push_back(std::move(line));
  lines.push_back({});
  for (TextLine& line : group_lines(station.picture(), now, options.all)) {
    lines.push_back(std::move(line));
  }
  std::string screen = options.ansi ? kHome : "";
  for (const TextLine& line : lines) screen += styled(line, options.ansi) + end;
  if (options.ansi) screen += kClearRest;
  return screen;
}

}  // namespace pitwall::outlets
