// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/text_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "basestation/publishers/text/link_text.hpp"
#include "basestation/state/value_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::publishers {
namespace {

using state::Quality;

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

std::string group_head(const telemetry::GroupRow& row, const state::FieldView& group) {
  constexpr std::array kMarks{' ', '~', '!', '-'};
  return padded(formatted("%c %-14s %8s", kMarks[static_cast<std::size_t>(group.quality)],
                          std::string{row.name}.c_str(), age_text(group.age).c_str()),
                kHeadWidth);
}

std::string cell_text(const telemetry::FieldRow& row, const state::FieldView& view,
                      const state::FieldView& group) {
  if (view.quality == Quality::kNever) return std::string{row.name} + ": -";
  std::string text = std::string{row.name} + ": " + state::value_text(row, view.value);
  if (!row.unit.empty() && row.unit != telemetry::FieldRow::kBitSet) {
    text += " " + std::string{row.unit};
  }
  if (view.age > group.age) text += " (" + age_text(view.age) + " ago)";
  return text;
}

void trim(std::string& line) { line.erase(line.find_last_not_of(' ') + 1); }

// Words in lines of the screen's width.
void add_words(const std::string& head, const std::vector<std::string>& words,
               std::vector<TextLine>& lines, Tone tone = Tone::kDim) {
  if (words.empty()) return;
  std::string line = head;
  for (const std::string& word : words) {
    if (line.size() + 1 + word.size() > kScreenColumns) {
      lines.push_back({line, tone});
      line = std::string(head.size(), ' ');
    }
    line += " " + word;
  }
  lines.push_back({line, tone});
}

// Cells in columns; a long one takes as many as it needs.
void add_group(const telemetry::GroupRow& row, const state::VehicleState& vehicle, Instant now,
               std::vector<TextLine>& lines) {
  const state::FieldView group = vehicle.group(row.group, now);
  const Tone tone = tone_of(group.quality);
  const auto [first, count] = telemetry::fields_of(row.group);
  std::string line = group_head(row, group);
  std::size_t used = 0;
  for (telemetry::FieldIndex i = first; i < first + count; ++i) {
    const std::string cell = cell_text(telemetry::kFields[i], vehicle.view(i, now), group);
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

std::vector<TextLine> group_lines(const state::VehicleState& vehicle, Instant now, bool all) {
  std::vector<TextLine> lines;
  std::vector<std::string> never, hidden;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (row.direction != telemetry::Direction::kDown) continue;
    const state::FieldView group = vehicle.group(row.group, now);
    if (group.quality == Quality::kNever) {
      never.emplace_back(row.name);
    } else if (shown(row, all)) {
      add_group(row, vehicle, now, lines);
    } else {
      hidden.push_back(std::string{row.name} + " " + age_text(group.age));
    }
  }
  add_words("with --all:", hidden, lines);
  add_words("not received yet:", never, lines);
  return lines;
}

// Whose time it is, where it is not the wall clock's.
TextLine bench_line(const transport::BenchPause& pause) {
  const double total_s = pause.total.seconds();
  return {pause.is_long()
              ? formatted("TIME      BENCH WAITS, %.1f s now, %.1f s in all; ages are of the time "
                          "it stands at",
                          pause.now.seconds(), total_s)
              : formatted("TIME      of a bench; it has stood %.1f s in all", total_s),
          Tone::kInverse};
}

// Whether the car's CAN bus is that of its database; nothing until the car has said so.
std::optional<TextLine> bus_line(const state::VehicleState& vehicle, Instant now) {
  const auto value = [&](telemetry::FieldIndex field) {
    const double reported = vehicle.view(field, now).value;
    return std::isnan(reported) ? 0.0 : reported;
  };
  const state::FieldView identity = vehicle.view(telemetry::field("bus.identity"), now);
  if (identity.quality == Quality::kNever) return std::nullopt;
  const std::string age = " (" + age_text(identity.age) + " ago)";
  const auto database = static_cast<std::uint32_t>(value(telemetry::field("bus.database")));
  const double id = value(telemetry::field("bus.differing_id"));
  switch (static_cast<int>(identity.value)) {
    case 1:
      return TextLine{formatted("CAN bus   as in the car's database %08x", database) + age,
                      Tone::kPlain};
    case 2:
      return TextLine{
          formatted("CAN bus   WRONG: id %.0f is not as in the car's database %08x; will not arm",
                    id, database) +
              age,
          Tone::kAlarm};
    default:
      return TextLine{formatted("CAN bus   listening, the car's database is %08x", database) + age,
                      Tone::kWarning};
  }
}

// One field as its value is said, with its unit; nothing to add where it was never received.
class FieldTexts {
 public:
  FieldTexts(const state::VehicleState& vehicle, Instant now) : vehicle_(vehicle), now_(now) {}
  std::string word(telemetry::FieldIndex at) const {
    const telemetry::FieldRow& row = telemetry::kFields[at];
    std::string text = state::value_text(row, vehicle_.view(at, now_).value);
    const bool unit = !row.unit.empty() && row.unit != telemetry::FieldRow::kBitSet;
    return unit ? text + " " + std::string{row.unit} : text;
  }
  bool ever(telemetry::FieldIndex at) const {
    return vehicle_.view(at, now_).quality != Quality::kNever;
  }
  double value(telemetry::FieldIndex at) const { return vehicle_.view(at, now_).value; }

 private:
  const state::VehicleState& vehicle_;
  Instant now_;
};

// What a receiver says of itself, what the car makes of it, and what became of its bytes.
void add_receiver(const FieldTexts& fields, std::size_t unit, std::vector<TextLine>& lines) {
  using telemetry::field;
  using telemetry::FieldIndex;
  using telemetry::Group;
  constexpr FieldIndex kFirst = telemetry::fields_of(Group::kGnss0).first;
  const FieldIndex first = telemetry::fields_of(unit == 0 ? Group::kGnss0 : Group::kGnss1).first;
  const auto of = [&](FieldIndex of_unit_0) { return first + of_unit_0 - kFirst; };
  const std::string head = "          gnss" + std::to_string(unit) + "  ";
  if (fields.ever(of(field("gnss0.position_verdict")))) {
    lines.push_back({head + " position: " + fields.word(of(field("gnss0.position_verdict"))) +
                         "   velocity: " + fields.word(of(field("gnss0.velocity_verdict"))) +
                         "   heading: " + fields.word(of(field("gnss0.heading_verdict"))),
                     Tone::kPlain});
    add_words(std::string(head.size(), ' '),
              {"satellites " + fields.word(of(field("gnss0.satellites"))),
               "  type " + fields.word(of(field("gnss0.type"))),
               "  sigma " + fields.word(of(field("gnss0.sigma"))),
               "  corrections " + fields.word(of(field("gnss0.differential_age"))) + " old",
               "  position " + fields.word(of(field("gnss0.position_age"))) + " old"},
              lines, Tone::kPlain);
  }
  constexpr FieldIndex kTraffic = telemetry::fields_of(Group::kReceivers).first;
  constexpr FieldIndex kPerUnit = telemetry::fields_of(Group::kReceivers).count / 2;
  static_assert(field("receivers.bytes_1") == kTraffic + kPerUnit);
  if (!fields.ever(kTraffic)) return;
  constexpr std::array<const char*, kPerUnit> kNames{
      "bytes", "logs", "bad checksum", "bad frame", "resynchronised", "refused", "lost"};
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kPerUnit; ++i)
    words.push_back((i == 0 ? "" : "  ") +
                    (kNames[i] + (" " + fields.word(kTraffic + unit * kPerUnit + i))));
  add_words(std::string(head.size(), ' '), words, lines, Tone::kPlain);
}

// Which sensors the operator has excluded, and what the car says of each receiver: nothing until
// the car has said so.
std::vector<TextLine> sensor_lines(const state::VehicleState& vehicle, Instant now) {
  using telemetry::field;
  const FieldTexts fields(vehicle, now);
  const double excluded = fields.value(field("localization.excluded"));
  if (!fields.ever(field("localization.excluded")) || std::isnan(excluded)) return {};
  std::vector<TextLine> lines;
  lines.push_back(
      {"sensors   excluded by the operator: " + fields.word(field("localization.excluded")),
       excluded > 0.0 ? Tone::kWarning : Tone::kPlain});
  lines.push_back({"          imu0: " + fields.word(field("localization.imu0_verdict")) +
                       "   imu1: " + fields.word(field("localization.imu1_verdict")) +
                       "   wheels: " + fields.word(field("localization.wheel_verdict")),
                   Tone::kPlain});
  for (const std::size_t unit : {0U, 1U}) add_receiver(fields, unit, lines);
  return lines;
}

// Of all streams that the car watches, those that are not as they should be.
void add_watchdogs(const state::VehicleState& vehicle, Instant now, std::vector<TextLine>& lines) {
  const FieldTexts fields(vehicle, now);
  const auto [first, count] = telemetry::fields_of(telemetry::Group::kStreams);
  if (!fields.ever(first)) return;
  constexpr double kNever = 1.0, kLate = 3.0, kLost = 4.0;
  static_assert(telemetry::label_at(telemetry::kBaseStates, 4) == "LOST");
  std::vector<std::string> words;
  bool bad = false;
  for (telemetry::FieldIndex i = first; i < first + count; ++i) {
    const double health = fields.value(i);
    if (!(health >= kLate) && health != kNever) continue;
    bad = bad || health >= kLost;
    words.push_back(std::string{telemetry::kFields[i].name} + " " + fields.word(i));
  }
  const Tone tone = bad ? Tone::kAlarm : words.empty() ? Tone::kPlain : Tone::kWarning;
  if (words.empty()) words.emplace_back("all streams are as they should be");
  add_words("watchdogs", words, lines, tone);
}

// Why the car stops or has stopped; nothing until it has said so.
std::optional<TextLine> stop_line(const state::VehicleState& vehicle, Instant now) {
  const FieldTexts fields(vehicle, now);
  constexpr auto kCause = telemetry::field("mode.first_stop_cause");
  if (!fields.ever(kCause)) return std::nullopt;
  const bool stops = fields.value(kCause) > 0.0;
  return TextLine{
      "stop      " + (stops ? "because: " + fields.word(kCause) : std::string{"no reason"}),
      stops ? Tone::kAlarm : Tone::kPlain};
}

}  // namespace

