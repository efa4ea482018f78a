// Text of a field's value: a label, or a number with the decimals of its resolution or with a unit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/telemetry/registry/rows.hpp"

namespace pitwall::state {

std::string value_text(const telemetry::FieldRow& row, double value);
// Names of the first set bits, and the number of further ones, short enough for a screen line.
std::string bits_text(std::string_view labels, std::uint32_t bits);
// For sentences: "12.3 m/s"; the label of a value, or its number; "no data" for NaN.
std::string number_text(double value, const char* unit);
std::string label_text(std::string_view labels, double value);
std::string path_of(const telemetry::FieldRow& row);  // "ego.x"

}  // namespace pitwall::state
