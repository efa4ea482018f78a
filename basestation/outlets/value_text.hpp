// A field's value as people read it: a label, or a number with the decimals of its resolution.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/telemetry/registry/field_row.hpp"

namespace pitwall::outlets {

std::string value_text(const telemetry::FieldRow& row, double value);
std::string path_of(const telemetry::FieldRow& row);  // "ego.x"

}  // namespace pitwall::outlets
