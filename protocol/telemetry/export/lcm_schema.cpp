// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/lcm_schema.hpp"

#include <bit>

namespace pitwall::telemetry {
namespace {

constexpr std::uint64_t kHashStart = 0x12345678;
constexpr unsigned kHashTop = 55;
constexpr std::uint64_t kVariableSize = 1;

// The shift to the right is that of a signed number.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  const auto top = static_cast<std::uint64_t>(static_cast<std::int64_t>(hash) >> kHashTop);
  return ((hash << 8U) ^ top) + value;
}

std::uint64_t mixed(std::uint64_t hash, std::string_view text) {
  hash = mixed(hash, text.size());
  for (const char c : text) hash = mixed(hash, static_cast<std::uint64_t>(c));
  return hash;
}

LcmMember utime() { return {"int64_t", "utime", {}, "us"}; }
LcmMember size() { return {"int32_t", "size"}; }
LcmMember data() { return {"byte", "data", "size"}; }

std::string text_of(const LcmType& type) {
  std::string text = "struct " + type.name + " {\n";
  for (const LcmMember& member : type.members) {
    text += "  " + std::string{member.type} + " " + member.name;
    if (!member.size.empty()) text += "[" + std::string{member.size} + "]";
    text += member.unit.empty() ? ";\n" : ";  // " + std::string{member.unit} + "\n";
  }
  return text + "}\n";
}

}  // namespace

LcmType lcm_type(Group group) {
  LcmType type{std::string{row_of(group).name} + "_t", {utime()}};
  const auto [first, count] = fields_of(group);
  for (FieldIndex i = first; i < first + count; ++i) {
    type.members.push_back({"double", std::string{kFields[i].name}, {}, kFields[i].unit});
  }
  return type;
}

LcmType lcm_text_type() { return {"text_t", {utime(), {"string", "json"}}}; }

LcmType lcm_datagram_type() {
  return {"datagram_t",
          {utime(), {"int16_t", "path"}, {"int32_t", "ip"}, {"int32_t", "port"}, size(), data()}};
}

LcmType lcm_bytes_type() { return {"bytes_t", {utime(), size(), data()}}; }

LcmType lcm_can_type() {
  return {"can_frame_t",
          {utime(),
           {"int32_t", "id"},
           {"boolean", "extended"},
           {"boolean", "remote"},
           {"boolean", "fd"},
           size(),
           data()}};
}

std::uint64_t lcm_fingerprint(const LcmType& type) {
  std::uint64_t hash = kHashStart;
  for (const LcmMember& member : type.members) {
    hash = mixed(hash, std::string_view{member.name});
    hash = mixed(hash, member.type);
    hash = mixed(hash, member.size.empty() ? 0U : 1U);
    if (member.size.empty()) continue;
    hash = mixed(hash, kVariableSize);
    hash = mixed(hash, member.size);
  }
  return std::rotl(hash, 1);
}

std::string lcm_types_text() {
  std::string text =
      "// Made from the registry by `pitwall-base export lcm`.\npackage pitwall;\n\n";
  for (const GroupRow& row : kGroupTable) text += text_of(lcm_type(row.group)) + "\n";
  return text + text_of(lcm_text_type()) + "\n" + text_of(lcm_datagram_type()) + "\n" +
         text_of(lcm_bytes_type()) + "\n" + text_of(lcm_can_type());
}

}  // namespace pitwall::telemetry
