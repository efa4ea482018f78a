// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/manifest.hpp"

#include <array>
#include <utility>

#include "protocol/vocabulary/check.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::can {
namespace {

constexpr double kMaxPeriod_ms = 3'600'000.0;
constexpr double kMaxSlew_per_s = 1e12;
constexpr std::uint8_t kMaxCounterBits = 16;

constexpr std::array<std::pair<const char*, Direction>, 2> kDirections{
    {{"from_car", Direction::kFromCar}, {"to_car", Direction::kToCar}}};
constexpr std::array<std::pair<const char*, SafetyClass>, 4> kClasses{
    {{"information", SafetyClass::kInformation},
     {"status", SafetyClass::kStatus},
     {"actuator", SafetyClass::kActuator},
     {"race_control", SafetyClass::kRaceControl}}};

template <class Choices>
auto choice(yaml::StrictMap& map, const std::string& key, const Choices& choices) {
  const std::string text = map.text(key);
  std::string known;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    known += std::string(known.empty() ? "" : ", ") + name;
  }
  map.fail(key, "\"" + text + "\" is none of " + known);
}

ManifestMessage message(const std::string& name, yaml::StrictMap map) {
  ManifestMessage m;
  m.name = name;
  m.place = map.place();
  m.direction = choice(map, "direction", kDirections);
  m.safety = choice(map, "safety", kClasses);
  m.required = map.flag_or("required", true);
  m.period = from_seconds(map.number("period_ms", 0.1, kMaxPeriod_ms) * 1e-3);
  m.timeout = from_seconds(map.number("timeout_ms", 0.1, 10 * kMaxPeriod_ms) * 1e-3);
  if (m.timeout <= m.period) map.fail("timeout_ms", "must be longer than the period");
  m.counter = map.text_or("counter", "");
  m.counter_place = map.place("counter");
  if (auto slews = map.optional_map("slew_per_s")) {
    for (const std::string& signal : slews->keys()) {
      const double limit = slews->number(signal, 0.0, kMaxSlew_per_s);
      if (!(limit > 0.0)) slews->fail(signal, "a rate of change must be more than 0");
      m.slews.push_back({signal, limit, slews->place(signal)});
    }
  }
  return m;
}

IdRange id_range(yaml::StrictMap& map) {
  IdRange range;
  range.first = static_cast<std::uint32_t>(map.integer("first", 0, kMaxStandardId));
  range.last = static_cast<std::uint32_t>(map.integer("last", range.first, kMaxStandardId));
  return range;
}

Manifest manifest_of(yaml::StrictMap& root) {
  Manifest manifest;
  manifest.database = root.text("database");
  manifest.revision = root.text("revision");
  manifest.ignored_place = root.place("ignore_ids");
  if (root.has("ignore_ids")) {
    for (yaml::StrictMap& range : root.maps("ignore_ids")) {
      manifest.ignored.push_back(id_range(range));
    }
  }
  yaml::StrictMap messages = root.map("messages");
  for (const std::string& name : messages.keys()) {
    manifest.messages.push_back(message(name, messages.map(name)));
  }
  return manifest;
}

std::optional<Problem> counter_problem(const ManifestMessage& entry, const Message& m) {
  if (entry.counter.empty()) return std::nullopt;
  const Signal* const s = m.find(entry.counter);
  const auto refuse = [&](const std::string& what) {
    return Problem{entry.counter_place, "counter " + entry.counter + what};
  };
  if (s == nullptr) return refuse(" is no signal of message " + m.name);
  const SignalLayout& l = s->layout;
  const bool is_plain = l.order == ByteOrder::kIntel && l.number == Number::kUnsigned &&
                        l.scale == 1.0 && l.offset == 0.0 && !s->selector;
  if (!is_plain || l.length > kMaxCounterBits || l.start > 255) {
    return refuse(" must be an unsigned Intel field of at most 16 bits without scale");
  }
  return std::nullopt;
}

}  // namespace

const ManifestMessage* Manifest::find(std::string_view message_name) const {
  for (const ManifestMessage& m : messages) {
    if (m.name == message_name) return &m;
  }
  return nullptr;
}

Result<Manifest, Problem> parse_manifest(std::string_view text, const std::string& name) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  auto manifest = yaml::read(*document, manifest_of);
  if (manifest) manifest->name = name;
  return manifest;
}

std::optional<Problem> contradiction(const Manifest& manifest, const Database& database) {
  for (const ManifestMessage& entry : manifest.messages) {
    const Message* const m = database.find(entry.name);
    if (m == nullptr) {
      return Problem{entry.place, "message " + entry.name + " is not in " + database.name};
    }
    if (const auto problem = counter_problem(entry, *m)) return problem;
    for (const ManifestSlew& slew : entry.slews) {
      if (m->find(slew.signal) != nullptr) continue;
      return Problem{slew.place, "message " + m->name + " has no signal " + slew.signal};
    }
  }
  for (const Message& m : database.messages) {
    if (manifest.find(m.name) == nullptr) {
      return Problem{m.place, "message " + m.name + " has no entry in " + manifest.name};
    }
    for (const IdRange& range : manifest.ignored) {
      if (m.id < range.first || m.id > range.last) continue;
      return Problem{manifest.ignored_place, "message " + m.name + " would be ignored"};
    }
  }
  return std::nullopt;
}

std::vector<MessageRow> rows(const Manifest& manifest, const Database& database) {
  std::vector<MessageRow> out;
  for (const Message& m : database.messages) {
    const ManifestMessage* const entry = manifest.find(m.name);
    CHECK(entry != nullptr);
    const Signal* const counter = m.find(entry->counter);
    out.push_back(
        {.id = m.id,
         .length = m.length,
         .name = m.name.c_str(),
         .direction = entry->direction,
         .safety = entry->safety,
         .required = entry->required && entry->direction == Direction::kFromCar,
         .period = entry->period,
         .timeout = entry->timeout,
         .has_counter = counter != nullptr,
         .counter_start = static_cast<std::uint8_t>(counter == nullptr ? 0 : counter->layout.start),
         .counter_bits = counter == nullptr ? std::uint8_t{0} : counter->layout.length});
  }
  return out;
}

}  // namespace pitwall::can
