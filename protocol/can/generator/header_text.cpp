// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/generator/header_text.hpp"

#include <array>
#include <charconv>
#include <set>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::can {
namespace {

std::string real(double v) {
  std::array<char, 40> text{};  // the shortest digits that give back the same number
  const auto end = std::to_chars(text.data(), text.data() + text.size(), v).ptr;
  std::string out{text.data(), end};
  if (out.find_first_of(".e") == std::string::npos) out += ".0";
  return out;
}

std::string number(std::uint64_t v) { return std::to_string(v); }

const char* direction_name(Direction d) {
  return d == Direction::kFromCar ? "Direction::kFromCar" : "Direction::kToCar";
}

const char* class_name(SafetyClass c) {
  switch (c) {
    case SafetyClass::kInformation:
      return "SafetyClass::kInformation";
    case SafetyClass::kStatus:
      return "SafetyClass::kStatus";
    case SafetyClass::kActuator:
      return "SafetyClass::kActuator";
    case SafetyClass::kRaceControl:
      return "SafetyClass::kRaceControl";
  }
  return "";
}

const char* number_kind(Number n) {
  switch (n) {
    case Number::kUnsigned:
      return "Number::kUnsigned";
    case Number::kSigned:
      return "Number::kSigned";
    case Number::kFloat32:
      return "Number::kFloat32";
    case Number::kFloat64:
      return "Number::kFloat64";
  }
  return "";
}

const char* profile_name(Protection p) {
  switch (p) {
    case Protection::kNone:
      return "Protection::kNone";
    case Protection::kJ1850:
      return "Protection::kJ1850";
    case Protection::kP01:
      return "Protection::kP01";
    case Protection::kP02:
      return "Protection::kP02";
    case Protection::kP05:
      return "Protection::kP05";
  }
  return "";
}

const char* mode_name(DataIdMode m) {
  switch (m) {
    case DataIdMode::kBoth:
      return "DataIdMode::kBoth";
    case DataIdMode::kAlternating:
      return "DataIdMode::kAlternating";
    case DataIdMode::kLow:
      return "DataIdMode::kLow";
    case DataIdMode::kNibble:
      return "DataIdMode::kNibble";
  }
  return "";
}

std::string rule_text(const ProtectionRule& rule) {
  std::string ids;
  for (const std::uint8_t id : rule.data_ids) ids += (ids.empty() ? "" : ", ") + number(id);
  return std::string{"{.profile = "} + profile_name(rule.profile) +
         ", .data_id_mode = " + mode_name(rule.data_id_mode) +
         ",\n      .length = " + number(rule.length) + ", .crc_byte = " + number(rule.crc_byte) +
         ", .counter_start = " + number(rule.counter_start) +
         ", .counter_bits = " + number(rule.counter_bits) +
         ",\n      .nibble_start = " + number(rule.nibble_start) +
         ", .data_id = " + number(rule.data_id) + ",\n      .data_ids = {" + ids + "}}";
}

const char* word_of(const SignalPlan& p) {
  return p.order == ByteOrder::kIntel ? "intel" : "motorola";
}

bool uses(const Message& m, ByteOrder order) {
  for (const Signal& s : m.signals) {
    if (s.layout.order == order) return true;
  }
  return false;
}

bool is_identifier(std::string_view name) {
  static const std::set<std::string_view> kTaken{
      "auto",     "bool",    "break",    "case",  "catch",  "char",    "class",    "const",
      "continue", "default", "delete",   "do",    "double", "else",    "enum",     "extern",
      "false",    "float",   "for",      "if",    "int",    "long",    "new",      "operator",
      "private",  "public",  "return",   "short", "signed", "sizeof",  "static",   "struct",
      "switch",   "this",    "throw",    "true",  "try",    "union",   "unsigned", "using",
      "virtual",  "void",    "volatile", "while", "kId",    "kLength", "kName",    "kFields"};
  if (name.empty() || (name[0] >= '0' && name[0] <= '9') || kTaken.contains(name)) return false;
  return name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
         std::string_view::npos;
}

std::optional<Problem> unsupported(const Message& m) {
  if (m.extended) {
    return Problem{m.place, "message " + m.name + ": expected an 11-bit id"};
  }
  if (!is_identifier(m.name)) return Problem{m.place, m.name + " cannot be a name in C++"};
  for (const Signal& s : m.signals) {
    if (s.selector)
      return Problem{s.place,
                     "signal " + s.name + " is multiplexed, which the generator cannot translate"};
    if (!is_identifier(s.name)) return Problem{s.place, s.name + " cannot be a name in C++"};
    if (s.layout.min > s.layout.max) {
      return Problem{s.place, "signal " + s.name + ": the minimum is above the maximum"};
    }
  }
  return std::nullopt;
}

void add_struct(std::string& out, const Message& m) {
  out += "// " + m.name + "\nstruct " + struct_name(m.name) + " {\n";
  out += "  static constexpr std::uint32_t kId = " + number(m.id) + ";\n";
  out += "  static constexpr std::uint8_t kLength = " + number(m.length) + ";\n";
  out += "  static constexpr const char* kName = \"" + m.name + "\";\n\n";
  for (const Signal& s : m.signals) {
    out += "  double " + s.name + " = kUnset;";
    if (!s.unit.empty()) out += "  // " + s.unit;
    out += "\n";
  }
  out += "\n  // In the order of the database.\n  static constexpr std::array<double " +
         struct_name(m.name) + "::*, " + number(m.signals.size()) + "> kFields{";
  for (const Signal& s : m.signals) out += "\n      &" + struct_name(m.name) + "::" + s.name + ",";
  out += "};\n};\n\n";
}

void add_plans(std::string& out, const Message& m) {
  out += "namespace plan_of_" + m.name + " {\n";
  for (const Signal& s : m.signals) {
    const SignalPlan& p = s.plan;
    out += "inline constexpr SignalPlan " + s.name +
           "{\n    .first_byte = " + number(p.first_byte) +
           ", .shift = " + std::to_string(p.shift) + ", .length = " + number(p.length) +
           ",\n    .order = " +
           (p.order == ByteOrder::kIntel ? "ByteOrder::kIntel" : "ByteOrder::kMotorola") +
           ", .number = " + number_kind(p.number) + ",\n    .mask = " + hex(p.mask) +
           ", .scale = " + real(p.scale) + ", .offset = " + real(p.offset) +
           ",\n    .raw_min = " + real(p.raw_min) + ", .raw_max = " + real(p.raw_max) +
           ",\n    .raw_min_bits = " + hex(p.raw_min_bits) +
           ", .raw_max_bits = " + hex(p.raw_max_bits) + "};\n";
  }
  out += "}  // namespace plan_of_" + m.name + "\n\n";
}

// More than eight bytes: every signal is loaded by itself.
void add_fd_fields(std::string& out, const Message& m, bool is_decode) {
  for (const Signal& s : m.signals) {
    const std::string plan = "plan_of_" + m.name + "::" + s.name;
    out += is_decode ? "  out." + s.name + " = physical_of(extract(" + plan + ", frame.data), " +
                           plan + ");\n"
                     : "  insert(" + plan + ", out.data, encode_signal(in." + s.name + ", " + plan +
                           ", counters));\n";
  }
}

void add_decode(std::string& out, const Message& m) {
  out += "// False, `out` untouched, unless the frame is exactly a " + m.name + ".\n";
  out += "[[nodiscard]] inline bool decode(const Frame& frame, " + struct_name(m.name) +
         "& out) {\n  if (!" + (m.fd ? "is_fd" : "is_classic") + "(frame, " + number(m.id) + ", " +
         number(m.length) + ")) return false;\n";
  if (m.fd) {
    add_fd_fields(out, m, true);
    out += "  return true;\n}\n\n";
    return;
  }
  if (uses(m, ByteOrder::kIntel)) {
    out += "  const std::uint64_t intel = load_intel(frame.data);\n";
  }
  if (uses(m, ByteOrder::kMotorola)) {
    out += "  const std::uint64_t motorola = load_motorola(frame.data);\n";
  }
  for (const Signal& s : m.signals) {
    const SignalPlan& p = s.plan;
    out += "  out." + s.name + " =\n      number_of(" + word_of(p) + " >> " +
           std::to_string(p.shift) + " & " + hex(p.mask) + ", " + number_kind(p.number) + ", " +
           number(p.length) + ") * " + real(p.scale) + " + " + real(p.offset) + ";\n";
  }
  if (m.signals.empty()) out += "  static_cast<void>(out);\n";
  out += "  return true;\n}\n\n";
}

void add_encode(std::string& out, const Message& m) {
  out += "// False, `out` untouched, where a field is NaN or infinite.\n";
  out += "[[nodiscard]] inline bool encode(const " + struct_name(m.name) +
         "& in, Frame& out,\n                                 EncodeCounters& counters) {\n";
  out += "  if (!all_finite({";
  for (std::size_t i = 0; i < m.signals.size(); ++i) {
    out += (i == 0 ? "in." : ",\n                   in.") + m.signals[i].name;
  }
  out += "})) {\n    ++counters.not_finite;\n    return false;\n  }\n";
  if (m.fd) {
    out += "  out = Frame{};\n  out.id = " + number(m.id) +
           ";\n  out.fd = true;\n  out.length = " + number(m.length) + ";\n";
    add_fd_fields(out, m, false);
    out += "  return true;\n}\n\n";
    return;
  }
  for (const ByteOrder order : {ByteOrder::kIntel, ByteOrder::kMotorola}) {
    if (!uses(m, order)) continue;
    const std::string word = order == ByteOrder::kIntel ? "intel" : "motorola";
    out += "  std::uint64_t " + word + " = 0;\n";
    for (const Signal& s : m.signals) {
      if (s.layout.order != order) continue;
      out += "  " + word + " |= encode_signal(in." + s.name + ", plan_of_" + m.name +
             "::" + s.name + ", counters) << " + std::to_string(s.plan.shift) + ";\n";
    }
  }
  out += "  out = Frame{};\n  out.id = " + number(m.id) + ";\n  out.length = " + number(m.length) +
         ";\n";
  const bool both = uses(m, ByteOrder::kIntel) && uses(m, ByteOrder::kMotorola);
  if (both) {
    out +=
        "  FrameBytes other{};\n  store_intel(out.data, intel);\n"
        "  store_motorola(other, motorola);\n"
        "  for (std::size_t i = 0; i < 8; ++i) out.data[i] |= other[i];\n";
  } else if (!m.signals.empty()) {
    const std::string word = uses(m, ByteOrder::kIntel) ? "intel" : "motorola";
    out += "  store_" + word + "(out.data, " + word + ");\n";
  }
  out += "  return true;\n}\n\n";
}

void add_tables(std::string& out, const Database& database, const Manifest& manifest) {
  const std::vector<MessageRow> table = rows(manifest, database);
  out += "// Sorted by id.\ninline constexpr std::array<MessageRow, " + number(table.size()) +
         "> kMessages{{\n";
  for (const MessageRow& r : table) {
    out += "    {" + number(r.id) + ", " + number(r.length) + ", \"" + r.name + "\", " +
           direction_name(r.direction) + ",\n     " + class_name(r.safety) +
           (r.required ? ", true" : ", false") + ", Duration{" + std::to_string(r.period.ns) +
           "}, Duration{" + std::to_string(r.timeout.ns) + "}, " +
           (r.has_counter ? "true" : "false") + ", " + number(r.counter_start) + ", " +
           number(r.counter_bits);
    if (r.protection.profile != Protection::kNone) out += ",\n     " + rule_text(r.protection);
    out += "},\n";
  }
  out += "}};\n\n";
  std::string slews;
  std::size_t count = 0;
  for (const Message& m : database.messages) {
    for (const ManifestSlew& s : manifest.find(m.name)->slews) {
      slews += "    {" + number(m.id) + ", \"" + s.signal + "\", " + real(s.max_per_s) + "},\n";
      ++count;
    }
  }
  out +=
      "inline constexpr std::array<SlewRow, " + number(count) + "> kSlews{{\n" + slews + "}};\n\n";
  out += "// Ids of other nodes that may be on this bus.\n";
  out += "inline constexpr std::array<IdRange, " + number(manifest.ignored.size()) +
         "> kIgnoredIds{{\n";
  for (const IdRange& r : manifest.ignored) {
    out += "    {" + number(r.first) + ", " + number(r.last) + "},\n";
  }
  out += "}};\n\n";
  out += "using AllMessages = std::tuple<";
  for (std::size_t i = 0; i < database.messages.size(); ++i) {
    out += (i == 0 ? "\n    " : ",\n    ") + struct_name(database.messages[i].name);
  }
  out += ">;\n\n";
  out += "inline constexpr const char* kDatabase = \"" + manifest.database + "\";\n";
  out += "inline constexpr const char* kRevision = \"" + manifest.revision + "\";\n";
  out += "inline constexpr std::uint64_t kFingerprint = " + hex(fingerprint(database)) + ";\n\n";
}

constexpr const char* kIncludes = R"(
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <tuple>

#include "protocol/can/encode.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/units.hpp"

)";

