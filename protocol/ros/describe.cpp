// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/describe.hpp"

#include <span>

#include "protocol/bits/sha256.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::ros {
namespace {

constexpr std::string_view kSeparator =
    "================================================================================\n";

std::string_view msg_name_of(TypeId type) {
  switch (type) {
    case TypeId::kInt8:
      return "int8";
    case TypeId::kUint8:
      return "uint8";
    case TypeId::kInt16:
      return "int16";
    case TypeId::kUint16:
      return "uint16";
    case TypeId::kInt32:
      return "int32";
    case TypeId::kUint32:
      return "uint32";
    case TypeId::kInt64:
      return "int64";
    case TypeId::kUint64:
      return "uint64";
    case TypeId::kFloat:
      return "float32";
    case TypeId::kDouble:
      return "float64";
    case TypeId::kBool:
      return "bool";
    case TypeId::kByte:
      return "byte";
    case TypeId::kString:
    case TypeId::kBoundedString:
      return "string";
    case TypeId::kNested:
      break;
  }
  CHECK(false);
}

// "std_msgs/msg/Header" is "std_msgs/Header" in a .msg file.
std::string short_name(std::string_view full) {
  constexpr std::string_view kMiddle = "/msg/";
  const std::size_t at = full.find(kMiddle);
  CHECK(at != full.npos);
  return std::string(full.substr(0, at)) + "/" + std::string(full.substr(at + kMiddle.size()));
}

void append_text(std::string& out, const StructDescription& type) {
  for (const Constant& c : type.constants)
    out += std::string(c.type) + " " + std::string(c.name) + "=" + std::string(c.value) + "\n";
  for (const FieldDescription& f : type.fields) {
    out += f.type == TypeId::kNested ? short_name(f.nested) : std::string(msg_name_of(f.type));
    if (f.bound > 0) out += "<=" + std::to_string(f.bound);
    if (f.many == Many::kFixed) out += "[" + std::to_string(f.count) + "]";
    if (f.many == Many::kAny) out += "[]";
    out += " " + f.name + (f.comment.empty() ? "" : "  # " + f.comment) + "\n";
  }
}

// JSON as Python's json.dumps writes it: names here hold nothing that needs an escape.
void append_json(std::string& out, const StructDescription& type) {
  out += R"({"type_name": ")" + type.name + R"(", "fields": [)";
  // rosidl puts this member where a message has none.
  static const FieldDescription kEmpty{
      .name = "structure_needs_at_least_one_member", .type = TypeId::kUint8, .nested = {}};
  const std::span<const FieldDescription> fields =
      type.fields.empty() ? std::span{&kEmpty, 1} : std::span{type.fields};
  for (const FieldDescription& f : fields) {
    if (&f != fields.data()) out += ", ";
    const auto id = static_cast<unsigned>(f.type) + static_cast<unsigned>(f.many);
    out += R"({"name": ")" + f.name + R"(", "type": {"type_id": )" + std::to_string(id) +
           R"(, "capacity": )" + std::to_string(f.count) + R"(, "string_capacity": )" +
           std::to_string(f.bound) + R"(, "nested_type_name": ")" + f.nested + R"("}})";
  }
  out += "]}";
}

}  // namespace

std::string file_text(const StructDescription& type) {
  std::string out;
  append_text(out, type);
  return out;
}

std::string message_text(const TypeDescription& type) {
  std::string out;
  append_text(out, type.type);
  for (const auto& [name, referenced] : type.referenced) {
    out += kSeparator;
    out += "MSG: " + short_name(name) + "\n";
    append_text(out, referenced);
  }
  return out;
}

std::string type_hash(const TypeDescription& type) {
  std::string json = R"({"type_description": )";
  append_json(json, type.type);
  json += R"(, "referenced_type_descriptions": [)";
  for (bool first = true; const auto& [name, referenced] : type.referenced) {
    if (!first) json += ", ";
    first = false;
    append_json(json, referenced);
  }
  json += "]}";
  bits::Sha256 sum;
  sum.update({reinterpret_cast<const std::uint8_t*>(json.data()), json.size()});
  return "RIHS01_" + bits::to_hex(sum.digest());
}

}  // namespace pitwall::ros
