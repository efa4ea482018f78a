// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/manifest.hpp"

#include <array>
#include <utility>

#include "protocol/vocabulary/check.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::can {
namespace {

constexpr double kSlowestPeriod_ms = 3'600'000.0;
constexpr double kMaxSlew_per_s = 1e12;
constexpr std::uint8_t kMaxCounterBits = 16;

constexpr std::array<std::pair<const char*, Direction>, 2> kDirections{
    {{"from_car", Direction::kFromCar}, {"to_car", Direction::kToCar}}};
constexpr std::array<std::pair<const char*, SafetyClass>, 4> kClasses{
    {{"information", SafetyClass::kInformation},
     {"status", SafetyClass::kStatus},
     {"actuator", SafetyClass::kActuator},
     {"race_control", SafetyClass::kRaceControl}}};

constexpr std::array<std::pair<const char*, Protection>, 4> kProfiles{
    {{"sae_j1850", Protection::kJ1850},
     {"e2e_p01", Protection::kP01},
     {"e2e_p02", Protection::kP02},
     {"e2e_p05", Protection::kP05}}};
constexpr std::array<std::pair<const char*, DataIdMode>, 4> kDataIdModes{
    {{"both", DataIdMode::kBoth},
     {"alternating", DataIdMode::kAlternating},
     {"low", DataIdMode::kLow},
     {"nibble", DataIdMode::kNibble}}};

template <class Choices>
auto choice(yaml::StrictMap& map, const std::string& key, const Choices& choices) {
  const std::string text = map.text(key);
  std::string known;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    known += std::string(known.empty() ? "" : ", ") + name;
  }
  map.fail(key, "\"" + text + "\" is not one of: " + known);
}

std::uint16_t largest_data_id(const ManifestChecksum& checksum) {
  if (checksum.profile != Protection::kP01) return 0xFFFF;
  switch (checksum.data_id_mode) {
    case DataIdMode::kLow:
      return 0xFF;
    case DataIdMode::kNibble:
      return 0xFFF;
    case DataIdMode::kBoth:
    case DataIdMode::kAlternating:
      break;
  }
  return 0xFFFF;
}

std::array<std::uint8_t, 16> data_ids(yaml::StrictMap& map) {
  std::array<std::uint8_t, 16> ids{};
  const auto numbers = map.numbers("data_ids", ids.size(), ids.size(), 0, 255);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = static_cast<std::uint8_t>(numbers[i]);
    if (ids[i] != numbers[i]) map.fail("data_ids", "expected whole numbers");
  }
  return ids;
}

ManifestChecksum checksum(yaml::StrictMap& map) {
  ManifestChecksum c;
  c.place = map.place();
  c.profile = choice(map, "profile", kProfiles);
  c.signal = map.text("signal");
  c.signal_place = map.place("signal");
  if (c.profile == Protection::kP01) c.data_id_mode = choice(map, "data_id_mode", kDataIdModes);
  if (c.data_id_mode == DataIdMode::kNibble) c.nibble = map.text("data_id_nibble");
  c.nibble_place = map.place("data_id_nibble");
  if (c.profile == Protection::kP02) {
    c.data_ids = data_ids(map);
    c.data_id_place = map.place("data_ids");
  } else if (c.profile != Protection::kJ1850) {
    c.data_id = static_cast<std::uint16_t>(map.integer("data_id", 0, largest_data_id(c)));
    c.data_id_place = map.place("data_id");
  }
  return c;
}