std::string text_view(const service::CarService& car, Instant now, const ViewOptions& options) {
  const std::string end = options.ansi ? std::string{kClearLine} + "\n" : "\n";
  std::vector<TextLine> lines;
  if (!options.title.empty()) lines.push_back({options.title, Tone::kInverse});
  for (TextLine& line : link_lines(car, now)) lines.push_back(std::move(line));
  if (options.pause) {
    const auto below_head = lines.begin() + (options.title.empty() ? 1 : 2);
    lines.insert(below_head, bench_line(*options.pause));
  }
  if (auto bus = bus_line(car.vehicle(), now)) lines.push_back(*std::move(bus));
  if (auto stop = stop_line(car.vehicle(), now)) lines.push_back(*std::move(stop));
  add_watchdogs(car.vehicle(), now, lines);
  for (TextLine& line : sensor_lines(car.vehicle(), now)) lines.push_back(std::move(line));
  lines.push_back({});
  for (TextLine& line : group_lines(car.vehicle(), now, options.all)) {
    lines.push_back(std::move(line));
  }
  std::string screen = options.ansi && !options.below ? kHome : "";
  for (const TextLine& line : lines) screen += styled(line, options.ansi) + end;
  if (options.ansi) screen += kClearRest;
  return screen;
}

}  // namespace pitwall::publishers
