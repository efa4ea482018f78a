// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/value_text.hpp"

#include <cmath>

#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::state {
namespace {

int decimals_of(double resolution) {
  int decimals = 0;
  for (double step = resolution; step < 0.999 && decimals < 6; step *= 10.0) ++decimals;
  return decimals;
}

}  // namespace

std::string bits_text(std::string_view labels, std::uint32_t bits) {
  constexpr int kNamed = 3;
  constexpr std::size_t kWidth = 80;  // of the names
  if (bits == 0) return "none";
  std::string text;
  int named = 0, more = 0;
  for (std::size_t k = 0; k < 32; ++k) {
    if ((bits >> k & 1U) == 0) continue;
    const auto label = telemetry::label_at(labels, k);
    const std::string name = label.empty() ? "bit " + std::to_string(k) : std::string{label};
    const bool room = named == 0 || text.size() + name.size() <= kWidth;
    if (more > 0 || named == kNamed || !room) {
      ++more;
      continue;
    }
    text += (named++ == 0 ? "" : ", ") + name;
  }
  return more > 0 ? text + " and " + std::to_string(more) + " more" : text;
}

std::string value_text(const telemetry::FieldRow& row, double value) {
  if (std::isnan(value)) return "-";
  if (row.unit == telemetry::FieldRow::kBitSet && !row.labels.empty()) {
    return bits_text(row.labels, static_cast<std::uint32_t>(value));
  }
  if (!row.labels.empty() && value >= 0.0) {
    const auto label = telemetry::label_at(row.labels, static_cast<std::size_t>(value + 0.5));
    if (!label.empty()) return std::string{label};
  }
  return formatted("%.*f", decimals_of(row.resolution), value);
}

std::string number_text(double value, const char* unit) {
  if (std::isnan(value)) return "no data";
  return formatted("%.1f%s%s", value, *unit == '\0' ? "" : " ", unit);
}

std::string label_text(std::string_view labels, double value) {
  if (!(value >= 0.0)) return "no data";
  const auto name = telemetry::label_at(labels, static_cast<std::size_t>(value));
  return name.empty() ? "no. " + std::to_string(static_cast<std::size_t>(value))
                      : std::string{name};
}

std::string path_of(const telemetry::FieldRow& row) {
  return std::string{telemetry::row_of(row.group).name} + "." + std::string{row.name};
}

}  // namespace pitwall::state