ManifestMessage message(const std::string& name, yaml::StrictMap map) {
  ManifestMessage m;
  m.name = name;
  m.place = map.place();
  m.direction = choice(map, "direction", kDirections);
  m.safety = choice(map, "safety", kClasses);
  m.required = map.flag_or("required", true);
  m.period = from_seconds(map.number("period_ms", 0.1, kSlowestPeriod_ms) * 1e-3);
  m.timeout = from_seconds(map.number("timeout_ms", 0.1, 10 * kSlowestPeriod_ms) * 1e-3);
  if (m.timeout <= m.period) map.fail("timeout_ms", "must be longer than the period");
  m.counter = map.text_or("counter", "");
  m.counter_place = map.place("counter");
  if (auto protection = map.optional_map("checksum")) m.checksum = checksum(*protection);
  if (auto slews = map.optional_map("slew_per_s")) {
    for (const std::string& signal : slews->keys()) {
      const double limit = slews->number(signal, 0.0, kMaxSlew_per_s);
      if (!(limit > 0.0)) slews->fail(signal, "must be more than 0");
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

// The lowest bit of a field as an Intel signal has it: of a Motorola field within one byte too.
std::optional<std::uint16_t> lowest_bit(const SignalLayout& l) {
  if (l.order == ByteOrder::kIntel) return l.start;
  if (l.start % 8 + 1 < l.length) return std::nullopt;
  return static_cast<std::uint16_t>(l.start + 1 - l.length);
}

// A field whose bits are a plain number; nothing where they are not.
std::optional<std::uint16_t> plain_field(const Signal& s) {
  const SignalLayout& l = s.layout;
  if (l.number != Number::kUnsigned || l.scale != 1.0 || l.offset != 0.0) return std::nullopt;
  if (s.selector) return std::nullopt;
  return lowest_bit(l);
}

std::optional<Problem> counter_problem(const ManifestMessage& entry, const Message& m) {
  if (entry.counter.empty()) return std::nullopt;
  const Signal* const s = m.find(entry.counter);
  const auto refuse = [&](const std::string& what) {
    return Problem{entry.counter_place, "counter " + entry.counter + what};
  };
  if (s == nullptr) return refuse(" is no signal of message " + m.name);
  const auto start = plain_field(*s);
  if (!start || s->layout.length > kMaxCounterBits || *start > 255) {
    return refuse(
        " must be an unsigned field of at most 16 bits without scale, Intel or within one byte");
  }
  return std::nullopt;
}

ProtectionRule rule_of(const ManifestMessage& entry, const Message& m) {
  const ManifestChecksum& c = entry.checksum;
  if (c.profile == Protection::kNone) return {};
  const Signal* const counter = m.find(entry.counter);
  const Signal* const nibble = m.find(c.nibble);
  const auto start = [](const Signal* s) -> std::uint16_t {
    return s == nullptr ? std::uint16_t{0} : lowest_bit(s->layout).value_or(0);
  };
  return {.profile = c.profile,
          .data_id_mode = c.data_id_mode,
          .length = static_cast<std::uint8_t>(m.length),  // strictly read
          .crc_byte = static_cast<std::uint8_t>(start(m.find(c.signal)) / 8),
          .counter_start = start(counter),
          .counter_bits = counter == nullptr ? std::uint8_t{0} : counter->layout.length,
          .nibble_start = start(nibble),
          .data_id = c.data_id,
          .data_ids = c.data_ids};
}

// A field of `bits` bits that starts at a multiple of `grid`.
std::optional<Problem> field_problem(const Message& m, const std::string& name, unsigned bits,
                                     unsigned grid, const std::string& place) {
  const Signal* const s = m.find(name);
  if (s == nullptr) return Problem{place, name + " is no signal of message " + m.name};
  const auto start = plain_field(*s);
  if (start && s->layout.length == bits && *start % grid == 0) return std::nullopt;
  return Problem{place, name + " must be an unsigned field of " + std::to_string(bits) +
                            " bits without scale that starts at a multiple of " +
                            std::to_string(grid)};
}

// Where the profile wants its counter: anywhere (nullopt), or this many bits after the checksum.
std::optional<unsigned> counter_after_crc(Protection profile) {
  if (profile == Protection::kP02) return 8;
  if (profile == Protection::kP05) return 16;
  return std::nullopt;
}

std::optional<Problem> protected_counter_problem(const ManifestMessage& entry, const Message& m) {
  const ManifestChecksum& c = entry.checksum;
  if (c.profile == Protection::kJ1850) return std::nullopt;
  if (entry.counter.empty()) return Problem{c.place, "the profile needs a counter"};
  const unsigned bits = c.profile == Protection::kP05 ? 8 : 4;
  const auto problem = field_problem(m, entry.counter, bits, bits, entry.counter_place);
  if (problem) return problem;
  const ProtectionRule rule = rule_of(entry, m);
  const auto after = counter_after_crc(c.profile);
  if (after && rule.counter_start != 8U * rule.crc_byte + *after) {
    return Problem{entry.counter_place,
                   "counter " + entry.counter + " must follow the checksum " + c.signal};
  }
  return std::nullopt;
}

std::optional<Problem> checksum_problem(const ManifestMessage& entry, const Message& m) {
  const ManifestChecksum& c = entry.checksum;
  if (c.profile == Protection::kNone) return std::nullopt;
  constexpr std::uint8_t kMaxBytes = 30;
  const unsigned crc_bits = c.profile == Protection::kP05 ? 16 : 8;
  if (auto problem = field_problem(m, c.signal, crc_bits, 8, c.signal_place)) return problem;
  if (auto problem = protected_counter_problem(entry, m)) return problem;
  if (c.data_id_mode == DataIdMode::kNibble) {
    if (auto problem = field_problem(m, c.nibble, 4, 4, c.nibble_place)) return problem;
  }
  const bool is_counter = c.signal == entry.counter || c.nibble == entry.counter;
  if (is_counter && !entry.counter.empty()) {
    return Problem{c.place,
                   "the counter " + entry.counter + " must not be a signal of the checksum too"};
  }
  if (c.profile == Protection::kP01 && m.length > kMaxBytes) {
    return Problem{c.place, "profile 1 protects at most 30 bytes"};
  }
  if (hides_a_flip(rule_of(entry, m))) {
    return Problem{c.data_id_place, "with these data ids a flipped bit of the counter passes"};
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
    if (const auto problem = checksum_problem(entry, *m)) return problem;
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
      return Problem{manifest.ignored_place,
                     "message " + m.name + " lies in a range of ids to ignore"};
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
    const std::uint16_t start = counter == nullptr ? 0 : lowest_bit(counter->layout).value_or(0);
    out.push_back({.id = m.id,
                   .length = static_cast<std::uint8_t>(m.length),  // strictly read
                   .name = m.name.c_str(),
                   .direction = entry->direction,
                   .safety = entry->safety,
                   .required = entry->required && entry->direction == Direction::kFromCar,
                   .period = entry->period,
                   .timeout = entry->timeout,
                   .has_counter = counter != nullptr,
                   .counter_start = static_cast<std::uint8_t>(start),
                   .counter_bits = counter == nullptr ? std::uint8_t{0} : counter->layout.length,
                   .protection = rule_of(*entry, m)});
  }
  return out;
}

}  // namespace pitwall::can
