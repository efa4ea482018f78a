// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_file.hpp"

#include <algorithm>
#include <utility>

#include "protocol/json/json_text.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/vocabulary/text.hpp"
#include "vehicle/raceline/track_fingerprint.hpp"

namespace pitwall::raceline {
namespace {

constexpr const char* kKind = "pitwall raceline bank";
constexpr int kVersion = 2;
constexpr std::size_t kNumbersOfPlace = 5, kNumbersWithLap = 9;
constexpr double kTyreShareLeast = 0.05;  // as in a car file
constexpr std::size_t kDigitsShown = 12;  // of a fingerprint

std::string lap_text(const LapPoint& p) {
  return formatted(", %.6f, %.6f, %u, %.6f", p.speed_mps, p.accel_mps2, unsigned{p.gear}, p.time_s);
}

// What is no gear is none that a car has.
std::uint8_t gear_of(double number) {
  return number >= 0.0 && number <= 255.0 ? static_cast<std::uint8_t>(number) : 255;
}

std::string line_text(const Raceline& line) {
  std::string out = "  {\"name\": " + json::quoted(line.name) +
                    ", \"region\": " + json::quoted(text_of(line.region)) +
                    formatted(", \"length_m\": %.7f", line.length_m);
  if (!line.lap.empty()) out += formatted(", \"lap_s\": %.6f", line.lap_s);
  out += ", \"points\": [\n";
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const RacelinePoint& p = line.points[i];
    out += formatted("    [%.7f, %.7f, %.9f, %.9f, %.9f", p.x_m, p.y_m, p.yaw_rad,
                     p.curvature_per_m, p.bank_rad);
    if (!line.lap.empty()) out += lap_text(line.lap[i]);
    out += i + 1 < line.points.size() ? "],\n" : "]\n";
  }
  return out + "  ]}";
}

Result<Raceline, Problem> read_line(const json::JsonValue& value, const std::string& name) {
  Raceline line;
  line.name = value.text("name");
  if (line.name.empty()) return refuse(name, "a line without a name");
  const auto region = region_of(value.text("region"));
  if (!region)
    return refuse(name + ": " + line.name, formatted("the region is \"%s\", expected inner, outer, "
                                                     "pit or track",
                                                     value.text("region").c_str()));
  line.region = *region;
  line.length_m = value.number("length_m");
  const bool has_lap = value.find("lap_s") != nullptr;
  if (has_lap) line.lap_s = value.number("lap_s");
  const std::size_t expected = has_lap ? kNumbersWithLap : kNumbersOfPlace;
  for (const json::JsonValue& row : value.items("points")) {
    const auto& numbers = row.items();
    if (numbers.size() != expected)
      return refuse(name + ": " + line.name,
                    formatted("point %zu has %zu numbers, expected %zu", line.points.size() + 1,
                              numbers.size(), expected));
    line.points.push_back({numbers[0].number(), numbers[1].number(), numbers[2].number(),
                           numbers[3].number(), numbers[4].number()});
    if (has_lap)
      line.lap.push_back({.speed_mps = numbers[5].number(),
                          .accel_mps2 = numbers[6].number(),
                          .time_s = numbers[8].number(),
                          .gear = gear_of(numbers[7].number())});
  }
  return line;
}

// Whether it is a bank at all, and of this track.
std::optional<Problem> fault_of_head(const json::JsonValue& root, const std::string& name,
                                     const std::string& track, const std::string& fingerprint) {
  if (root.text("kind") != kKind)
    return Problem{name, formatted("is not a bank of racelines: expected \"kind\": \"%s\"", kKind)};
  if (root.number("version") != kVersion)
    return Problem{name,
                   "is of version " + shortest(root.number("version")) +
                       formatted(", expected %d: make it again with pitwall-raceline", kVersion)};
  const std::string of = root.text("track_fingerprint");
  if (of == fingerprint) return std::nullopt;
  const std::string revision = root.text("track") == track ? "another revision of " : "";
  return Problem{name, "is of " + revision + "track " + root.text("track") + " (fingerprint " +
                           of.substr(0, kDigitsShown) + "), expected " + track + " (" +
                           fingerprint.substr(0, kDigitsShown) +
                           "): make it again with pitwall-raceline"};
}

}  // namespace

std::string to_json(const RacelineBank& bank) {
  std::string out = "{\"kind\": " + json::quoted(kKind) + formatted(", \"version\": %d", kVersion) +
                    ", \"track\": " + json::quoted(bank.track) +
                    ",\n\"track_fingerprint\": " + json::quoted(bank.track_fingerprint) +
                    formatted(",\n\"tyre_share\": %.6f,\n\"lines\": [\n", bank.tyre_share);
  for (std::size_t i = 0; i < bank.lines.size(); ++i)
    out += line_text(bank.lines[i]) + (i + 1 < bank.lines.size() ? ",\n" : "\n");
  return out + "]}\n";
}

Result<RacelineBank, Problem> read_bank(std::string_view text, const std::string& name,
                                        const world::TrackDescription& description,
                                        const world::TrackMap& track, const CarLimits& car) {
  const auto root = json::JsonValue::parse(text, name);
  if (!root) return Unexpected{root.error()};
  RacelineBank bank{.track = track.name(),
                    .track_fingerprint = fingerprint_of(description),
                    .lines = {},
                    .tyre_share = root->number("tyre_share"),
                    .source = name};
  if (auto problem = fault_of_head(*root, name, bank.track, bank.track_fingerprint))
    return Unexpected{*std::move(problem)};
  const Lanes lanes{track};
  for (const json::JsonValue& value : root->items("lines")) {
    auto line = read_line(value, name);
    if (!line) return Unexpected{line.error()};
    if (std::ranges::find(bank.lines, line->name, &Raceline::name) != bank.lines.end())
      return refuse(name + ": " + line->name, "two lines of this name");
    if (line->region == Region::kPitLane && !track.pit())
      return refuse(name + ": " + line->name, "a line through a pit lane that the track lacks");
    const auto figures = check_raceline(*line, lanes, car);
    if (!figures) return refuse(name + ": " + figures.error().place, figures.error().what);
    bank.lines.push_back(*std::move(line));
  }
  if (bank.lines.empty()) return refuse(name, "has no line");
  if (!(bank.tyre_share >= kTyreShareLeast && bank.tyre_share <= 1.0))
    return refuse(name, "tyre_share is " + shortest(bank.tyre_share) + ", allowed " +
                            shortest(kTyreShareLeast) + " to 1");
  return bank;
}

}  // namespace pitwall::raceline
