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
constexpr int kVersion = 1;
constexpr std::size_t kNumbersInPoint = 5;
constexpr std::size_t kDigitsShown = 12;  // of a fingerprint

std::string line_text(const Raceline& line) {
  std::string out = "  {\"name\": " + json::quoted(line.name) +
                    ", \"region\": " + json::quoted(text_of(line.region)) +
                    formatted(", \"length_m\": %.7f, \"points\": [\n", line.length_m);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const RacelinePoint& p = line.points[i];
    out += formatted("    [%.7f, %.7f, %.9f, %.9f, %.9f]%s\n", p.x_m, p.y_m, p.yaw_rad,
                     p.curvature_per_m, p.bank_rad, i + 1 < line.points.size() ? "," : "");
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
  for (const json::JsonValue& row : value.items("points")) {
    const auto& numbers = row.items();
    if (numbers.size() != kNumbersInPoint)
      return refuse(name + ": " + line.name,
                    formatted("point %zu has %zu numbers, expected %zu", line.points.size() + 1,
                              numbers.size(), kNumbersInPoint));
    line.points.push_back({numbers[0].number(), numbers[1].number(), numbers[2].number(),
                           numbers[3].number(), numbers[4].number()});
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
                    ",\n\"lines\": [\n";
  for (std::size_t i = 0; i < bank.lines.size(); ++i)
    out += line_text(bank.lines[i]) + (i + 1 < bank.lines.size() ? ",\n" : "\n");
  return out + "]}\n";
}

Result<RacelineBank, Problem> read_bank(std::string_view text, const std::string& name,
                                        const world::TrackDescription& description,
                                        const world::TrackMap& track, const CarLimits& car) {
  const auto root = json::JsonValue::parse(text, name);
  if (!root) return Unexpected{root.error()};
  RacelineBank bank{track.name(), fingerprint_of(description), {}, name};
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
  return bank;
}

}  // namespace pitwall::raceline
