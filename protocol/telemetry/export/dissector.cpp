// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/dissector.hpp"

#include <string_view>

#include "protocol/telemetry/export/dissector_cipher.hpp"
#include "protocol/telemetry/export/dissector_code.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/registry/schema_text.hpp"

namespace pitwall::telemetry {
namespace {

std::string assign(std::string_view name, std::size_t value) {
  return "local " + std::string{name} + " = " + std::to_string(value) + "\n";
}

std::string constants() {
  return assign("VERSION", kProtocolVersion) + assign("HEADER", kHeaderSize) +
         assign("TAG", kTagSize) + assign("AGE_BITS", kAgeCodeBits) + assign("NEVER", kNeverCode) +
         assign("SIGNED", static_cast<std::size_t>(Kind::kSigned)) + assign("PATHS", kPaths) +
         assign("BASE_PORT", kDissectorPort);
}

// Upper bounds of the age codes, in ms.
std::string ages() {
  std::string text = "local AGES = {";
  for (std::uint8_t code = 0; code < kNeverCode; ++code)
    text += std::string{Decimal{age_of_code(code).milliseconds()}.text()} + ", ";
  return text + "}\n";
}

std::string field_lua(const FieldRow& row) {
  const bits::Quantized code = row.quantized();
  std::string text = "{" + quoted(row.name) + ", " + quoted(row.unit) + ", " +
                     std::string{Decimal{row.min}.text()} + ", " +
                     std::string{Decimal{row.resolution}.text()} + ", " +
                     std::to_string(code.bits()) + ", " + std::to_string(code.count());
  if (!row.labels.empty() && row.unit != FieldRow::kBitSet) text += ", " + quoted(row.labels);
  return text + "}";
}

std::string groups_lua(Direction direction) {
  std::string text;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != direction) continue;
    text += "  {name = " + quoted(row.name) + ", bits = " + std::to_string(group_bits(row.group)) +
            ", fields = {\n";
    const auto [first, count] = fields_of(row.group);
    for (FieldIndex i = first; i < first + count; ++i)
      text += "    " + field_lua(kFields[i]) + ",\n";
    text += "  }},\n";
  }
  return text;
}

}  // namespace

std::string dissector_lua() {
  return std::string{kDissectorHead} + constants() + ages() + "local DOWN = {\n" +
         groups_lua(Direction::kDown) + "}\nlocal UP = {\n" + groups_lua(Direction::kUp) + "}\n" +
         std::string{kDissectorCipher} + std::string{kDissectorCode};
}

}  // namespace pitwall::telemetry
