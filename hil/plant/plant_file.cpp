// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/plant_file.hpp"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hil/plant/entries.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::plant {
namespace {

using plant::Params;

constexpr std::string_view kBuiltIn = "av21";

struct Reading {
  PlantFile file;
  std::map<const Entry*, std::string> places;  // of the values that are written
};

bool says_something(const std::string& text) {
  return text.find_first_not_of(" \t\n") != std::string::npos;
}

std::vector<double> numbers(yaml::StrictMap& map, const char* key, const Entry& entry, double min,
                            double max) {
  if (entry.count == 1) return {map.number(key, min, max)};
  return map.numbers(key, entry.count, entry.count, min, max);
}

bool in_order(const Params& p, const Params& spread, const Entry& entry, double way) {
  const auto at = [&](std::size_t i) {
    return value_of(p, entry, i) + way * value_of(spread, entry, i);
  };
  for (std::size_t i = 1; i < entry.count; ++i) {
    const bool rises = at(i) > at(i - 1), falls = at(i) < at(i - 1);
    if (entry.order == Order::kRising && !rises) return false;
    if (entry.order == Order::kFalling && !falls) return false;
  }
  return true;
}

void read_spread(yaml::StrictMap& map, const Entry& entry, PlantFile& file) {
  const std::vector<double> spread = numbers(map, "spread", entry, 0.0, entry.max - entry.min);
  for (std::size_t i = 0; i < entry.count; ++i) {
    const double value = value_of(file.params, entry, i);
    if (value - spread[i] < entry.min || value + spread[i] > entry.max)
      map.fail("spread", "value plus or minus spread leaves the allowed range");
    entry.at(file.spread, i) = spread[i];
  }
}

void read_entry(yaml::StrictMap map, const Entry& entry, Reading& reading) {
  PlantFile& file = reading.file;
  const std::vector<double> value = numbers(map, "value", entry, entry.min, entry.max);
  for (std::size_t i = 0; i < entry.count; ++i) entry.at(file.params, i) = value[i];
  if (!says_something(map.text("source"))) map.fail("source", "is empty");
  if (map.has("spread")) read_spread(map, entry, file);
  for (const double way : {0.0, -1.0, 1.0})
    if (!in_order(file.params, file.spread, entry, way))
      map.fail(way == 0.0 ? "value" : "spread", entry.order == Order::kRising
                                                    ? "must rise from entry to entry"
                                                    : "must fall from entry to entry");
  reading.places[&entry] = map.place("value");
  map.finish();
}

Structure read_structure(yaml::StrictMap& root) {
  const std::string name = root.text_or("structure", std::string(kStructures.front().name));
  std::string known;
  for (const NamedStructure& one : kStructures) {
    if (one.name == name) return one.structure;
    known += (known.empty() ? "" : ", ") + std::string(one.name);
  }
  root.fail("structure", "\"" + name + "\" is not one of: " + known);
}

void refuse_section_of_another(yaml::StrictMap& root, const Entry& entry) {
  for (const NamedStructure& one : kStructures)
    if (entry.only_of == one.structure && root.has(std::string(entry.section)))
      root.fail(std::string(entry.section), "needs `structure: " + std::string(one.name) + "`");
}

void read_sections(yaml::StrictMap& root, bool based, Reading& reading) {
  std::optional<yaml::StrictMap> section;
  std::string_view name;
  for (const Entry& entry : entries()) {
    if (!belongs(entry, reading.file.params.structure)) {
      refuse_section_of_another(root, entry);
      continue;
    }
    if (entry.section != name) {
      name = entry.section;
      const std::string key{name};
      section = based ? root.optional_map(key) : root.map(key);
    }
    const std::string key{entry.key};
    if (!section || (based && !section->has(key))) continue;
    try {
      read_entry(section->map(key), entry, reading);
    } catch (const yaml::InputError& e) {
      const std::string path = std::string(name) + "." + key + ": ";
      throw yaml::InputError(Problem{e.problem.place, path + e.problem.what});
    }
  }
}

const Entry& entry_of(std::string_view section, std::string_view key) {
  for (const Entry& entry : entries())
    if (entry.section == section && entry.key == key) return entry;
  CHECK(false);
}

[[noreturn]] void contradict(const Reading& reading, std::initializer_list<const Entry*> between,
                             const std::string& why) {
  std::string names, place;
  for (const Entry* entry : between) {
    names +=
        (names.empty() ? "" : ", ") + std::string(entry->section) + "." + std::string(entry->key);
    if (const auto at = reading.places.find(entry); at != reading.places.end()) place = at->second;
  }
  throw yaml::InputError(Problem{place, names + ": " + why});
}

struct Bound {
  std::string_view section, key;
};

// The first stays below the second wherever both lie within their spreads.
struct Relation {
  Bound less, more;
  const char* why;
};

constexpr std::array kRelations{
    Relation{{"chassis", "track_front_m"},
             {"chassis", "width_m"},
             "the front wheels would stand outside the car"},
    Relation{{"chassis", "track_rear_m"},
             {"chassis", "width_m"},
             "the rear wheels would stand outside the car"},
    Relation{
        {"fuel", "start_kg"}, {"chassis", "mass_kg"}, "the fuel would weigh more than the car"},
    Relation{{"steering", "quantum_rad"},
             {"steering", "angle_max_rad"},
             "one step of the command would leave the range of the steering"},
    Relation{{"engine", "idle_rpm"},
             {"engine", "launch_rpm"},
             "the clutch would hold the engine below its idle speed"},
    Relation{{"engine", "launch_rpm"},
             {"engine", "limiter_rpm"},
             "the clutch would hold the engine above its limiter"},
    Relation{{"thermal", "ambient_c"}, {"thermal", "working_c"}, "temperatures must rise"},
    Relation{{"thermal", "working_c"}, {"thermal", "hot_c"}, "temperatures must rise"},
    Relation{{"thermal", "hot_c"}, {"thermal", "ruined_c"}, "temperatures must rise"},
};

double least(const PlantFile& f, const Entry& e, std::size_t i = 0) {
  return value_of(f.params, e, i) - value_of(f.spread, e, i);
}
double most(const PlantFile& f, const Entry& e, std::size_t i = 0) {
  return value_of(f.params, e, i) + value_of(f.spread, e, i);
}

void check_relations(const Reading& reading) {
  for (const Relation& relation : kRelations) {
    const Entry& less = entry_of(relation.less.section, relation.less.key);
    const Entry& more = entry_of(relation.more.section, relation.more.key);
    if (most(reading.file, less) >= least(reading.file, more))
      contradict(reading, {&less, &more}, relation.why);
  }
}

void check_body(const Reading& reading) {
  const PlantFile& f = reading.file;
  const Entry& front = entry_of("chassis", "front_axle_m");
  const Entry& rear = entry_of("chassis", "rear_axle_m");
  const Entry& length = entry_of("chassis", "length_m");
  if (most(f, front) + most(f, rear) >= least(f, length))
    contradict(reading, {&front, &rear, &length}, "the axles would stand outside the car");
  const Entry& mass = entry_of("chassis", "mass_kg");
  const Entry& inertia = entry_of("chassis", "yaw_inertia_kgm2");
  const double half_m = 0.5 * least(f, length);
  if (most(f, inertia) >= least(f, mass) * half_m * half_m)
    contradict(reading, {&mass, &length, &inertia}, "more than with all the mass at the ends");
}

void check_engine(const Reading& reading) {
  const PlantFile& f = reading.file;
  const Entry& curve = entry_of("engine", "full_throttle_rpm");
  const Entry& limiter = entry_of("engine", "limiter_rpm");
  if (least(f, curve, curve.count - 1) < most(f, limiter))
    contradict(reading, {&curve, &limiter}, "the torque curve ends below the limiter");
  constexpr std::array kShares{"share_at_30_percent", "share_at_50_percent", "share_at_65_percent",
                               "share_at_70_percent", "share_at_80_percent"};
  for (std::size_t i = 1; i < kShares.size(); ++i) {
    const Entry& narrow = entry_of("engine", kShares[i - 1]);
    const Entry& wide = entry_of("engine", kShares[i]);
    for (std::size_t row = 0; row < wide.count; ++row)
      if (most(f, narrow, row) > least(f, wide, row))
        contradict(reading, {&narrow, &wide}, "a wider throttle would give less torque");
  }
}

PlantFile read_root(yaml::StrictMap& root) {
  Reading reading;
  if (root.integer("schema", 0, 1000) != 1) root.fail("schema", "this bench reads schema 1");
  reading.file.name = root.text("name");
  const std::string base = root.text_or("base", "");
  if (root.has("base") && base != kBuiltIn)
    root.fail("base", "\"" + base + "\" is not built in; built in: " + std::string(kBuiltIn));
  reading.file.params.structure = read_structure(root);
  for (const Entry& entry : entries())
    for (std::size_t i = 0; i < entry.count; ++i) entry.at(reading.file.spread, i) = 0.0;
  read_sections(root, !base.empty(), reading);
  check_relations(reading);
  check_body(reading);
  check_engine(reading);
  return reading.file;
}

// FNV-1a: names the stream of an entry.
std::uint64_t hash_of(const Entry& entry) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const std::string_view part : {entry.section, std::string_view{"."}, entry.key})
    for (const char c : part) hash = (hash ^ static_cast<unsigned char>(c)) * 0x00000100000001B3ULL;
  return hash;
}

}  // namespace

Result<PlantFile, Problem> read_plant(const std::string& text, const std::string& name) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, read_root);
}

plant::Params drawn(const PlantFile& file, std::uint64_t seed) {
  Params p = file.params;
  for (const Entry& entry : entries()) {
    Random random{seed ^ hash_of(entry)};
    const double way = 2.0 * random.uniform() - 1.0;
    for (std::size_t i = 0; i < entry.count; ++i)
      entry.at(p, i) += way * value_of(file.spread, entry, i);
  }
  return p;
}

}  // namespace pitwall::plant