constexpr const char* kShared =
    R"(inline bool is_classic(const Frame& f, std::uint32_t id, std::uint8_t length) {
  return f.id == id && f.length == length && !f.extended && !f.remote && !f.fd;
}

inline bool is_fd(const Frame& f, std::uint32_t id, std::uint8_t length) {
  return f.id == id && f.length == length && !f.extended && !f.remote && f.fd;
}

inline bool all_finite(std::initializer_list<double> values) {
  bool finite = true;
  for (const double v : values) finite = finite && std::isfinite(v);
  return finite;
}

)";

}  // namespace

std::string struct_name(std::string_view message_name) {
  std::string out;
  bool starts_word = true;
  for (const char c : message_name) {
    if (c == '_') {
      starts_word = true;
      continue;
    }
    const bool lower = c >= 'a' && c <= 'z', upper = c >= 'A' && c <= 'Z';
    const char changed = starts_word && lower    ? static_cast<char>(c - 'a' + 'A')
                         : !starts_word && upper ? static_cast<char>(c - 'A' + 'a')
                                                 : c;
    out += changed;
    starts_word = false;
  }
  return out;
}

Result<std::string, Problem> header_text(const Database& database, const Manifest& manifest,
                                         const std::string& name_space) {
  if (const auto problem = contradiction(manifest, database)) return Unexpected{*problem};
  std::set<std::string> structs;
  for (const Message& m : database.messages) {
    if (const auto problem = unsupported(m)) return Unexpected{*problem};
    if (!structs.insert(struct_name(m.name)).second) {
      return Unexpected{Problem{m.place, "two messages would become " + struct_name(m.name)}};
    }
  }
  std::string out = "// Made from " + manifest.database +
                    " and its manifest by pitwall-dbc-generator; changes belong there.\n"
                    "//   units   those of the database; nothing is converted\n"
                    "// SPDX-License-Identifier: Apache-2.0";
  out += kIncludes;
  out += "namespace pitwall::can::" + name_space + " {\n\n";
  out += kShared;
  for (const Message& m : database.messages) {
    add_struct(out, m);
    add_plans(out, m);
    add_decode(out, m);
    add_encode(out, m);
  }
  add_tables(out, database, manifest);
  out += "}  // namespace pitwall::can::" + name_space + "\n";
  return out;
}

}  // namespace pitwall::can
