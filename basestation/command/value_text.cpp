// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/value_text.hpp"

#include <cmath>

#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::command {

std::string number(double value, const char* unit) {
  if (std::isnan(value)) return "no data";
  return formatted("%.1f%s%s", value, *unit == '\0' ? "" : " ", unit);
}

std::string label(std::string_view labels, double value) {
  if (!(value >= 0.0)) return "no data";
  const auto name = telemetry::label_at(labels, static_cast<std::size_t>(value));
  return name.empty() ? "no. " + std::to_string(static_cast<std::size_t>(value))
                      : std::string{name};
}

}  // namespace pitwall::command
