// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/exposition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::metrics {
namespace {

constexpr double kMilli = 1e-3, kMicro = 1e-6, kKilo = 1e3, kMebi = 1'048'576.0,
                 kPerHour = 1.0 / 3'600.0, kMinute = 60.0, kBytesPerKbit = 125.0;
constexpr std::string_view kPlain =
    "fields without unit: counts, shares of one, and numbers of the labels in /api/catalogue";

constexpr std::array kUnits{
    UnitName{"", "number", kPlain},
    UnitName{"bits", "bit_set", "sets of bits, named in /api/catalogue"},
    UnitName{"A", "amperes", "fields in A"},
    UnitName{"Hz", "hertz", "fields in Hz"},
    UnitName{"MiB", "bytes", "fields in bytes", kMebi},
    UnitName{"N", "newtons", "fields in N"},
    UnitName{"Nm", "newton_meters", "fields in Nm"},
    UnitName{"V", "volts", "fields in V"},
    UnitName{"degC", "celsius", "fields in degrees Celsius"},
    UnitName{"kPa", "pascals", "fields in Pa", kKilo},
    UnitName{"l", "liters", "fields in l"},
    UnitName{"l/h", "liters_per_second", "fields in l/s", kPerHour},
    UnitName{"m", "meters", "fields in m"},
    UnitName{"mm", "meters", "fields in m", kMilli},
    UnitName{"m/s", "meters_per_second", "fields in m/s"},
    UnitName{"m/s^2", "meters_per_second_squared", "fields in m/s^2"},
    UnitName{"rad", "radians", "fields in rad"},
    UnitName{"rad/s", "radians_per_second", "fields in rad/s"},
    UnitName{"rpm", "revolutions_per_minute", "fields in 1/min"},
    UnitName{"s", "seconds", "fields in s"},
    UnitName{"ms", "seconds", "fields in s", kMilli},
    UnitName{"us", "seconds", "fields in s", kMicro},
    UnitName{"min", "seconds", "fields in s", kMinute},
    UnitName{"kbit/s", "bytes_per_second", "fields in bytes/s", kBytesPerKbit},
    UnitName{"kB/s", "bytes_per_second", "fields in bytes/s", kKilo}};

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\' || c == '"') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out;
}

std::string braces(const Labels& labels) {
  if (labels.empty()) return {};
  std::string text;
  for (const auto& [name, value] : labels) {
    text += (text.empty() ? "{" : ",") + std::string{name} + "=\"" + escaped(value) + "\"";
  }
  return text + "}";
}

}  // namespace

const UnitName* unit_name(std::string_view unit) {
  const auto found = std::ranges::find(kUnits, unit, &UnitName::unit);
  return found == kUnits.end() ? nullptr : &*found;
}

void Exposition::add(Kind kind, std::string_view name, std::string_view help, const Labels& labels,
                     double value) {
  if (!std::isfinite(value)) return;
  auto family = std::ranges::find(families_, name, &Family::name);
  if (family == families_.end()) {
    const std::string own{name};
    families_.push_back({.name = own,
                         .head = "# HELP " + own + " " + std::string{help} + "\n# TYPE " + own +
                                 (kind == Kind::kCounter ? " counter\n" : " gauge\n"),
                         .samples = {}});
    family = std::prev(families_.end());
  }
  family->samples += family->name + braces(labels) + " " + json::number(value) + "\n";
}

std::string Exposition::text() const {
  std::string text;
  for (const Family& family : families_) text += family.head + family.samples;
  return text;
}

}  // namespace pitwall::publishers::metrics
