// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/value_text.hpp"

#include <cmath>
#include <cstdio>

#include "protocol/telemetry/registry/labels.hpp"

namespace pitwall::outlets {
namespace {

int decimals_of(double resolution) {
  int decimals = 0;
  for (double step = resolution; step < 0.999 && decimals < 6; step *= 10.0) ++decimals;
  return decimals;
}

}  // namespace

std::string value_text(const telemetry::FieldRow& row, double value) {
  if (std::isnan(value)) return "-";
  if (!row.labels.empty() && value >= 0.0) {
    const auto label = telemetry::label_at(row.labels, static_cast<std::size_t>(value + 0.5));
    if (!label.empty()) return std::string{label};
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals_of(row.resolution), value);
  return text;
}

std::string path_of(const telemetry::FieldRow& row) {
  return std::string{telemetry::row_of(row.group).name} + "." + std::string{row.name};
}

}  // namespace pitwall::outlets
